// Batches through the plain C interface: whole tables of cases in, tables of rows out, one call each.
#include <string.h>

#include "batch/impact.hpp"
#include "export.hpp"

namespace {

using namespace shipcollision;

void say(const Text& why, char* message, size_t capacity) {
  if (capacity == 0) return;
  const size_t size = why.size() < capacity ? why.size() : capacity - 1;
  memcpy(message, why.get(), size);
  message[size] = '\0';
}

}  // namespace

// Impacts of two ships, own and target, as ImpactShip has them; shipcollision_free_impacts frees them. Null, and why in
// `message`, for a refusal.
SHIPCOLLISION_EXPORT void* shipcollision_make_impacts(const ImpactShip* own, const ImpactShip* target, char* message,
                                                      size_t capacity) {
  Text why;
  Impacts* impacts = new Impacts;
  if (impacts == nullptr) {
    why << "there is no memory for the impacts";
  } else if (impacts->prepare(*own, *target, why)) {
    return impacts;
  }
  delete impacts;
  say(why, message, capacity);
  return nullptr;
}

SHIPCOLLISION_EXPORT void shipcollision_free_impacts(void* impacts) { delete static_cast<Impacts*>(impacts); }

SHIPCOLLISION_EXPORT void shipcollision_run_impacts(void* impacts, const ImpactCase* cases, size_t count,
                                                    ImpactRow* rows) {
  static_cast<Impacts*>(impacts)->run(cases, count, rows);
}

// Bytes of a case and of a row.
SHIPCOLLISION_EXPORT void shipcollision_impact_sizes(size_t* sizes) {
  sizes[0] = sizeof(ImpactCase);
  sizes[1] = sizeof(ImpactRow);
}
