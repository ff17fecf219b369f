#include "model.hpp"

#include <string.h>

#include "../numbers/elementary.hpp"
#include "../ship/prepared_ship.hpp"
#include "held_motions.hpp"
#include "mmg_3dof.hpp"
#include "mmg_6dof.hpp"

namespace shipcollision {
namespace {

constexpr double ABSURD_SPEED = 1e3;
constexpr int MAXIMUM_SUBSTEPS = 100000;
constexpr double STEEPEST = 1.4;

constexpr char NOT_FINITE[] = ": look at what feeds it; where it has failed, its message has the cause";

bool are_finite(const double* numbers, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (!isfinite(numbers[i])) return false;
  }
  return true;
}

// The start, or a time [s], for messages: it becomes text in a refusal alone, which costs more than a step.
struct When {
  bool is_start;
  double t;
};

constexpr When AT_THE_START = {true, 0.0};

When at_time(double t) { return {false, t}; }

Text& operator<<(Text& text, const When& when) {
  if (when.is_start) return text << "at the start";
  text << "at t = ";
  return text.short_number(when.t) << " s";
}

// A real or a vector by name, for messages.
struct Named {
  const char* name;
  const double* numbers;
  size_t count;
  bool is_list;
};

// False, and why, for the first of these that is not finite; `when` may be null.
bool check_finite(const Named* named, size_t count, const When* when, Text& why) {
  for (const Named* of = named; of != named + count; ++of) {
    if (are_finite(of->numbers, of->count)) continue;
    why << of->name << " = ";
    if (of->is_list) {
      why.list(of->numbers, of->count);
    } else {
      why << *of->numbers;
    }
    why << " ";
    if (when != nullptr) why << *when << " ";
    why << "must be finite" << NOT_FINITE;
    return false;
  }
  return true;
}

bool check_start(const ShipParameters& p, Text& why) {
  const Named named[] = {{"initial_position", p.initial_position, 3, true},
                         {"initial_attitude", p.initial_attitude, 3, true},
                         {"initial_velocity", p.initial_velocity, 3, true},
                         {"initial_rate", p.initial_rate, 3, true}};
  return check_finite(named, sizeof named / sizeof *named, nullptr, why);
}

bool check_inputs(const ShipInputs& i, const When& when, Text& why) {
  const Named named[] = {{"rudder_order", &i.rudder_order, 1, false},
                         {"propeller_order", &i.propeller_order, 1, false},
                         {"current", i.current, 2, true},
                         {"wind_speed", &i.wind_speed, 1, false},
                         {"wind_direction", &i.wind_direction, 1, false},
                         {"impulse", i.impulse, 6, true},
                         {"force", i.force, 6, true}};
  return check_finite(named, sizeof named / sizeof *named, &when, why);
}

bool is_absurd(const Six& nu, const PreparedShip& ship) {
  const auto& [u, v, w, p, q, r] = nu.at;
  const double fastest =
      max(max(max(abs(u), abs(v)), abs(w)), 0.5 * ship.L_pp * max(max(abs(p), abs(q)), abs(r)));
  return !(isfinite(u + v + w + p + q + r) && fastest < ABSURD_SPEED);
}

void put_too_fast(const Six& nu, Text& why) {
  why << "velocity ";
  why.list(nu.at, 3) << " m/s, rate ";
  why.list(nu.at + 3, 3) << " rad/s: the speed of midship and of the ship's ends must be below ";
  why.short_number(ABSURD_SPEED) << " m/s";
}

bool refuse_absurd(const Six& nu, const PreparedShip& ship, double t, Text& why) {
  if (!is_absurd(nu, ship)) return true;
  why << "in the step " << at_time(t) << " ";
  put_too_fast(nu, why);
  why << "; look at impulse and force";
  return false;
}

template <typename To, typename From>
void copy(To& to, const From& from) {
  static_assert(sizeof to <= sizeof from, "as many numbers");
  memcpy(&to, &from, sizeof to);
}

bool is_any(const Six& numbers) {
  for (double number : numbers.at) {
    if (number != 0.0) return true;
  }
  return false;
}

}  // namespace

