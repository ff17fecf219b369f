#include "impact.hpp"

#include <string.h>

namespace shipcollision {
namespace {

constexpr double INSTANT = 1e-9;  // [s] Nothing moves by more than rounding in it. Longer, and the hulls turn meanwhile.

constexpr double FASTEST = 50.0;
constexpr double FASTEST_TURN = 1.0;
constexpr double SLOWEST_CLOSING = 0.05;
constexpr double GRAZING = 0.03;

constexpr double OVERLAP = 0.012;  // [m] of the sections at first, as encounters/targeting.py has it
constexpr double DEEPER = 0.002;   // [m] by which the second attempt overlaps more than the gap that was left
constexpr double DEEPEST = 1.0;    // [m] Corners of hulls are rounded by centimetres; more is another place
constexpr int ATTEMPTS = 12;

constexpr double DEGREE = PI / 180.0;

bool check_range(const char* name, double value, double least, double most, const char* remedy, Text& why) {
  if (least <= value && value <= most) return true;
  why << name << " = ";
  why.short_number(value) << " must be ";
  why.short_number(least) << " to ";
  why.short_number(most) << ": " << remedy;
  return false;
}

bool check_case(const ImpactCase& given, Text& why) {
  const char *const speed = "give metres per second", *const rate = "give radians per second";
  return check_range("angle_deg", given.angle_deg, 0.0, 180.0, "0 is overtaking, 180 head-on", why) &&
         check_range("at", given.at, -0.5, 0.5, "-0.5 is the target's stern, 0.5 its stem", why) &&
         check_range("own_speed", given.own_speed, -FASTEST, FASTEST, speed, why) &&
         check_range("own_sway", given.own_sway, -FASTEST, FASTEST, speed, why) &&
         check_range("own_yaw_rate", given.own_yaw_rate, -FASTEST_TURN, FASTEST_TURN, rate, why) &&
         check_range("target_speed", given.target_speed, -FASTEST, FASTEST, speed, why) &&
         check_range("target_sway", given.target_sway, -FASTEST, FASTEST, speed, why) &&
         check_range("target_yaw_rate", given.target_yaw_rate, -FASTEST_TURN, FASTEST_TURN, rate, why) &&
         check_range("heading_deg", given.heading_deg, -360.0, 720.0, "clockwise from north", why) &&
         check_range("friction", given.friction, 0.0, 10.0, "Coulomb's coefficient, 0.1 to 0.6 for steel", why) &&
         check_range("restitution", given.restitution, 0.0, 1.0,
                     "the share of the approach that comes back, 0 for ships that crush", why);
}

InPlan turn(const InPlan& p, double angle) {
  const double c = cos(angle), s = sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

// Velocity of the point p of a ship in plan, both in b; motion: surge, sway, yaw rate.
InPlan velocity_at(const Three& motion, const InPlan& p) {
  return {motion[0] - motion[2] * p.y, motion[1] + motion[2] * p.x};
}

Three velocity_of(const ShipState& ship, const Three& point) {
  const Rows R = rotation_rows(ship.attitude[0], ship.attitude[1], ship.attitude[2]);
  return rotate(R, ship.velocity) + cross(rotate(R, ship.rate), point - ship.position);
}

Three in_hull(const ShipState& ship, const Three& point) {
  return rotate_back(rotation_rows(ship.attitude[0], ship.attitude[1], ship.attitude[2]), point - ship.position);
}

bool copy_path(char (&into)[LONGEST_STRING], const char* path) {
  if (strnlen(path, LONGEST_STRING) == LONGEST_STRING) return false;
  strcpy(into, path);
  return true;
}

void write_reason(const Text& why, char (&reason)[LONGEST_REASON]) {
  size_t size = why.size() < LONGEST_REASON ? why.size() : LONGEST_REASON - 1;
  while (size < why.size() && size > 0 && (why.get()[size] & 0xC0) == 0x80) --size;  // not within a character
  memcpy(reason, why.get(), size);
}

}  // namespace

// A case with the target's place at n's origin.
struct Impacts::Placed {
  InPlan own, target;            // CO of both in n, where the sections touch
  double own_heading, heading;   // [rad]
  Three own_motion, motion;      // surge, sway, yaw rate
  InPlan normal;                 // from the target outwards, in n
};

bool Impacts::prepare(const ImpactShip& own, const ImpactShip& target, Text& why) {
  const char* const names[] = {"own", "target"};
  if (!collision_.name_ships(names, 2, why)) return false;
  const ImpactShip* const ships[] = {&own, &target};
  for (int i = 0; i < 2; ++i) {
    CollisionShipParameters& of_ship = collision_.parameters.ships[i];
    of_ship.degrees_of_freedom = ships[i]->degrees_of_freedom;
    if (!copy_path(of_ship.ship, ships[i]->file)) {
      why << "the path of a prepared ship is too long";
      return false;
    }
  }
  give_state(0, {-2e4, 0.0}, 0.0, {});
  give_state(1, {2e4, 0.0}, 0.0, {});
  if (!collision_.initialise(why)) return false;
  if (is_ready(own, target)) return true;
  why << "there is no memory for the impacts";
  return false;
}

bool Impacts::is_ready(const ImpactShip& own, const ImpactShip& target) {
  L_oa_ = target.L_oa;
  middle_ = target.middle;
  own_section_.add(own.section, own.corner_count);
  target_section_.add(target.section, target.corner_count);
  first_state_.resize(static_cast<int>(collision_.state_size()));
  if (memory_.is_exhausted) return false;
  collision_.get_state(first_state_.data(), static_cast<size_t>(first_state_.size()));
  return true;
}

void Impacts::run(const ImpactCase* cases, size_t count, ImpactRow* rows) {
  for (size_t i = 0; i < count; ++i) {
    Text why;
    memset(static_cast<void*>(&rows[i]), 0, sizeof rows[i]);
    rows[i].status = answer(cases[i], rows[i], why);
    write_reason(why, rows[i].reason);
  }
}

ImpactStatus Impacts::answer(const ImpactCase& given, ImpactRow& row, Text& why) {
  Placed placed;
  if (!check_case(given, why)) return ImpactStatus::out_of_range;
  const ImpactStatus status = place(given, placed, why);
  if (status != ImpactStatus::done) return status;
  collision_.parameters.friction = given.friction;
  collision_.parameters.restitution = given.restitution;
  double overlap = OVERLAP, deeper = DEEPER;
  for (int attempt = 0; attempt < ATTEMPTS && overlap < DEEPEST; ++attempt) {
    if (!touch(placed, overlap, why)) return ImpactStatus::refused;
    if (collision_.outputs.contact_count > 0) return finish(placed, row, why);
    overlap += max(collision_.outputs.clearance, 0.0) + deeper;  // it is negative where hulls overlap
    deeper *= 2.0;  // detection may miss a shallow overlap of two edges
  }
  why << "the collision model finds no contact at the place: change the angle by a degree or two, or the place";
  return ImpactStatus::no_contact;
}

// The answered contact; one along whose normal the hulls part is refused.
ImpactStatus Impacts::finish(const Placed& placed, ImpactRow& row, Text& why) const {
  if (collision_.outputs.impact.closing_speed > 0.0) {
    fill(placed, row);
    return ImpactStatus::done;
  }
  why << "the hulls touch at the place along a normal on which they part: change the angle, the speeds, the side or the "
         "place";
  return ImpactStatus::not_closing;
}

// Where the sections touch; ships that do not close there are refused.
ImpactStatus Impacts::place(const ImpactCase& given, Placed& placed, Text& why) const {
  const double angle = (given.is_starboard != 0 ? -given.angle_deg : given.angle_deg) * DEGREE;
  const Place struck = locate_place(target_section_, middle_ + given.at * L_oa_, given.is_starboard != 0);
  const PlanContact contact = find_contact(struck, own_section_, angle);
  placed.heading = given.heading_deg * DEGREE;
  placed.own_heading = placed.heading + angle;
  placed.own_motion = {{given.own_speed, given.own_sway, given.own_yaw_rate}};
  placed.motion = {{given.target_speed, given.target_sway, given.target_yaw_rate}};
  placed.target = -1.0 * turn(struck.point, placed.heading);
  placed.own = turn(contact.position - struck.point, placed.heading);
  placed.normal = turn(contact.normals[0], placed.heading);
  const InPlan own_point = turn(struck.point - contact.position, -angle);
  const InPlan velocity =
      turn(velocity_at(placed.own_motion, own_point), angle) - velocity_at(placed.motion, struck.point);
  double closing = INFINITE;
  for (int i = 0; i < contact.normal_count; ++i) closing = min(closing, -dot(velocity, contact.normals[i]));
  const double least = max(SLOWEST_CLOSING, GRAZING * norm(velocity));
  if (closing >= least) return ImpactStatus::done;
  why << "at the place they close at ";
  why.fixed_number(0.01 * round(100.0 * closing) + 0.0, 2) << " m/s, at least ";
  why.fixed_number(least, 2) << " m/s is needed; change the angle, the speeds, the side or the place";
  return ImpactStatus::not_closing;
}

// One step of the collision model, from its first state, with sections that overlap by so much [m].
bool Impacts::touch(const Placed& placed, double overlap, Text& why) {
  give_state(0, placed.own - overlap * placed.normal, placed.own_heading, placed.own_motion);
  give_state(1, placed.target, placed.heading, placed.motion);
  if (collision_.rewind(first_state_.data(), static_cast<size_t>(first_state_.size()))) {
    return collision_.step(0.0, INSTANT, why);
  }
  why << "there is no memory for the first state";
  return false;
}

void Impacts::give_state(int ship, const InPlan& position, double heading, const Three& motion) {
  ShipState& state = collision_.inputs.ships[ship];
  state.position = {{position.x, position.y, 0.0}};
  state.attitude = {{0.0, 0.0, heading}};
  state.velocity = {{motion[0], motion[1], 0.0}};
  state.rate = {{0.0, 0.0, motion[2]}};
}

void Impacts::fill(const Placed& placed, ImpactRow& row) const {
  const ShipState &own = collision_.inputs.ships[0], &target = collision_.inputs.ships[1];
  const CollisionOutputs& out = collision_.outputs;
  const ShipPost &own_post = out.ships[0], &target_post = out.ships[1];
  row.own_position = own.position;
  row.target_position = target.position;
  row.own_heading = placed.own_heading;
  row.target_heading = placed.heading;
  row.point = out.impact.point;
  row.own_point = in_hull(own, row.point);
  row.target_point = in_hull(target, row.point);
  row.own_before = own.nu();
  row.target_before = target.nu();
  row.own_after = join(own_post.velocity, own_post.rate);
  row.target_after = join(target_post.velocity, target_post.rate);
  row.own_impulse = own_post.impulse;
  row.target_impulse = target_post.impulse;
  row.contacts = out.contact_count;
  double strongest = -1.0;
  for (int i = 0; i < out.contact_count; ++i) {
    const ContactOutput& contact = out.contacts[i];
    row.impulse = row.impulse + contact.impulse;
    row.impulse_normal += contact.impulse_normal;
    row.impulse_tangential += contact.impulse_tangential;
    if (contact.impulse_normal <= strongest) continue;
    strongest = contact.impulse_normal;
    row.normal = contact.normal;
  }
  row.relative_velocity = velocity_of(own, row.point) - velocity_of(target, row.point);
  row.closing_speed = out.impact.closing_speed;
  row.angle = out.impact.angle;
  row.energy = out.energy.dissipated;
  row.energy_normal = out.energy.normal;
  row.energy_tangential = out.energy.tangential;
  row.offset = sqrt(row.point[0] * row.point[0] + row.point[1] * row.point[1]);
  row.residual = out.solver.residual;
}

}  // namespace shipcollision
