// Steps of the native collision model, timed one by one: compiled with the library by native_collision.py.
#include <time.h>

#include "collision/model.hpp"
#include "export.hpp"

using namespace shipcollision;

namespace {

constexpr int STATE = 12;  // position, attitude, velocity and rate of a ship

double read_clock() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace

// Makes `steps` steps of H [s] with the parameters of the model, `rounds` times from its initialisation on. states: of
// each step and each ship, in which the ships are put; or those of the first step alone, after which the ships go where
// the model says, and `push` [m/s] is added to surge and sway of the first one. What was issued counts as applied.
// took: the least time of each step in all rounds [us]; contacts: how many there were in each. False for a refusal.
SHIPCOLLISION_EXPORT bool shipcollision_time_steps(void* collision, int steps, double H, const double* states,
                                                   bool has_all, const double* push, int rounds, double* took,
                                                   int* contacts) {
  ShipCollision& model = *static_cast<ShipCollision*>(collision);
  const int ships = model.ship_count();
  Text why;
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < steps; ++k) {
      for (int i = 0; i < ships; ++i) {
        ShipState& given = model.inputs.ships[i];
        const ShipPost& post = model.outputs.ships[i];
        if (k == 0 || has_all) {
          Three* const parts[] = {&given.position, &given.attitude, &given.velocity, &given.rate};
          const double* state = states + (k * ships + i) * STATE;
          for (int part = 0; part < 4; ++part, state += 3) *parts[part] = {{state[0], state[1], state[2]}};
        } else {
          given = {post.position, post.attitude, post.velocity, post.rate, {}};
          given.velocity[0] += i == 0 ? push[0] : 0.0;
          given.velocity[1] += i == 0 ? push[1] : 0.0;
        }
        given.impulse_applied = k == 0 ? Six{} : post.impulse;
      }
      if (k == 0 && !model.initialise(why)) return false;
      const double begin = read_clock();
      const bool is_done = model.step(k * H, H, why);
      const double spent = read_clock() - begin;
      if (!is_done) return false;
      took[k] = round == 0 || spent < took[k] ? spent : took[k];
      contacts[k] = model.outputs.contact_count;
    }
  }
  return true;
}