// The whole state: pose eta (n), twist nu (b, over ground), ledger, machines, forces by origin.
struct ShipManoeuvring::State : OnHeap {
  Six eta, nu, impulse_applied;
  Machines machines;
  Forces forces;
};

// Everything that follows from the parameters, computed once.
struct ShipManoeuvring::SetUp : OnHeap {
  ShipParameters parameters;
  PreparedShip ship;
  int free;  // degrees of freedom
  bool is_coasting;
  CoastingLaw coasting;
  Mmg3Dof plane;
  Mmg6Dof space;
  double substep;

  const Mmg& mmg() const { return free == 3 ? static_cast<const Mmg&>(plane) : space; }

  bool follows_from(const ShipParameters& p) const {
    return strcmp(parameters.ship, p.ship) == 0 && free == p.degrees_of_freedom &&
           is_coasting == !p.hydrodynamics && parameters.coasting == p.coasting && substep == p.substep;
  }

  // nu + M^-1 impulse, in the motions that are free at that attitude.
  Six apply_impulse(const Six& eta, const Six& nu, const Six& impulse) const {
    Matrix rows;
    tilt_inverse(ship.inverse(free), free, eta[3], eta[4], rows);
    Six after;
    for (int i = 0; i < 6; ++i) {
      double sum = rows[i][0] * impulse[0];
      for (int j = 1; j < 6; ++j) sum += rows[i][j] * impulse[j];
      after[i] = nu[i] + sum;
    }
    return after;
  }

  // Refuses orders to a ship without propeller, rudder and engine.
  bool check_orders(const ShipInputs& inputs, const When& when, Text& why) const {
    if (is_coasting || mmg().propelled) return true;
    const char* const names[] = {"rudder", "propeller"};
    const double orders[] = {inputs.rudder_order, inputs.propeller_order};
    for (int k = 0; k < 2; ++k) {
      if (orders[k] == 0.0) continue;
      why << names[k] << "_order = " << orders[k] << " " << when << ", but ship " << ship.name << " has no ["
          << names[k] << "]: order 0, or add the tables [propeller], [rudder] and [engine] to its file";
      return false;
    }
    return true;
  }

  bool fill(const ShipParameters& p, const char* directory, Text& why);
  bool fill_motion(const ShipParameters& p, Text& why);
  bool check(const ShipInputs& inputs, double t, double h, int& substeps, Text& why) const;
  bool coast(const State& before, const ShipInputs& inputs, double t, double h, State& after,
             Text& why) const;
  bool advance(const State& before, const ShipInputs& inputs, double t, double h, int substeps, State& after,
               Text& why) const;
};

namespace {

Surroundings find_surroundings(const ShipInputs& i) {
  Surroundings around;
  around.current_north = i.current[0];
  around.current_east = i.current[1];
  if (i.wind_speed != 0.0) {  // where it blows to
    around.wind_north = -i.wind_speed * cos(i.wind_direction);
    around.wind_east = -i.wind_speed * sin(i.wind_direction);
  }
  copy(around.external, i.force);
  return around;
}

}  // namespace

// -- set-up ------------------------------------------------------------------------------------------------------

ShipManoeuvring::ShipManoeuvring() : set_up_(nullptr), state_(nullptr) {}

ShipManoeuvring::~ShipManoeuvring() {
  delete set_up_;
  delete state_;
}

