#include "detection.hpp"

#include "../dynamics/contact_frame.hpp"
#include "thickness.hpp"

namespace shipcollision {
namespace {

constexpr double FOLLOWS = 0.94;
constexpr double STEEP = 0.7;
constexpr double SAME_POINT = 0.5;
constexpr double FLUSH = 1e-6;
constexpr double SMALL = 15.0;
constexpr size_t BULLET_BYTES = 100000;     // that Bullet takes at most for hulls, and more for each corner
constexpr size_t BULLET_CORNER_BYTES = 2000;

// Bullet does not look whether it has got memory: whether there is enough for hulls of so many corners.
bool has_room(int corners) {
  void* volatile probe = malloc(BULLET_BYTES + static_cast<size_t>(corners) * BULLET_CORNER_BYTES);
  free(probe);
  return probe != nullptr;
}

// The last normal of a pair in n, as it has turned with the hull that carries it.
Three turn_with_hull(const LastNormal& last, const Pair& pair, const BodyState* states) {
  return rotate(states[last.carrier == 0 ? pair.a : pair.b].predicted.R, last.normal);
}

LastNormal carry(int carrier, const Three& normal, const Pair& pair, const BodyState* states) {
  return {carrier, rotate_back(states[carrier == 0 ? pair.a : pair.b].predicted.R, normal)};
}

// Leaves contacts more than `apart` [m] from each other, the first of those that are nearer.
void remove_duplicates(Buffer<Contact>& contacts, int begin, double apart) {
  int count = begin;
  for (int i = begin; i < contacts.size(); ++i) {
    bool is_new = true;
    for (int k = begin; k < count; ++k) is_new = is_new && norm(contacts[i].point - contacts[k].point) > apart;
    if (is_new) contacts[count++] = contacts[i];
  }
  contacts.cut(count);
}

const Closest& find_deepest(const Buffer<Closest>& touching) {
  const Closest* deepest = touching.begin();
  for (const Closest& closest : touching) {
    if (closest.gap < deepest->gap) deepest = &closest;
  }
  return *deepest;
}

}  // namespace

const LastNormal* LastNormals::find(const Pair& pair) const {
  for (const Row& row : rows_) {
    if (row.pair == pair) return &row.last;
  }
  return nullptr;
}

void LastNormals::set(const Pair& pair, const LastNormal& last) {
  for (Row& row : rows_) {
    if (row.pair == pair) {
      row.last = last;
      return;
    }
  }
  rows_.add({pair, last});
}

void LastNormals::remove(const Pair& pair) {
  for (int i = 0; i < rows_.size(); ++i) {
    if (rows_[i].pair == pair) return rows_.remove(i);
  }
}

Detector::Detector(Memory& memory)
    : memory_(memory), hulls_(memory), widths_(memory), scales_(memory), lately_touching_(memory), near_(memory),
      touching_(memory), hidden_(memory), in_a_(memory), in_b_(memory), part_(memory), places_(memory), plans_(memory),
      support_(memory) {}

Detector::~Detector() {
  for (CompoundHull* hull : hulls_) delete hull;
  delete narrow_phase_;
}

bool Detector::set_up(const HullMesh* const* hulls, int count) {
  Buffer<int> parts(memory_), corners(memory_);
  Buffer<Three> coordinates(memory_);
  for (int i = 0; i < count; ++i) {
    const HullMesh& hull = *hulls[i];
    CompoundHull* compound = new CompoundHull(hull, memory_);
    if (compound == nullptr || !hulls_.add(compound)) {
      delete compound;
      memory_.is_exhausted = true;
      return false;
    }
    widths_.add(least_width(hull));
    scales_.add(min(1.0, hull.extent / SMALL));
    parts.add(hull.part_count());
    for (int k = 0; k < hull.part_count(); ++k) corners.add(hull.part(k).corner_count);
    coordinates.add(hull.corners(), hull.corner_count());
    most_parts_ = hull.part_count() > most_parts_ ? hull.part_count() : most_parts_;
  }
  near_.reserve(most_parts_ * most_parts_);
  if (memory_.is_exhausted) return false;
  if (has_room(coordinates.size())) {
    narrow_phase_ = new PlacedHulls(count, parts.data(), corners.data(), coordinates.data()->at);
  }
  memory_.is_exhausted = narrow_phase_ == nullptr;
  return narrow_phase_ != nullptr;
}

double Detector::clearance(const Pair& pair, const BodyState* states, double cap) {
  narrow_phase_->place(pair.a, states[pair.a].predicted);
  narrow_phase_->place(pair.b, states[pair.b].predicted);
  return narrow_phase_->gap(pair.a, pair.b, cap);
}

bool Detector::are_surely_within(const Pair& pair, const BodyState* states, double distance) {
  narrow_phase_->place(pair.a, states[pair.a].predicted);
  narrow_phase_->place(pair.b, states[pair.b].predicted);
  if (!narrow_phase_->are_surely_within(pair.a, pair.b, distance)) return false;
  find_touching(pair, states);
  return lately_touching_.is_empty() && has_lately_;
}

bool Detector::first_touch(const Pair& pair, const BodyState* states, double h, double speed,
                           const LastNormals& last_normals, double& touch) {
  const double growth = max(2.0 * TOUCH, FAST * thickness(pair));
  const MovingHull one{pair.a, &hulls_[pair.a]->hull(), &states[pair.a]};
  const MovingHull other{pair.b, &hulls_[pair.b]->hull(), &states[pair.b]};
  return find_first_touch(*narrow_phase_, one, other, h, speed, growth, last_normals.find(pair), touch);
}

bool Detector::misses_first_touch(const Pair& pair, const BodyState* states) {
  find_touching(pair, states);
  if (lately_touching_.is_empty()) return false;
  const Closest& deepest = find_deepest(lately_touching_);
  if (deepest.gap >= -MARGIN) return false;
  return gap_before(deepest, hulls_[pair.a]->hull(), hulls_[pair.b]->hull(), states[pair.a], states[pair.b]) < -MARGIN;
}

// Closest points of the parts that touch, in lately_touching_.
void Detector::find_touching(const Pair& pair, const BodyState* states) {
  const Pose &a = states[pair.a].predicted, &b = states[pair.b].predicted;
  if (has_lately_ && lately_.pair == pair && is_same(lately_.a, a) && is_same(lately_.b, b)) return;
  find_closest(pair, states, 0.0);
  lately_touching_.clear();
  for (const Closest& closest : near_) {
    if (closest.gap <= 0.0) lately_touching_.add(closest);
  }
  lately_ = {pair, a, b};
  has_lately_ = !memory_.is_exhausted;
}

// Closest points of the parts that are not farther apart than `distance`, in near_.
void Detector::find_closest(const Pair& pair, const BodyState* states, double distance) {
  near_.clear();
  narrow_phase_->place(pair.a, states[pair.a].predicted);
  narrow_phase_->place(pair.b, states[pair.b].predicted);
  if (!near_.resize(most_parts_ * most_parts_)) return;
  near_.cut(narrow_phase_->closest(pair.a, pair.b, distance, near_.data()));
}

void Detector::contacts(const Pair& pair, const BodyState* states, LastNormals& last_normals, Buffer<Contact>& found) {
  find_touching(pair, states);
  touching_.clear();
  touching_.add(lately_touching_.data(), lately_touching_.size());
  if (touching_.is_empty()) {
    last_normals.remove(pair);
    return;
  }
  const CompoundHull &one = *hulls_[pair.a], &other = *hulls_[pair.b];
  const double scale = find_scale(pair);
  const bool is_compound = !(one.is_whole() && other.is_whole());
  if (is_compound) support_.select_supported(touching_, one, other, states[pair.a], states[pair.b]);
  const bool shallow = is_shallow(pair, find_deepest(touching_), states, last_normals);
  const LastNormal* carried = shallow ? nullptr : last_normals.find(pair);
  LastNormal deep;
  if (carried != nullptr) {
    deep = *carried;
  } else if (!shallow) {  // deep inside each other from the start
    deep = find_plan_normal(pair, states);
    last_normals.set(pair, deep);
  }
  const int begin = found.size();
  hidden_.clear();
  for (int i = 0; i < touching_.size(); ++i) {
    const Closest& closest = touching_[i];
    const Three normal = shallow ? closest.normal : turn_with_hull(deep, pair, states);
    find_features(pair, closest, normal, states, scale * FEATURE_DEPTH);
    if (shallow && i == 0) {
      const int carrier = places_.feature_a.size() > places_.feature_b.size() ? 0 : 1;
      last_normals.set(pair, carry(carrier, normal, pair, states));
    }
    add_contacts(pair, closest, contact_axes(normal), states, is_compound && !shallow, found);
  }
  if (found.size() == begin) found.add(hidden_.data(), hidden_.size());
  if (is_compound) support_.merge_coplanar(found, begin);
  remove_duplicates(found, begin, scale * SAME_POINT);
}

// Adds the contacts of the features that were found last; those inside a compound hull to hidden_.
void Detector::add_contacts(const Pair& pair, const Closest& closest, const Rows& axes, const BodyState* states,
                            bool may_be_inside, Buffer<Contact>& found) {
  ContactPlace places[MANIFOLD];
  int count = places_.find_manifold(axes, places);
  const bool has_corners = count > 0;
  // Features that pass each other (a corner beside a face's edge) leave Bullet's own point.
  if (!has_corners) {
    places[0] = {0.5 * (closest.on_a + closest.on_b), closest.gap};
    count = 1;
  }
  double least = places[0].gap;
  for (int i = 1; i < count; ++i) least = min(least, places[i].gap);
  // Faces that meet flush touch with all their corners, whatever the last bits of the gaps say.
  const double touch = least <= 0.0 ? FLUSH : 0.0;
  for (int i = 0; i < count; ++i) {
    if (!(places[i].gap <= touch)) continue;
    const Contact contact = make_contact(pair.a, pair.b, states, places[i].point, places[i].gap, axes);
    // With a last normal, parts that pass each other along it or lie behind others have no contact.
    const bool is_hidden = may_be_inside && (!has_corners || is_inside(contact, closest, states));
    (is_hidden ? hidden_ : found).add(contact);
  }
}

bool Detector::facing(const Pair& pair, double distance, const BodyState* states, const LastNormals& last_normals,
                      Contact& found) {
  find_closest(pair, states, distance);
  if (near_.is_empty()) return false;
  const Closest& nearest = find_deepest(near_);
  const LastNormal* last = nearest.gap <= -find_shallow(pair) ? last_normals.find(pair) : nullptr;
  const Three normal = last != nullptr ? turn_with_hull(*last, pair, states) : nearest.normal;
  const Rows axes = contact_axes(normal);
  find_features(pair, nearest, normal, states, max(find_scale(pair) * FEATURE_DEPTH, distance - nearest.gap));
  ContactPlace places[MANIFOLD];
  int count = places_.find_manifold(axes, places);
  if (count == 0) {
    places[0] = {0.5 * (nearest.on_a + nearest.on_b), nearest.gap};
    count = 1;
  }
  double weights[MANIFOLD], total = 0.0;
  for (int i = 0; i < count; ++i) {
    weights[i] = max(distance - places[i].gap, 0.0);
    total = i == 0 ? weights[i] : total + weights[i];
  }
  Three middle{};
  for (int i = 0; i < count; ++i) {
    const double share = total > 0.0 ? weights[i] / total : 1.0 / count;
    middle = middle + share * places[i].point;
  }
  found = make_contact(pair.a, pair.b, states, middle, nearest.gap, axes);
  return true;
}

// Normal of least overlap of the two hulls in plan, carried by the body whose side it belongs to.
LastNormal Detector::find_plan_normal(const Pair& pair, const BodyState* states) {
  collect_corners(pair, false, states, in_a_);
  collect_corners(pair, true, states, in_b_);
  const PlanOverlap plan = plans_.least_overlap(in_a_, in_b_);
  return carry(plan.carrier, plan.normal, pair, states);
}

// Corners in n of the parts of a or b that touch.
void Detector::collect_corners(const Pair& pair, bool of_b, const BodyState* states, Buffer<Three>& corners) {
  const int body = of_b ? pair.b : pair.a;
  const HullMesh& hull = hulls_[body]->hull();
  corners.clear();
  for (int i = 0; i < hull.part_count(); ++i) {
    bool is_touching = false;
    for (const Closest& closest : touching_) is_touching = is_touching || (of_b ? closest.part_b : closest.part_a) == i;
    if (!is_touching) continue;
    place_part(hull.part(i), states[body], part_);
    corners.add(part_.data(), part_.size());
  }
}

// Whether Bullet's normals count. A steep normal, and that of a thin hull in deep overlap, must follow the last one.
bool Detector::is_shallow(const Pair& pair, const Closest& deepest, const BodyState* states,
                          const LastNormals& last_normals) const {
  const double limit = find_shallow(pair);
  const bool shallow = deepest.gap > -limit;
  if (shallow && -STEEP < deepest.normal[2] && deepest.normal[2] < STEEP) return true;
  const LastNormal* last = last_normals.find(pair);
  if (last == nullptr || (limit == SHALLOW && !shallow)) return shallow;
  return dot(turn_with_hull(*last, pair, states), deepest.normal) > FOLLOWS;
}

// Whether a contact with a last normal lies on a face that another part of the same hull covers.
bool Detector::is_inside(const Contact& contact, const Closest& closest, const BodyState* states) const {
  const Three half = 0.5 * contact.gap * contact.normal;
  const BodyState &a = states[contact.a], &b = states[contact.b];
  return hulls_[contact.a]->covers(closest.part_a, a.in_body(contact.point - half),
                                   rotate_back(a.predicted.R, contact.normal)) ||
         hulls_[contact.b]->covers(closest.part_b, b.in_body(contact.point + half),
                                   -rotate_back(b.predicted.R, contact.normal));
}

void Detector::find_features(const Pair& pair, const Closest& closest, const Three& normal, const BodyState* states,
                             double depth) {
  place_part(hulls_[pair.a]->hull().part(closest.part_a), states[pair.a], in_a_);
  place_part(hulls_[pair.b]->hull().part(closest.part_b), states[pair.b], in_b_);
  places_.find_features(in_a_, in_b_, normal, depth);
}

}  // namespace shipcollision
