#include "feedback.hpp"

#include <string.h>

namespace shipcollision {

const char* const COMMON_FEEDBACKS[] = {"ledger", "force", "state", "none"};
const char* const SHIP_FEEDBACKS[] = {"common", "ledger", "force", "state", "none", "prescribed"};

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || (c >= '\x1c' && c <= '\x1f'); }

// The feedback of a word between white space; -1 for an unknown one.
int find_feedback(const char* word, size_t size) {
  for (size_t i = 0; i < SHIP_FEEDBACK_COUNT; ++i) {
    if (strlen(SHIP_FEEDBACKS[i]) == size && strncmp(SHIP_FEEDBACKS[i], word, size) == 0) return static_cast<int>(i);
  }
  return -1;
}

void list_feedbacks(Text& why) {
  for (size_t i = 0; i < SHIP_FEEDBACK_COUNT; ++i) why << (i == 0 ? "" : ", ") << SHIP_FEEDBACKS[i];
}

}  // namespace

bool choose_feedback(const char* name, const CollisionShipParameters& ship, CommonFeedback common, Feedback& chosen,
                     Text& why) {
  const char* word = ship.feedback_name;
  while (is_space(*word)) ++word;
  size_t size = strlen(word);
  while (size > 0 && is_space(word[size - 1])) --size;
  int of_ship = static_cast<int>(ship.feedback);
  if (size > 0) {
    const int found = find_feedback(word, size);
    char given[LONGEST_STRING];
    memcpy(given, word, size);
    given[size] = '\0';
    if (found < 0) {
      why << name << ".feedback_name = ";
      why.quote(given) << " is not known: choose one of ";
      list_feedbacks(why);
      return false;
    }
    if (of_ship != 0 && of_ship != found) {
      why << name << ".feedback = ";
      why.quote(SHIP_FEEDBACKS[of_ship]) << " and " << name << ".feedback_name = ";
      why.quote(given) << " differ: give one of them";
      return false;
    }
    of_ship = found;
  }
  chosen = of_ship == 0 ? static_cast<Feedback>(static_cast<int>(common) + 1) : static_cast<Feedback>(of_ship);
  return true;
}

}  // namespace shipcollision
