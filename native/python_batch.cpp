// Batches through the plain C interface: whole tables of cases in, tables of rows out, one call each.
#include <string.h>

#include "batch/encounter.hpp"
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

// A runner of encounters; shipcollision_free_encounters frees it. Null without memory.
SHIPCOLLISION_EXPORT void* shipcollision_make_encounters() { return new Encounters; }

SHIPCOLLISION_EXPORT void shipcollision_free_encounters(void* encounters) {
  delete static_cast<Encounters*>(encounters);
}

SHIPCOLLISION_EXPORT void shipcollision_run_encounter(void* encounters, const EncounterCase* given, EncounterRow* row,
                                                      ShipRow* ships, double* track) {
  static_cast<Encounters*>(encounters)->run(*given, *row, ships, track);
}

// The collisions of the last encounter, as CollisionRow has them, and how many.
SHIPCOLLISION_EXPORT int shipcollision_encounter_collisions(void* encounters, const CollisionRow** rows) {
  const shipcollision::Buffer<CollisionRow>& found = static_cast<Encounters*>(encounters)->collisions();
  *rows = found.data();
  return found.size();
}

// Bytes of a row of an encounter, of a ship and of a collision, and of the structures that are filled.
SHIPCOLLISION_EXPORT void shipcollision_encounter_sizes(size_t* sizes) {
  sizes[0] = sizeof(EncounterRow);
  sizes[1] = sizeof(ShipRow);
  sizes[2] = sizeof(CollisionRow);
  sizes[3] = sizeof(EncounterCase);
  sizes[4] = sizeof(EncounterShip);
}
