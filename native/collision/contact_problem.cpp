#include "contact_problem.hpp"

namespace shipcollision {

void ContactCaches::get_state(ByteWriter& bytes) const {
  bytes.value(last_normals.rows().size());
  for (const auto& [pair, last] : last_normals.rows()) bytes.values(pair, last.carrier, last.normal);
  bytes.list(warm_starts.rows());
}

bool ContactCaches::set_state(ByteReader& bytes) {
  int count;
  last_normals.clear();
  if (!bytes.value(count)) return false;
  for (int i = 0; i < count; ++i) {
    Pair pair;
    LastNormal last;
    if (!bytes.values(pair, last.carrier, last.normal)) return false;
    last_normals.set(pair, last);
  }
  return bytes.list(warm_starts.rows());
}

}  // namespace shipcollision
