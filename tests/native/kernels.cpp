// The parts of the native ship model one by one, for comparison with their Python twins: numbers in, numbers out.
#include <stdlib.h>
#include <string.h>

#include "../../native/export.hpp"
#include "../../native/manoeuvring/actuators.hpp"
#include "../../native/manoeuvring/hull_forces.hpp"
#include "../../native/manoeuvring/mmg_3dof.hpp"
#include "../../native/manoeuvring/mmg_6dof.hpp"
#include "../../native/manoeuvring/propeller.hpp"
#include "../../native/manoeuvring/rudder.hpp"
#include "../../native/manoeuvring/torque_limit.hpp"
#include "../../native/manoeuvring/wind.hpp"
#include "../../native/numbers/crc32.hpp"
#include "../../native/numbers/line_reader.hpp"
#include "../../native/ship/coasting_law.hpp"

using namespace shipcollision;

namespace {

using Kernel = void (*)(const PreparedShip& ship, const double* in, double* out);

void put(double* out, const Six& six) { memcpy(out, six.at, sizeof six); }

Six take_six(const double* in) { return {{in[0], in[1], in[2], in[3], in[4], in[5]}}; }

Three take_three(const double* in) { return {{in[0], in[1], in[2]}}; }

Motion take_motion(const double* in) {
  return {take_three(in), take_three(in + 3), take_three(in + 6), take_three(in + 9)};
}

void put(double* out, const Motion& motion) { memcpy(out, &motion, sizeof motion); }

int take_freedom(double number) { return static_cast<int>(number); }

void tilted_inverse(const PreparedShip& ship, const double* in, double* out) {
  const int free = take_freedom(in[0]);
  Matrix tilted;
  tilt_inverse(ship.inverse(free), free, in[1], in[2], tilted);
  memcpy(out, tilted, sizeof tilted);
}

void level(const PreparedShip&, const double* in, double* out) {
  put(out, to_level(take_six(in), in[6]));
  put(out + 6, from_level(take_six(in), in[6]));
}

void straight_motion(const PreparedShip& ship, const double* in, double* out) {
  put(out, coast(take_motion(in), ship.r_bg, in[12]));
}

void restoring(const PreparedShip& ship, const double* in, double* out) {
  const Restoring restoring(ship.seakeeping);
  put(out, restoring(in[0], in[1], in[2], in[3], in[4]));
  out[6] = restoring.compute_roll_moment(in[1], in[2]);
}

void damping(const PreparedShip& ship, const double* in, double* out) {
  const Damping::Wrench wrench = Damping(ship.seakeeping)(in[0], in[1], in[2]);
  memcpy(out, &wrench, sizeof wrench);
}

void coasting(const PreparedShip& ship, const double* in, double* out) {
  CoastingLaw law;
  Motion after{};
  Text why;
  const Motion before = take_motion(in + 2);
  out[14] = law.set_up(ship, take_freedom(in[0]), static_cast<Coasting>(take_freedom(in[1])), why) &&
            law.coast(before, in[14], after, why);
  put(out, after);
  out[12] = law.is_straight(before);
  out[13] = law.keeps_course();
}

void actuator(const PreparedShip&, const double* in, double* out) {
  const Actuator actuator{in[0], in[1], in[2]};
  out[0] = actuator.follow(in[3], in[4], in[5]);
  out[1] = actuator.limit(in[4]);
}

void engine(const PreparedShip& ship, const double* in, double* out) {
  Gear gear{in[1], in[2]};
  const Engine engine = make_engine(ship);
  out[0] = engine.follow(in[0], gear, in[3], in[4]);
  out[1] = gear.side;
  out[2] = gear.waited;
  const Gear found = engine.find_gear(in[0]);
  out[3] = found.side;
  out[4] = found.waited;
  out[5] = make_steering_gear(ship).follow(in[0], in[3], in[4]);
}

void hull_forces(const PreparedShip& ship, const double* in, double* out) {
  const Planar forces = HullForces(ship)(in[0], in[1], in[2]);
  memcpy(out, &forces, sizeof forces);
}

void propeller(const PreparedShip& ship, const double* in, double* out) {
  const Propeller propeller(ship);
  out[0] = propeller.compute_inflow(in[0], in[1], in[2], in[3]);
  out[1] = propeller.compute_thrust(in[4], in[5]);
}

void torque_limit(const PreparedShip& ship, const double* in, double* out) {
  const TorqueLimit limit(ship.torque, ship.propeller.D_p);
  const Range range = limit.find_range(in[0]);
  out[0] = range.least;
  out[1] = range.most;
  out[2] = limit.is_surely_free(in[1], in[2]);
}

void rudder(const PreparedShip& ship, const double* in, double* out) {
  const Planar forces = Rudder(ship)(in[0], in[1], in[2], in[3], in[4], in[5]);
  memcpy(out, &forces, sizeof forces);
}

void wind(const PreparedShip& ship, const double* in, double* out) {
  const WindForces::Wrench wrench = WindForces(ship.windage, ship.L_oa)(in[0], in[1]);
  memcpy(out, &wrench, sizeof wrench);
}

// in: degrees of freedom, eta, nu, rudder angle, propeller speed, current and wind, external force, orders, h, substeps
void mmg(const PreparedShip& ship, const double* in, double* out) {
  const int free = take_freedom(in[0]);
  Mmg3Dof plane;
  Mmg6Dof space;
  Text why;
  if (!(free == 3 ? plane.set_up(ship, why) : space.set_up(ship, free, why))) return;
  const Mmg& mmg = free == 3 ? static_cast<const Mmg&>(plane) : space;
  Six eta = take_six(in + 1), nu = take_six(in + 7);
  Machines machines{in[13], in[14], mmg.engine.find_gear(in[14])};
  Surroundings around;
  around.current_north = in[15];
  around.current_east = in[16];
  around.wind_north = in[17];
  around.wind_east = in[18];
  around.external = take_six(in + 19);
  const Forces forces = mmg.compute_forces(eta, nu, machines, around);
  memcpy(out, &forces, sizeof forces);
  out[24] = mmg.limit_revolutions(eta, nu, in[14], around);
  out[25] = mmg.shortest_time;
  mmg.advance(eta, nu, machines, {in[25], in[26]}, around, in[27], static_cast<int>(in[28]));
  put(out + 26, eta);
  put(out + 32, nu);
  out[38] = machines.rudder_angle;
  out[39] = machines.propeller_speed;
  out[40] = machines.gear.side;
  out[41] = machines.gear.waited;
}

struct Named {
  const char* name;
  Kernel kernel;
};

constexpr Named KERNELS[] = {
    {"tilted_inverse", tilted_inverse},
    {"level", level},
    {"coast", straight_motion},
    {"restoring", restoring},
    {"damping", damping},
    {"coasting", coasting},
    {"actuator", actuator},
    {"engine", engine},
    {"hull_forces", hull_forces},
    {"propeller", propeller},
    {"torque_limit", torque_limit},
    {"rudder", rudder},
    {"wind", wind},
    {"mmg", mmg},
};

void copy_text(char* into, const Text& text) { memcpy(into, text.get(), text.size() + 1); }

// Reads a copy of the content, since reading changes it.
bool read(const char* content, size_t size, PreparedShip& ship, Text& why) {
  char* copy = static_cast<char*>(malloc(size + 1));
  memcpy(copy, content, size);
  copy[size] = '\0';
  const bool is_read = read_prepared_ship(copy, size, "some.ship", ship, why);
  free(copy);
  return is_read;
}

}  // namespace

