#include "delayed_impulses.hpp"

namespace shipcollision {

bool describe_delayed_impulse(double t, double H, double speed, const char* a, const char* b, double thin, Text& said) {
  const double way = H * speed;
  if (!(way > thin)) return false;
  said << "an impulse between ";
  said.quote(a) << " and ";
  said.quote(b) << " was applied one step late, at t = ";
  said.short_number(t) << " s: they moved ";
  said.short_number(way, 4) << " m on, and the thinner of them is ";
  said.short_number(thin, 2) << " m thick, so that one may have passed the other; take steps below ";
  said.short_number(H * thin / way, 1) << " s, or a master that steps the collision model first";
  return true;
}

}  // namespace shipcollision
