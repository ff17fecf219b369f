// The contact points of a communication step: the twin of shipcollision_fmu/collision/contact_points.py.
#pragma once

#include "collisions.hpp"
#include "solvers/impact_process.hpp"

namespace shipcollision {

constexpr double SAME_PLACE = 2.0;

class ContactPoints {
 public:
  explicit ContactPoints(Memory& memory) : points_(memory), parts_(memory), is_free_(memory), order_(memory),
                                           of_pairs_(memory) {}

  bool is_empty() const { return points_.is_empty(); }
  int count() const { return points_.size(); }
  bool are_active() const;     // whether hulls touch
  int latest_scratch() const;  // 0: none

  // Begins a communication step.
  void clear();
  // Takes in the impulses of a substep. losses: at each of them.
  void merge_impulses(const Impulse* impulses, const Loss* losses, int count, const Buffer<Numbers>& numbers);
  // Takes in one impulse more; a fender's without a collision.
  void merge_contact_point(const Impulse& impulse, double energy);
  // Leaves at most so many points.
  void fit(int most);
  // Writes the points to the outputs, and zeros to the outputs that are left.
  void fill(Buffer<ContactOutput>& outputs) const;

 private:
  static constexpr int FIRST_PARTS = 64;  // for which there is room from the first on

  // An impulse that was merged into a point. next: of the same point, -1 for the last.
  struct Part {
    Three P, normal, place, r_a, r_b, at;
    int next;
  };
  struct Point {
    int a, b;
    int first, last;  // parts
    double gap;       // of the last
    Three P;
    double P_n;
    Three P_t;
    double energy;
    int collision, scratch;
    Impact impact;
  };
  struct Located {
    Three place, r_a, r_b;
  };

  bool make(const Impulse& impulse, double energy, Point& made);
  // Index of the nearest of the first `count` points at the place of the new one; -1: none.
  int find_same_place(const Point& added, int count, bool only_free) const;
  Point merge(const Point& earlier, const Point& later);
  Located locate(const Point& point) const;
  Three measure_couple(const Point& point, const Three& place) const;
  void fill_one(const Point& point, ContactOutput& out) const;

  Buffer<Point> points_;
  Buffer<Part> parts_;
  Buffer<bool> is_free_;
  Buffer<int> order_;
  Buffer<Point> of_pairs_;
};

}  // namespace shipcollision
