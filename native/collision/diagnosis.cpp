#include "diagnosis.hpp"

#include <string.h>

namespace shipcollision {
namespace {

bool answers(Feedback feedback) {
  return feedback == Feedback::ledger || feedback == Feedback::force || feedback == Feedback::state;
}

}  // namespace

Diagnosis::Diagnosis(const Bodies& bodies, const ImpulseLedger* ledgers, const CollisionInputs& inputs,
                     DiagnosisOutput& out, Memory& memory)
    : bodies_(bodies), ledgers_(ledgers), inputs_(inputs), out_(out), motions_(memory), answers_(memory) {
  motions_.fill(bodies.ships(), MotionWatch());
  for (int i = 0; i < bodies.ships(); ++i) answers_.add(AnswerWatch(!answers(bodies[i].feedback)));
}

void Diagnosis::examine(double t, double H, const bool* is_absent, const Buffer<NearPair>& near, bool has_touched,
                        Text& said) {
  ++step_;
  if (step_ == 1) {
    find_overlaps(near, said);
  } else if (step_ == CONNECTED_BY) {
    for (int i = 0; i < motions_.size(); ++i) {
      if (is_absent[i]) say(i, {Finding::not_connected, {}}, true, said);
    }
  }
  double due = INFINITE;
  for (int i = 0; i < motions_.size(); ++i) {
    MotionWatch& motion = motions_[i];
    if (motion.is_done()) continue;
    if (t >= motion.next() && step_ >= CONNECTED_BY) {
      say(i, motion.look(inputs_.ships[i], ledgers_[i].is_settled(), t, H), true, said);
    }
    due = min(due, motion.next());
  }
  if (has_touched || is_waiting()) {
    for (int i = 0; i < answers_.size(); ++i) {
      if (answers_[i].is_done()) continue;
      say(i, answers_[i].look(inputs_.ships[i], bodies_[i], ledgers_[i].issued(), t), true, said);
    }
  }
  due_ = is_waiting() || step_ < CONNECTED_BY ? -INFINITE : due;
}

// Whether a ship has an impulse to answer.
bool Diagnosis::is_waiting() const {
  for (const AnswerWatch& answer : answers_) {
    if (answer.is_waiting()) return true;
  }
  return false;
}

void Diagnosis::find_overlaps(const Buffer<NearPair>& near, Text& said) {
  for (const NearPair& each : near) {
    if (!(each.gap < -OVERLAP)) continue;
    const int two[] = {each.pair.a, each.pair.b};
    bool is_turned = false;
    for (int i : two) {
      if (i >= motions_.size() || !(abs(inputs_.ships[i].attitude[2]) > 2.0 * PI)) continue;
      Found found;
      found.finding = Finding::attitude_in_degrees;
      found.measured.yaw = inputs_.ships[i].attitude[2];
      say(i, found, true, said);
      is_turned = true;
    }
    if (is_turned) continue;
    Found found;
    found.finding = Finding::overlap_at_the_start;
    found.measured.other = bodies_[each.pair.b].name.get();
    found.measured.overlap = -each.gap;
    say(each.pair.a, found, false, said);
  }
}

// Enters a finding about a ship in the outputs. is_last: the ship is not watched any more.
void Diagnosis::say(int i, const Found& found, bool is_last, Text& said) {
  if (found.finding == Finding::none) return;
  if (is_last) {
    motions_[i].end();
    answers_[i].end();
  }
  Text text;
  describe_finding(found, bodies_[i].name.get(), text);
  if (!said.is_empty()) said << "; ";
  said << text;
  if (++out_.count > 1) return;
  out_.code = static_cast<int>(found.finding);
  out_.ship = i + 1;
  memcpy(out_.text, text.get(), text.size() + 1);
}

void Diagnosis::get_state(ByteWriter& bytes) const {
  bytes.values(step_, due_);
  for (const MotionWatch& motion : motions_) motion.get_state(bytes);
  for (const AnswerWatch& answer : answers_) answer.get_state(bytes);
}

bool Diagnosis::set_state(ByteReader& bytes) {
  if (!bytes.values(step_, due_)) return false;
  for (MotionWatch& motion : motions_) {
    if (!motion.set_state(bytes)) return false;
  }
  for (AnswerWatch& answer : answers_) {
    if (!answer.set_state(bytes)) return false;
  }
  return true;
}

}  // namespace shipcollision
