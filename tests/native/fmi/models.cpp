// Models for tests of the FMI layer: the twin of tests/fmi/Dummy.py, and one that passes its inputs on.
#include <string.h>

#include "fmi/model.hpp"
#include "fmi/paths.hpp"
#include "fmi/variables.hpp"
#include "manoeuvring/interface.hpp"
#include "numbers/elementary.hpp"

namespace shipcollision {

namespace {

const char* const PHASES[] = {"rest", "roll", "slide"};
const char* const METHODS[] = {"pgs", "closed_form", "bullet"};

struct DummyValues {
  double gain[2] = {0.1, 1.0 / 3.0};
  char name[LONGEST_STRING] = "good";
  int count = 3;
  bool quick = true;
  int method = 0;
  double push[3] = {};
  int number = 7;
  bool open = false;
  char word[LONGEST_STRING] = "start";
  double place[3] = {};
  int steps = 0;
  bool moving = false;
  char said[LONGEST_STRING] = "";
  int phase = 0;
};

const Path DUMMY[] = {
    {"parameters.gain", Kind::real, offsetof(DummyValues, gain), 2, nullptr, 0},
    {"parameters.name", Kind::string, offsetof(DummyValues, name), 0, nullptr, 0},
    {"parameters.count", Kind::integer, offsetof(DummyValues, count), 0, nullptr, 0},
    {"parameters.quick", Kind::boolean, offsetof(DummyValues, quick), 0, nullptr, 0},
    {"parameters.method", Kind::enumeration, offsetof(DummyValues, method), 0, METHODS, 3},
    {"inputs.push", Kind::real, offsetof(DummyValues, push), 3, nullptr, 0},
    {"inputs.number", Kind::integer, offsetof(DummyValues, number), 0, nullptr, 0},
    {"inputs.open", Kind::boolean, offsetof(DummyValues, open), 0, nullptr, 0},
    {"inputs.word", Kind::string, offsetof(DummyValues, word), 0, nullptr, 0},
    {"outputs.place", Kind::real, offsetof(DummyValues, place), 3, nullptr, 0},
    {"outputs.steps", Kind::integer, offsetof(DummyValues, steps), 0, nullptr, 0},
    {"outputs.moving", Kind::boolean, offsetof(DummyValues, moving), 0, nullptr, 0},
    {"outputs.said", Kind::string, offsetof(DummyValues, said), 0, nullptr, 0},
    {"outputs.phase", Kind::enumeration, offsetof(DummyValues, phase), 0, PHASES, 3},
};

void copy(const char* from, char (&into)[LONGEST_STRING]) {
  const size_t size = strnlen(from, LONGEST_STRING - 1);
  memcpy(into, from, size);
  into[size] = '\0';
}

// x <- x + h (gain[0] + push + 1e-3 hidden), hidden <- 1.1 hidden + h: a step repeats only from the whole state.
class Dummy : public Model {
 public:
  bool find(const char* path, int index, Place& place) override {
    return find_path(DUMMY, sizeof DUMMY / sizeof DUMMY[0], &values_, path, index, place);
  }

  bool initialise(Text& why) override {
    if (strcmp(values_.name, "bad") == 0) {
      why << "name = 'bad' is 100% wrong; call it 'good'";
      return false;
    }
    warning_.clear(), event_.clear();
    hidden_ = 0.1 + values_.gain[1];
    for (double& x : values_.place) x = values_.gain[0];
    values_.steps = values_.count;
    values_.moving = false;
    copy(values_.word, values_.said);
    values_.phase = 0;
    return true;
  }

  bool step(double t, double h, Text& why) override {
    for (const double push : values_.push) {
      if (abs(push) < 1e30) continue;
      why << "push = ";
      why.list(values_.push, 3) << " is not finite at t = " << t << " s; check what is connected to it";
      return false;
    }
    warning_.clear(), event_.clear();
    if (strcmp(values_.word, "bang") == 0) event_ << "100% happened at t = " << t << " s";
    if (strcmp(values_.word, "doubt") == 0) warning_ << "only 90% right at t = " << t << " s";
    for (int i = 0; i < 3; i++) values_.place[i] += h * (values_.gain[0] + values_.push[i] + 1e-3 * hidden_);
    hidden_ = 1.1 * hidden_ + h;
    values_.steps = static_cast<int>(static_cast<unsigned>(values_.steps) + 1);
    values_.moving = true;
    Text said;
    said << values_.word << " " << t;
    copy(said.get(), values_.said);
    values_.phase = values_.open ? 2 : 1;
    return true;
  }

  size_t state_size() const override { return sizeof hidden_; }
  void get_state(void* bytes) const override { memcpy(bytes, &hidden_, sizeof hidden_); }
  bool set_state(const void* bytes, size_t size, Text& why) override {
    if (size != sizeof hidden_) {
      why << "this is no state of it";
      return false;
    }
    memcpy(&hidden_, bytes, size);
    return true;
  }
  const Text& warning() const override { return warning_; }
  size_t event_count() const override { return event_.is_empty() ? 0 : 1; }
  const char* event(size_t) const override { return event_.get(); }

 private:
  DummyValues values_;
  double hidden_ = 0.0;
  Text warning_, event_;
};

constexpr size_t INPUTS = 36, OUTPUTS = 80;

struct FeedthroughValues {
  double in[INPUTS] = {};
  double out[OUTPUTS] = {};
};

const Path FEEDTHROUGH[] = {
    {"inputs", Kind::real, offsetof(FeedthroughValues, in), INPUTS, nullptr, 0},
    {"outputs", Kind::real, offsetof(FeedthroughValues, out), OUTPUTS, nullptr, 0},
};

// As many Reals as a collision between two ships has, passed on: what FMI itself costs.
class Feedthrough : public Model {
 public:
  bool find(const char* path, int index, Place& place) override {
    return find_path(FEEDTHROUGH, 2, &values_, path, index, place);
  }
  bool initialise(Text&) override { return true; }
  bool step(double, double, Text&) override {
    for (size_t i = 0; i < OUTPUTS; i++) values_.out[i] = values_.in[i % INPUTS];
    return true;
  }
  size_t state_size() const override { return 0; }
  void get_state(void*) const override {}
  bool set_state(const void*, size_t, Text&) override { return true; }
  const Text& warning() const override { return warning_; }

 private:
  FeedthroughValues values_;
  Text warning_;
};

}  // namespace

Model* make_model(const Variables& variables, const char*, Text& why) {
  const char* fmu = variables.fmu();
  Model* made = strcmp(fmu, "Dummy") == 0         ? static_cast<Model*>(new Dummy)
                : strcmp(fmu, "Feedthrough") == 0 ? static_cast<Model*>(new Feedthrough)
                                                  : refuse_model(variables, why);
  if (made == nullptr && why.is_empty()) why << "there is no memory for the model of " << fmu;
  return made;
}

}  // namespace shipcollision