bool ShipManoeuvring::SetUp::fill(const ShipParameters& p, const char* directory, Text& why) {
  parameters = p;
  free = p.degrees_of_freedom;
  is_coasting = !p.hydrodynamics;
  substep = p.substep;
  if (!(isfinite(substep) && substep > 0.0)) {
    why << "substep = " << substep << " s must be finite and greater than 0, e.g. 0.05";
    return false;
  }
  if (!load_prepared_ship(p.ship, directory, ship, why)) return false;
  if (free != 3 && free != 4 && free != 6) {
    why << "degrees_of_freedom = " << free << " must be 3 (surge, sway, yaw), 4 (and roll) or 6 (all)";
    return false;
  }
  return fill_motion(p, why);
}

bool ShipManoeuvring::SetUp::fill_motion(const ShipParameters& p, Text& why) {
  if (is_coasting) return coasting.set_up(ship, free, p.coasting, why);
  if (!(free == 3 ? plane.set_up(ship, why) : space.set_up(ship, free, why))) return false;
  if (substep > mmg().shortest_time) {
    why << "substep = " << substep << " s is too long for the heave, roll or pitch of ship " << ship.name
        << ": must be at most ";
    why.short_number(mmg().shortest_time, 3) << " s, a sixth of its shortest period";
    return false;
  }
  return true;
}

bool ShipManoeuvring::prepare(SetUp*& prepared, Text& why) const {
  if (set_up_ != nullptr && set_up_->follows_from(parameters)) {
    prepared = set_up_;
    return true;
  }
  prepared = new SetUp;
  if (prepared == nullptr) {
    why << "there is no memory for the ship";
    return false;
  }
  if (prepared->fill(parameters, directory, why)) return true;
  delete prepared;
  return false;
}

void ShipManoeuvring::keep(SetUp* prepared) {
  if (prepared == set_up_) return;
  delete set_up_;
  set_up_ = prepared;
}

void ShipManoeuvring::give_up(SetUp* prepared) const {
  if (prepared != set_up_) delete prepared;
}

bool ShipManoeuvring::reserve_state(SetUp* prepared, Text& why) {
  if (state_ == nullptr) state_ = new State;
  if (state_ != nullptr) return true;
  give_up(prepared);
  why << "there is no memory for the state of the ship";
  return false;
}

bool ShipManoeuvring::find_start(const SetUp& set_up, State& start, Text& warned, Text& why) const {
  const ShipParameters& p = parameters;
  start = {};
  memcpy(start.eta.at, p.initial_position, sizeof p.initial_position);
  memcpy(start.eta.at + 3, p.initial_attitude, sizeof p.initial_attitude);
  memcpy(start.nu.at, p.initial_velocity, sizeof p.initial_velocity);
  memcpy(start.nu.at + 3, p.initial_rate, sizeof p.initial_rate);
  if (is_absurd(start.nu, set_up.ship)) {
    why << "initial ";
    put_too_fast(start.nu, why);
    return false;
  }
  if (set_up.is_coasting) return true;
  if (!project_start(start.eta, start.nu, set_up.free, warned, why)) return false;
  if (abs(start.eta[4]) > STEEPEST) {
    why << "initial pitch angle = " << start.eta[4] << " rad must be below " << STEEPEST
        << " rad with hydrodynamics = true";
    return false;
  }
  if (!set_up.check_orders(inputs, AT_THE_START, why)) return false;
  const Mmg& mmg = set_up.mmg();
  const Surroundings around = find_surroundings(inputs);
  const double limited = mmg.engine.limit(inputs.propeller_order);
  const double n = mmg.limit_revolutions(start.eta, start.nu, limited, around);
  start.machines = {0.0, n, mmg.engine.find_gear(n)};
  start.forces = mmg.compute_forces(start.eta, start.nu, start.machines, around);
  return true;
}

bool ShipManoeuvring::initialise(Text& why) {
  why.clear();
  Text warned;
  if (!check_start(parameters, why) || !check_inputs(inputs, AT_THE_START, why)) return false;
  SetUp* prepared;
  if (!prepare(prepared, why)) return false;
  State start;
  if (!find_start(*prepared, start, warned, why)) {
    give_up(prepared);
    return false;
  }
  if (!reserve_state(prepared, why)) return false;
  keep(prepared);
  warning = warned;
  if (!warned.is_empty() && !set_up_->ship.warning.is_empty()) warning << "; ";
  warning << set_up_->ship.warning;
  publish(start);
  return true;
}

