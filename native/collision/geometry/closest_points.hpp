// Closest points of convex hulls, by Bullet: the twin of shipcollision_fmu/collision/geometry/closest_points.py.
#pragma once

#include "../../memory.hpp"
#include "narrow_phase.hpp"

namespace shipcollision {

// The hulls of some ships, each of convex parts, and where they are. Results depend on hulls, poses and arguments alone.
class PlacedHulls : public OnHeap {
 public:
  // parts: of each ship, how many; corners: of each part, how many; coordinates: of each corner x, y, z in b about CO [m].
  // Bullet's own hull of a part is what counts: its vertices are those corners rounded to 1/10216 of the hull's extent.
  // Every ship starts at the origin of n, heading north.
  PlacedHulls(int ships, const int* parts, const int* corners, const double* coordinates);
  ~PlacedHulls();
  PlacedHulls(const PlacedHulls&) = delete;
  PlacedHulls& operator=(const PlacedHulls&) = delete;

  int count_parts(int ship) const;
  // The vertices of a part as Bullet has them, in b; returns how many there are, writes at most `capacity`.
  int get_corners(int ship, int part, double* coordinates, int capacity) const;

  // CO at x in n [m], with the rows of R_nb.
  void place(int ship, const double x[3], const double R_nb[9]);
  void place(int ship, const Pose& pose) { place(ship, pose.x.at, pose.R.at[0].at); }

  // Whether two parts are not farther apart than `distance` [m]; then `found` is filled.
  bool closest_of_parts(int a, int part_a, int b, int part_b, double distance, Closest& found) const;
  // Every pair of parts not farther apart than `distance`, at most as many as count_parts(a) * count_parts(b).
  int closest(int a, int b, double distance, Closest* found) const;
  // Least distance [m] between two ships, negative in overlap, at most `cap`.
  double gap(int a, int b, double cap) const;
  // Whether two ships are nearer than `distance` [m] by points that are known already; false says nothing.
  bool are_surely_within(int a, int b, double distance) const;

 private:
  // Of the latest answers, how many are kept for each part, and the logarithms of the least and the largest number.
  static constexpr int ANSWERS_OF_PART = 4;
  static constexpr int LEAST_BITS = 4;
  static constexpr int MOST_BITS = 12;

  struct Ship;
  struct Answer;

  Answer& find_answer(int part_a, int part_b) const;

  Ship* ships_;
  int parts_ = 0;    // of all ships
  Answer* answers_;  // a table of 2^answer_bits_; null without memory
  int answer_bits_;
};

}  // namespace shipcollision