// `count` evaluations of the kernel of that name for the ship of a prepared file, `ins` numbers in and `outs` out of
// each. False for an unknown name and for a file that is refused.
SHIPCOLLISION_EXPORT bool shipcollision_evaluate(const char* name, const char* content, size_t size, const double* in,
                                                 size_t ins, double* out, size_t outs, size_t count) {
  static PreparedShip ship;
  Text why;
  if (size > 0 && !read(content, size, ship, why)) return false;
  for (const Named& named : KERNELS) {
    if (strcmp(named.name, name) != 0) continue;
    for (size_t i = 0; i < count; ++i) named.kernel(ship, in + i * ins, out + i * outs);
    return true;
  }
  return false;
}

SHIPCOLLISION_EXPORT bool shipcollision_read_ship(const char* content, size_t size, char* message) {
  static PreparedShip ship;
  Text why;
  const bool is_read = read(content, size, ship, why);
  copy_text(message, is_read ? ship.name : why);
  return is_read;
}

// The number as repr writes it, as format 'g' does, and the text as repr has it.
SHIPCOLLISION_EXPORT void shipcollision_write_number(double number, int digits, char* exact, char* rounded) {
  Text text;
  text << number;
  copy_text(exact, text);
  text.clear();
  text.short_number(number, digits);
  copy_text(rounded, text);
}

SHIPCOLLISION_EXPORT void shipcollision_quote(const char* words, char* quoted) {
  Text text;
  text.quote(words);
  copy_text(quoted, text);
}

// A text and two more letters, where there is room.
SHIPCOLLISION_EXPORT void shipcollision_write_text(const char* words, char* written) {
  Text text;
  text << words << "xy";
  copy_text(written, text);
}

// The number that a line consists of; false for other text, which is changed.
SHIPCOLLISION_EXPORT bool shipcollision_read_real(char* text, double* number) {
  LineReader reader(text, strlen(text));
  return reader.next_line() && reader.real(*number) && reader.is_end_of_line();
}

SHIPCOLLISION_EXPORT uint32_t shipcollision_crc32(const void* bytes, size_t size) { return crc32(bytes, size); }
