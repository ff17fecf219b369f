// Wrong wiring: the twin of shipcollision_fmu/collision/diagnosis.py.
#pragma once

#include "answer_watch.hpp"
#include "dynamics/impulse_ledger.hpp"
#include "motion_watch.hpp"
#include "proximity.hpp"

namespace shipcollision {

constexpr int CONNECTED_BY = 3;
constexpr double OVERLAP = 0.5;

// The watches over the ships. bodies, ledgers, inputs: of the model, which outlive it; out: filled, and
// cleared by whoever begins a run.
class Diagnosis {
 public:
  Diagnosis(const Bodies& bodies, const ImpulseLedger* ledgers, const CollisionInputs& inputs, DiagnosisOutput& out,
            Memory& memory);

  // Time [s] of the next look, if contact gives no impulse before.
  double due() const { return due_; }
  // Examines the step of H [s] that began at t [s]; adds the warning of what was found in it first. To be called when t
  // has come to `due`, or contact gave impulses (has_touched). is_absent: ships of whose state nothing was ever set.
  void examine(double t, double H, const bool* is_absent, const Buffer<NearPair>& near, bool has_touched, Text& said);

  void get_state(ByteWriter& bytes) const;
  bool set_state(ByteReader& bytes);

 private:
  bool is_waiting() const;
  void find_overlaps(const Buffer<NearPair>& near, Text& said);
  void say(int i, const Found& found, bool is_last, Text& said);

  const Bodies& bodies_;
  const ImpulseLedger* ledgers_;
  const CollisionInputs& inputs_;
  DiagnosisOutput& out_;
  int step_ = 0;
  double due_ = -INFINITE;
  Buffer<MotionWatch> motions_;
  Buffer<AnswerWatch> answers_;
};

}  // namespace shipcollision