// -- a step ------------------------------------------------------------------------------------------------------

bool ShipManoeuvring::step(double t, double h, Text& why) {
  why.clear();
  if (state_ == nullptr || set_up_ == nullptr) {
    why << "step before initialise: call initialise() first";
    return false;
  }
  const SetUp& set_up = *set_up_;
  int substeps;
  if (!set_up.check(inputs, t, h, substeps, why)) return false;
  State pushed = *state_, after;
  Six pending;
  copy(pushed.impulse_applied, inputs.impulse);
  for (int k = 0; k < 6; ++k) pending[k] = inputs.impulse[k] - state_->impulse_applied[k];
  if (is_any(pending)) pushed.nu = set_up.apply_impulse(pushed.eta, pushed.nu, pending);
  if (!(set_up.is_coasting ? set_up.coast(pushed, inputs, t, h, after, why)
                           : set_up.advance(pushed, inputs, t, h, substeps, after, why))) {
    return false;
  }
  warning.clear();
  publish(after);
  return true;
}

// Number of substeps; false for a step or an input that cannot be used.
bool ShipManoeuvring::SetUp::check(const ShipInputs& i, double t, double h, int& substeps, Text& why) const {
  if (!(isfinite(t) && isfinite(h) && h > 0.0)) {
    why << "step from t = " << t << " s over h = " << h << " s: t must be finite and h greater than 0";
    return false;
  }
  const When when = at_time(t);
  if (!check_inputs(i, when, why)) return false;
  if (max(abs(i.current[0]), abs(i.current[1])) >= ABSURD_SPEED) {
    why << "current = ";
    why.list(i.current, 2) << " m/s " << when << " must be below ";
    why.short_number(ABSURD_SPEED) << " m/s";
    return false;
  }
  if (abs(i.wind_speed) >= ABSURD_SPEED) {
    why << "wind speed = " << i.wind_speed << " m/s " << when << " must be below ";
    why.short_number(ABSURD_SPEED) << " m/s";
    return false;
  }
  if (!check_orders(i, when, why)) return false;
  const double ratio = h / substep;
  if (!(ratio <= MAXIMUM_SUBSTEPS)) {
    why << "h = ";
    why.short_number(h) << " s takes ";
    why.short_number(ratio, 3) << " substeps of " << substep << " s, at most " << MAXIMUM_SUBSTEPS
                               << ": take shorter steps";
    return false;
  }
  substeps = static_cast<int>(max(1.0, ceil(ratio - 1e-9)));
  return true;
}

// Kick, drift, kick: of second order in h, and exact for a force along a straight course.
bool ShipManoeuvring::SetUp::coast(const State& before, const ShipInputs& inputs, double t, double h, State& after,
                                   Text& why) const {
  Six half, nu = before.nu;
  for (int k = 0; k < 6; ++k) half[k] = 0.5 * h * inputs.force[k];
  const bool is_pushed = is_any(half);
  if (is_pushed) nu = apply_impulse(before.eta, nu, half);
  if (!refuse_absurd(nu, ship, t, why)) return false;
  const Motion motion{{{before.eta[0], before.eta[1], before.eta[2]}},
                      {{before.eta[3], before.eta[4], before.eta[5]}},
                      {{nu[0], nu[1], nu[2]}},
                      {{nu[3], nu[4], nu[5]}}};
  Motion moved;
  if (!coasting.coast(motion, h, moved, why)) return false;
  after = before;
  for (int k = 0; k < 3; ++k) {
    after.eta[k] = moved.position[k];
    after.eta[3 + k] = moved.attitude[k];
    after.nu[k] = moved.velocity[k];
    after.nu[3 + k] = moved.rate[k];
  }
  if (!are_finite(after.eta.at, 6) || is_absurd(after.nu, ship)) {
    why << "the motion diverges in the step " << at_time(t) << ": shorten h = ";
    why.short_number(h) << " s, or look at velocity ";
    why.list(nu.at, 3) << " m/s and force ";
    why.list(inputs.force, 6);
    return false;
  }
  if (!is_pushed) return true;
  after.nu = apply_impulse(after.eta, after.nu, half);
  return refuse_absurd(after.nu, ship, t, why);
}

