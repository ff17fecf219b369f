#include "collisions.hpp"

namespace shipcollision {
namespace {

// The impact of one pair: at the middle of its contacts, with the largest approach of any.
Impact find_impact(double t, const Buffer<Contact>& contacts, const BodyState* states) {
  const int a = contacts[0].a, b = contacts[0].b;
  Three sum{};
  double closing = -INFINITE;
  for (const Contact& contact : contacts) {
    sum = sum + contact.point;
    closing = max(closing, -dot(mean_velocity(contact, states), contact.normal));
  }
  const double count = contacts.size();
  Impact impact;
  impact.time = t;
  impact.point = {{sum[0] / count, sum[1] / count, sum[2] / count}};
  impact.closing_speed = max(0.0, closing);
  impact.angle = heading_angle(states[a].predicted.R, states[b].predicted.R);
  impact.ship_a = a + 1;
  impact.ship_b = b + 1;
  return impact;
}

const Numbers* find_numbers(const Buffer<Numbers>& numbers, const Pair& pair) {
  for (const Numbers& each : numbers) {
    if (each.pair == pair) return &each;
  }
  return nullptr;
}

}  // namespace

double heading_angle(const Rows& R_a, const Rows& R_b) {
  const double n_a = R_a[0][0], e_a = R_a[1][0], n_b = R_b[0][0], e_b = R_b[1][0];
  const double c = (n_a * n_b + e_a * e_b) / (sqrt(n_a * n_a + e_a * e_a) * sqrt(n_b * n_b + e_b * e_b));
  const double bounded = min(1.0, max(-1.0, c));
  return atan2(sqrt((1.0 - bounded) * (1.0 + bounded)), bounded);
}

bool Collisions::set_up(double minimum_separation_time, const Answering* answering, int bodies) {
  separation_ = minimum_separation_time;
  answering_.clear();
  pairs_.clear();
  opened_.clear();
  count_ = scratches_ = 0;
  latest_ = {};
  return answering_.add(answering, bodies);
}

const Collisions::State* Collisions::find(const Pair& pair) const {
  for (const State& state : pairs_) {
    if (state.pair == pair) return &state;
  }
  return nullptr;
}

Collisions::State* Collisions::find_or_add(const Pair& pair) {
  for (State& state : pairs_) {
    if (state.pair == pair) return &state;
  }
  return pairs_.add({pair, 0, 0, 0.0, {}}) ? &pairs_.last() : nullptr;
}

void Collisions::close_old(double t) {
  for (State& state : pairs_) {
    if (state.scratch != 0 && t - state.last_contact > SCRATCH_PAUSE) state.scratch = 0;
    if (state.collision != 0 && t - state.last_contact >= separation_) state.collision = 0;
  }
}

bool Collisions::is_recorded(const Pair& pair) const {
  const Answering &a = answering_[pair.a], &b = answering_[pair.b];
  if (a.is_immovable && b.is_immovable) return true;
  if (!a.is_answered_once && !b.is_answered_once) return false;
  const State* state = find(pair);
  return state != nullptr && state->collision > 0;
}

void Collisions::register_contacts(double t, const Contact* contacts, int count, const BodyState* states,
                                   Buffer<Numbers>& numbers) {
  numbers.clear();
  for (int i = 0; i < count; ++i) {
    const Pair pair{contacts[i].a, contacts[i].b};
    if (find_numbers(numbers, pair) != nullptr) continue;
    State* state = find_or_add(pair);
    if (state == nullptr) return;
    if (state->collision == 0) {
      of_pair_.clear();
      for (int k = i; k < count; ++k) {
        if (pair == Pair{contacts[k].a, contacts[k].b}) of_pair_.add(contacts[k]);
      }
      if (of_pair_.is_empty()) return;
      state->collision = ++count_;
      state->impact = latest_ = find_impact(t, of_pair_, states);
      opened_.add(latest_);
    }
    if (state->scratch == 0) state->scratch = ++scratches_;
    state->last_contact = t;
    numbers.add({pair, state->collision, state->scratch, state->impact});
  }
}

void Collisions::mark_bodies_in_collision(bool* is_colliding) const {
  for (const State& state : pairs_) {
    if (state.collision == 0) continue;
    is_colliding[state.pair.a] = is_colliding[state.pair.b] = true;
  }
}

void Collisions::describe_opened(int i, const char* const* names, Text& said) const {
  const Impact& impact = opened_[i];
  said << "collision " << count_ - opened_.size() + 1 + i << ": " << names[impact.ship_a - 1] << " and "
       << names[impact.ship_b - 1] << " touch at t = ";
  said.fixed_number(impact.time, 3) << " s, north ";
  said.fixed_number(impact.point[0], 1) << " m, east ";
  said.fixed_number(impact.point[1], 1) << " m, closing at ";
  said.fixed_number(impact.closing_speed, 2) << " m/s, ";
  said.fixed_number(impact.angle * (180.0 / PI), 0) << " deg between their headings";
}

void Collisions::get_state(ByteWriter& bytes) const {
  bytes.value(count_);
  bytes.value(scratches_);
  bytes.value(latest_);
  bytes.list(pairs_);
}

bool Collisions::set_state(ByteReader& bytes) {
  opened_.clear();
  if (!bytes.value(count_) || !bytes.value(scratches_) || !bytes.value(latest_) || !bytes.list(pairs_)) return false;
  for (const State& state : pairs_) {
    const auto& [a, b] = state.pair;
    if (!(0 <= a && a < b && b < answering_.size())) return false;  // of a world with more bodies
  }
  return true;
}

}  // namespace shipcollision
