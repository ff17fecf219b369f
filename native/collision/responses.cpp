#include "responses.hpp"

namespace shipcollision {

namespace {

constexpr double AT_REST = 1e-12;
constexpr double PRESSING = 2.25;

// Approach [m/s] below which nothing springs back: LEAST_REBOUNDING_APPROACH, or what other forces make of rest in
// PRESSING communication steps.
double find_least_rebounding_approach(const Contact* contacts, int count, const BodyState* states) {
  double pressed = 0.0;
  for (int i = 0; i < count; ++i) {
    const Contact& c = contacts[i];
    const BodyState &a = states[c.a], &b = states[c.b];
    double closing = 0.0;  // the mean over the step is half of its end
    if (a.has_velocity_bias) closing += 2.0 * dot(c.normal, multiply(c.G_a, a.velocity_bias));
    if (b.has_velocity_bias) closing -= 2.0 * dot(c.normal, multiply(c.G_b, b.velocity_bias));
    pressed = max(pressed, closing);
  }
  return max(LEAST_REBOUNDING_APPROACH, PRESSING * pressed);
}

}  // namespace

PgsResponse::PgsResponse(Memory& memory)
    : contacts_(memory), velocity_(memory), P_(memory), delassus_(memory), held_(memory), gauss_seidel_(memory),
      poisson_(memory, gauss_seidel_) {}

bool PgsResponse::reserve(int contacts) {
  return P_.resize(3 * contacts) && delassus_.reserve(contacts) && held_.reserve(contacts) &&
         gauss_seidel_.reserve(contacts) && poisson_.reserve(contacts);
}

void PgsResponse::respond(const ContactProblem& problem, ContactCaches& caches, ContactSolution& solution) {
  contacts_.clear();
  for (int i = 0; i < problem.count; ++i) {
    problem.detector.contacts(problem.pairs[i], problem.states, caches.last_normals, contacts_);
  }
  solve(contacts_.data(), contacts_.size(), problem, caches, solution);
}

void PgsResponse::solve(const Contact* contacts, int count, const ContactProblem& problem, ContactCaches& caches,
                        ContactSolution& solution) {
  solution.impulses.clear();
  solution.residual = 0.0;
  solution.sweeps = 0;
  if (count == 0 || !velocity_.resize(3 * count) || !solution.impulses.resize(count)) return;
  const BodyState* states = problem.states;
  for (int i = 0; i < count; ++i) solution.impulses[i] = {contacts[i], {}};
  approach_velocities(contacts, count, states, velocity_.data());
  const double approach = find_approach(velocity_.data(), velocity_.size());
  if (approach <= AT_REST || !reserve(count)) return;  // touching, but parting, or stopped in the substep before
  const Dense& W = delassus_.find_operator(contacts, count, states);
  const Dense* H = delassus_.find_held_operator(contacts, count, states);
  WorkLimit work = caches.work.lend();
  held_.has_start = !caches.warm_starts.is_empty();
  caches.warm_starts.guess_impulses(contacts, count, held_.start.data());
  if (H != nullptr) yield_to_friction(W, velocity_.data(), problem.friction, *H, gauss_seidel_, work, held_);
  const double e =
      approach >= find_least_rebounding_approach(contacts, count, states) ? problem.restitution : 0.0;
  const Solution found = poisson_.solve(
      H != nullptr ? held_.W : W, velocity_.data(), problem.friction, e, held_.has_start ? held_.start.data() : nullptr,
      H != nullptr ? held_.slip.data() : nullptr, work, P_.data());
  caches.work.settle(work);
  for (int i = 0; i < count; ++i) {
    solution.impulses[i].P = rotate_back(contacts[i].axes, {{P_[3 * i], P_[3 * i + 1], P_[3 * i + 2]}});
  }
  solution.residual = found.residual;
  solution.sweeps = found.sweeps;
  caches.warm_starts.keep_impulses(solution.impulses.data(), count);
}

}  // namespace shipcollision
