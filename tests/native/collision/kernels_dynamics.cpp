// The parts of native/collision/dynamics that bodies and contacts are made of.
#include "../../../native/collision/dynamics/chord.hpp"
#include "../../../native/collision/dynamics/contact.hpp"
#include "../../../native/collision/dynamics/contact_frame.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

void frame(const double* in, double* out) {
  Put{out}.all(contact_axes(Take{in}.all<Three>()));
}

void chord(const double* in, double* out) {
  Take take{in};
  const Pose pose = take.all<Pose>();
  const Three position = take.all<Three>(), attitude = take.all<Three>(), r_bg = take.all<Three>();
  const Six nu = take.all<Six>();
  Put{out}.all(find_chord(pose, position, attitude, r_bg, nu, take.real()));
}

void put_twists(Put& put, const BodyState& state) {
  put.all(state.nu);
  put.all(state.nu_mean);
  put.all(state.nu_path);
  put.all(state.nu_energy);
  put.all(state.issued);
  put.all(state.twist_at_predicted_pose());
  put.all(state.predicted);
  put.all(state.predicted_motion().velocity);
  put.all(state.predicted_motion().omega);
}

// in: a body, which of the optional calls are made, other forces, end of the law, H, an impulse, twist to look ahead with
void body(const double* in, double* out) {
  Take take{in};
  Put put{out};
  BodyState state = take_state(take);
  const int calls = take.whole();
  const Six bias = take.all<Six>(), error = take.all<Six>();
  const Motion end = take.all<Motion>();
  const double H = take.real();
  const Six J = take.all<Six>(), twist = take.all<Six>();
  if (calls & 1) state.expect(bias, calls & 2 ? &error : nullptr);
  if (calls & 4) state.follow(end, state.nu, H);
  state.book(J);
  state.advance(0.25 * H, 3);
  put_twists(put, state);
  put.all(state.pose_before);
  put.all(state.pose_after(twist, H));
  if (calls & 8) {
    Matrix inverse;
    memcpy(inverse, state.M_inverse, sizeof inverse);
    state.apply_at(state.pose_after(state.nu, H), inverse);
    state.book(J);
    state.advance(0.5 * H);
  }
  put_twists(put, state);
  put.all(state.in_body(first_three(twist)));
}

void put_contact(Put& put, const Contact& contact) {
  put.all(contact.axes);
  put.all(contact.r_a);
  put.all(contact.r_b);
  put.all(contact.at);
  put.all(contact.G_a);
  put.all(contact.G_b);
}

// in: two bodies, and of two contacts the point, the normal, the gap and P
void contacts(const double* in, double* out) {
  Take take{in};
  Put put{out};
  BodyState states[2] = {take_state(take), take_state(take)};
  for (BodyState& state : states) {
    state.expect(state.nu_received + state.nu_received, &state.nu_received);
    state.advance(1.5);
  }
  Impulse impulses[2];
  for (auto& [contact, P] : impulses) {
    const Three point = take.all<Three>(), normal = take.all<Three>();
    contact = make_contact(0, 1, states, point, take.real(), contact_axes(normal));
    P = take.all<Three>();
    put_contact(put, contact);
    put.all(mean_velocity(contact, states));
  }
  Booked booked[2];
  book_impulses(impulses, 2, states, booked);
  for (const Booked& each : booked) {
    put.all(each.before);
    put.all(each.after);
    put.real(each.lost);
  }
  for (const BodyState& state : states) {
    put.all(state.nu);
    put.all(state.issued);
  }
}

constexpr Named KERNELS[] = {{"frame", frame}, {"chord", chord}, {"body", body}, {"contacts", contacts}};

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_dynamics(const char* name, const double* in, size_t ins, double* out,
                                                          size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count);
}
