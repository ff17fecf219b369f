#include "findings.hpp"

#include <string.h>

namespace shipcollision {
namespace {

// message: what was measured; remedy: what mends it; both with the names of `Measured` in braces, as in the twin.
struct Line {
  const char* message;
  const char* remedy;
};

const Line TABLE[] = {
    {"no state of {ship!r} was ever set, so that it takes part in no collision",
     "connect {ship}.position, {ship}.attitude, {ship}.velocity and {ship}.rate, or build the FMU without "
     "{ship!r}"},
    {"{ship!r} moves by {moved:.3g} m/s, but {ship}.velocity is {given:.3g} m/s",
     "connect {ship}.velocity: metres per second over ground, in b"},
    {"{ship!r} moves by {moved:.3g} m/s, but {ship}.velocity is {given:.3g} m/s, as if it were in {unit}",
     "give {ship}.velocity in metres per second"},
    {"{ship}.velocity of {given:.3g} m/s has the direction of the motion in n",
     "give {ship}.velocity in b: surge forward, sway to starboard"},
    {"{ship!r} moves by {moved:.3g} m/s, and {ship}.velocity, of {given:.3g} m/s, differs from it by "
     "{off:.3g} m/s",
     "give {ship}.velocity over ground, not through the water, in b at CO, and {ship}.position as north "
     "and east in metres, and connect {ship}.attitude"},
    {"{ship}.attitude.yaw = {yaw:.4g} fits the motion of {ship!r} only as degrees",
     "give {ship}.attitude in radians"},
    {"the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s",
     "connect {ship}.rate: radians per second, in b"},
    {"the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s, as if "
     "it were in degrees per second",
     "give {ship}.rate in radians per second"},
    {"the heading of {ship!r} turns by {moved:.3g} rad/s, but {ship}.rate.yaw is {given:.3g} rad/s",
     "give {ship}.rate in b, in radians per second, positive to starboard"},
    {"{ship!r} and {other!r} overlap by {overlap:.3g} m in the first step",
     "move one of them, and look whether {ship}.position and {ship}.attitude are connected, at their unit "
     "and their origin"},
    {"{ship!r} has not applied any impulse for {duration:.3g} s after one was issued "
     "({ship}.impulse_applied stays as it was, and so does its motion)",
     "connect {ship}.impulse to the ship model, or set {ship}.feedback = \"prescribed\" for a ship that "
     "cannot answer"},
    {"{ship!r} moves as if it had applied its impulse, but {ship}.impulse_applied has stayed as it was "
     "for {duration:.3g} s",
     "connect impulse_applied of the ship model to {ship}.impulse_applied, or choose feedback = \"force\" "
     "for a model that has none"},
    {"{ship!r} has not answered for {duration:.3g} s: its velocity shows {share:.2g} of the impulse issued",
     "connect {ship}.force and {ship}.moment to the ship model (for feedback = \"state\" adopt "
     "{ship}.post); if they are connected, give the model the mass and the inertia of {ship}.ship; or set "
     "{ship}.feedback = \"prescribed\" for a ship that cannot answer"},
    {"an impulse changed the velocity of {ship!r} by {share:.4g} times what was predicted, as if its mass "
     "were {mass:.4g} times that of {ship}.ship",
     "give {ship}.ship the file of the ship that sails, look at the unit of its mass (kg), and apply the "
     "impulse in b about CO"},
    {"{ship}.velocity is {given:.3g} m/s, but {ship}.position has not changed for {duration:.3g} s",
     "connect {ship}.position, {ship}.attitude, {ship}.velocity and {ship}.rate (start values are not "
     "enough), or give a ship that lies still the velocity 0"},
};

// A number by its name in a message; null for words.
const double* find_number(const Measured& measured, const char* name, size_t size) {
  const struct {
    const char* name;
    const double* number;
  } numbers[] = {{"moved", &measured.moved},     {"given", &measured.given},       {"off", &measured.off},
                 {"yaw", &measured.yaw},         {"overlap", &measured.overlap},   {"duration", &measured.duration},
                 {"share", &measured.share},     {"mass", &measured.mass}};
  for (const auto& each : numbers) {
    if (strlen(each.name) == size && strncmp(each.name, name, size) == 0) return each.number;
  }
  return nullptr;
}

// Puts {name}, {name!r} or {name:.3g}, without the braces.
void put_field(const char* field, size_t size, const Found& found, const char* ship, Text& said) {
  const size_t name_size = strcspn(field, "!:}");
  const double* number = find_number(found.measured, field, name_size);
  if (number != nullptr) {
    said.short_number(*number, field[name_size + 2] - '0');
    return;
  }
  const char* words = *field == 's' ? ship : *field == 'o' ? found.measured.other : found.measured.unit;
  if (name_size < size) {
    said.quote(words);
  } else {
    said << words;
  }
}

void put_format(const char* format, const Found& found, const char* ship, Text& said) {
  char words[512];
  while (*format != '\0') {
    const size_t size = strcspn(format, "{");
    memcpy(words, format, size);
    words[size] = '\0';
    said << words;
    format += size;
    if (*format == '\0') return;
    const size_t field = strcspn(++format, "}");
    put_field(format, field, found, ship, said);
    format += field + 1;
  }
}

}  // namespace

void describe_finding(const Found& found, const char* ship, Text& said) {
  const Line& line = TABLE[static_cast<int>(found.finding) - 1];
  put_format(line.message, found, ship, said);
  said << ": ";
  put_format(line.remedy, found, ship, said);
}

}  // namespace shipcollision