// The MMG model, in the degrees of freedom that are free.
bool ShipManoeuvring::SetUp::advance(const State& before, const ShipInputs& inputs, double t, double h, int substeps,
                                     State& after, Text& why) const {
  Six momentum;
  for (int k = 0; k < 6; ++k) momentum[k] = h * inputs.force[k];
  if (!refuse_absurd(apply_impulse(before.eta, before.nu, momentum), ship, t, why)) return false;
  after = before;
  const Surroundings around = find_surroundings(inputs);
  const Orders orders{inputs.rudder_order, inputs.propeller_order};
  mmg().advance(after.eta, after.nu, after.machines, orders, around, h, substeps);
  if (!are_finite(after.eta.at, 6) || !are_finite(after.nu.at, 6)) {
    why << "the motion diverges in the step " << at_time(t) << ": shorten substep = " << substep
        << " s, or look at velocity ";
    why.list(before.nu.at, 3) << " m/s and force ";
    why.list(inputs.force, 6);
    return false;
  }
  if (!refuse_absurd(after.nu, ship, t, why)) return false;
  if (abs(after.eta[4]) > STEEPEST) {
    why << "in the step " << at_time(t) << " the pitch angle comes to ";
    why.short_number(after.eta[4], 3) << " rad, must stay below " << STEEPEST << " rad; look at impulse and force";
    return false;
  }
  after.forces = mmg().compute_forces(after.eta, after.nu, after.machines, around);
  return true;
}

// -- outputs and state -------------------------------------------------------------------------------------------

void ShipManoeuvring::publish(const State& state) {
  *state_ = state;
  memcpy(outputs.position, state.eta.at, sizeof outputs.position);
  memcpy(outputs.attitude, state.eta.at + 3, sizeof outputs.attitude);
  memcpy(outputs.velocity, state.nu.at, sizeof outputs.velocity);
  memcpy(outputs.rate, state.nu.at + 3, sizeof outputs.rate);
  outputs.rudder_angle = state.machines.rudder_angle;
  outputs.propeller_speed = state.machines.propeller_speed;
  copy(outputs.impulse_applied, state.impulse_applied);
  copy(outputs.hull, state.forces.hull);
  copy(outputs.propeller, state.forces.propeller);
  copy(outputs.rudder, state.forces.rudder);
  copy(outputs.wind, state.forces.wind);
}

uint32_t ShipManoeuvring::file_checksum() const { return set_up_->ship.checksum; }

size_t ShipManoeuvring::state_size() { return sizeof(State); }

size_t ShipManoeuvring::get_state(void* bytes) const {
  if (state_ == nullptr) return 0;
  memcpy(bytes, state_, sizeof *state_);
  return sizeof *state_;
}

bool ShipManoeuvring::set_state(const void* bytes, size_t size, Text& why) {
  why.clear();
  if (size == 0) {
    delete state_;
    state_ = nullptr;
    return true;
  }
  if (size != sizeof(State)) {
    why << "the state is not of ShipManoeuvring: give what get_state() returned";
    return false;
  }
  SetUp* prepared;
  if (!prepare(prepared, why) || !reserve_state(prepared, why)) return false;
  keep(prepared);
  State state;
  memcpy(&state, bytes, sizeof state);
  publish(state);
  return true;
}

}  // namespace shipcollision
