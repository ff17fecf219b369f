// Compound hulls, several convex parts joined in one: the twin of
// shipcollision_fmu/collision/geometry/compound_hull.py.
#pragma once

#include "../../ship/hull/solid.hpp"
#include "../dynamics/contact.hpp"
#include "contact_place.hpp"
#include "narrow_phase.hpp"

namespace shipcollision {

// The parts of one hull, which outlives it, and which of their faces can be touched.
class CompoundHull {
 public:
  CompoundHull(const HullMesh& hull, Memory& memory);

  static void* operator new(size_t size) noexcept { return malloc(size); }
  static void operator delete(void* memory) { free(memory); }

  const HullMesh& hull() const { return hull_; }
  bool is_whole() const { return is_whole_; }

  // Whether the hull can be touched at p, on the surface of a part, with the outward normal `direction`.
  bool supports(int part, const Three& p, const Three& direction) const;
  // Whether another part lies just before the point p of a part, along `direction`.
  bool covers(int part, const Three& p, const Three& direction) const;
  // Whether the face in plane k of a part can be touched.
  bool is_outer(int part, int k) const { return !is_whole_ && outer_[hull_.part(part).first_plane + k]; }

 private:
  bool holds(int part, const Three& p, double margin) const;
  Three move_off_the_rim(int part, int face, const Three& p) const;
  bool can_be_touched(int part, int k) const;

  const HullMesh& hull_;
  bool is_whole_;
  Buffer<Three> middles_;  // of the face in every plane
  Buffer<bool> outer_;
};

// What a compound hull's closest points and contacts are replaced by; keeps memory for it.
class Support {
 public:
  explicit Support(Memory& memory)
      : in_a_(memory), in_b_(memory), faces_(memory), found_(memory), places_(memory), groups_(memory),
        points_(memory), outline_(memory), kept_(memory) {}

  // Leaves of the closest points of hulls a and b those that the hulls as a whole support, deepest first; without any
  // support, all of them.
  void select_supported(Buffer<Closest>& touching, const CompoundHull& one, const CompoundHull& other,
                        const BodyState& a, const BodyState& b);
  // Leaves of the contacts from number `begin` on, with one normal in one plane, the corners of their common outline.
  void merge_coplanar(Buffer<Contact>& contacts, int begin);

 private:
  struct Face {
    Three normal;
    double depth;
  };

  bool find_supported(const Closest& closest, const CompoundHull& one, const CompoundHull& other, const BodyState& a,
                      const BodyState& b, Closest& found);
  void find_outer_faces(const Closest& closest, const CompoundHull& one, const CompoundHull& other, const BodyState& a,
                        const BodyState& b);
  void keep_outline(const Buffer<Contact>& contacts, int begin, int group);

  Buffer<Three> in_a_, in_b_;
  Buffer<Face> faces_;
  Buffer<Closest> found_;
  ContactPlaces places_;
  Buffer<int> groups_;
  Buffer<Point> points_, outline_;
  Buffer<Contact> kept_;
};

// The corners of a part in n, at the predicted pose of the body.
void place_part(const HullPart& part, const BodyState& state, Buffer<Three>& placed);

}  // namespace shipcollision
