// When two moving hulls touch first: the twin of shipcollision_fmu/collision/geometry/first_touch.py.
#pragma once

#include "../../ship/hull/solid.hpp"
#include "../dynamics/body_state.hpp"
#include "closest_points.hpp"

namespace shipcollision {

constexpr double TOUCH = 0.5 * MARGIN;

// The last shallow normal of a pair: which body carries it, 0: a, 1: b, and the normal in b of that body.
struct LastNormal {
  int carrier;
  Three normal;
};

struct MovingHull {
  int index;  // of the body
  const HullMesh* hull;
  const BodyState* state;

  Pose pose_at(double tau) const { return state->fixed ? state->predicted : state->predict_pose(tau); }
  double turning() const { return state->fixed ? 0.0 : norm(state->predicted_motion().omega); }
};

// Time [s] at which two hulls first touch within h [s], or touch on; false: they do not. speed: bound of the relative
// speed of any two points; growth: overlap [m] at which parts that touch already touch on; carried: null without one.
bool find_first_touch(PlacedHulls& narrow_phase, const MovingHull& a, const MovingHull& b, double h, double speed,
                      double growth, const LastNormal* carried, double& touch);

// Gap [m] of two touching parts before the bodies were last advanced, along the normal of their closest points now.
double gap_before(const Closest& closest, const HullMesh& hull_a, const HullMesh& hull_b, const BodyState& a,
                  const BodyState& b);

}  // namespace shipcollision
