// The parts of native/collision/solvers that need no bodies, and what they are made of.
#include "../../../native/collision/dynamics/small_blocks.hpp"
#include "../../../native/collision/solvers/held_motions.hpp"
#include "../../../native/collision/solvers/poisson_restitution.hpp"
#include "../../../native/numbers/eigenvalues.hpp"
#include "kernels.hpp"

using namespace shipcollision;

namespace {

struct Room {
  Memory memory;
  Dense W{memory}, H{memory};
  GaussSeidel gauss_seidel{memory};
};

void take_matrix(Take& take, Dense& A, int rows, int columns) {
  A.resize(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) A[i][j] = take.real();
  }
}

const double* take_vector(Take& take, int size) {
  const double* vector = take.in;
  take.in += size;
  return vector;
}

void put_matrix(Put& put, const Dense& A) {
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = 0; j < A.columns(); ++j) put.real(A[i][j]);
  }
}

ContactBlock take_block(Take& take) { return take.all<ContactBlock>(); }

// in: rows, A, b
void system(const double* in, double* out) {
  Take take{in};
  Room room;
  const int size = take.whole();
  take_matrix(take, room.W, size, size);
  copy_numbers(out + 1, take.in, size);
  out[0] = solve_system(room.W, out + 1);
}

// in: rows, A
void eigenvalue(const double* in, double* out) {
  Take take{in};
  Room room;
  const int size = take.whole();
  take_matrix(take, room.W, size, size);
  Vector work(room.memory);
  work.resize(3 * size);
  out[0] = find_largest_eigenvalue(room.W, work.data());
}

// in: rows, columns, A; out: how many they are, and the matrix
void orthonormal_rows(const double* in, double* out) {
  Take take{in};
  Room room;
  const int rows = take.whole(), columns = take.whole();
  take_matrix(take, room.W, rows, columns);
  out[0] = orthonormalise_rows(room.W, 1e-12);
  Put put{out + 1};
  put_matrix(put, room.W);
}

void friction_in_disc(const double* in, double* out) {
  Take take{in};
  const ContactBlock W = take_block(take);
  const Friction friction = solve_friction_in_disc(W, take.in[0], take.in[1], take.in[2]);
  out[0] = friction.P_1;
  out[1] = friction.P_2;
}

// in: contacts, W, v, mu, P
void residual(const double* in, double* out) {
  Take take{in};
  Room room;
  const int size = 3 * take.whole();
  take_matrix(take, room.W, size, size);
  const double* v = take_vector(take, size);
  const double mu = take.real();
  out[0] = law_residual(room.W, v, mu, take.in);
}

// in: the block, v, mu, whether there is an angle to start from, and it
void one_contact(const double* in, double* out) {
  Take take{in};
  const ContactBlock W = take_block(take);
  const Three v = take.all<Three>();
  const double mu = take.real();
  Angle angle{take.real() != 0.0, take.real()};
  Put put{out};
  put.all(solve_one_contact(W, v, mu, angle));
  put.real(angle.is_known);
  put.real(angle.is_known ? angle.value : 0.0);
}

// in: size, and the impulses before and after three sweeps
void extrapolation(const double* in, double* out) {
  Take take{in};
  Memory memory;
  Aitken aitken(memory);
  const int size = take.whole();
  aitken.start(size);
  for (int i = 0; i < 3; ++i) {
    const double* last = take_vector(take, size);
    copy_numbers(out + i * size, take_vector(take, size), size);
    aitken.extrapolate(out + i * size, last);
  }
}

// in: ships, H, contacts, closed; what a step of every kind leaves, and what the step of communication has left
void work(const double* in, double* out) {
  StepWork step;
  step.settle(step.lend());
  out[0] = step.lend().left;
  step.renew(static_cast<int>(in[0]), in[1]);
  WorkLimit limit = step.lend();
  const int contacts = static_cast<int>(in[2]), closed = static_cast<int>(in[3]);
  out[1] = limit.left;
  limit.spend_sweep(contacts);
  limit.spend_newton_step(contacts, closed);
  limit.spend_residual(contacts);
  limit.spend_gradient_step(contacts);
  out[2] = limit.left;
  step.settle(limit);
  out[3] = step.lend().left;
  limit.left = -1.0;
  limit.reserve_newton_steps(6, contacts);
  out[4] = limit.left;
}

// in: contacts, W, v, mu, P, tolerance, work
void together(const double* in, double* out, bool by_newton) {
  Take take{in};
  Room room;
  const int contacts = take.whole(), size = 3 * contacts;
  take_matrix(take, room.W, size, size);
  const double* v = take_vector(take, size);
  const double mu = take.real();
  copy_numbers(out, take_vector(take, size), size);
  const double tolerance = take.real();
  WorkLimit limit{take.real()};
  if (by_newton) {
    AlartCurnier newton(room.memory);
    newton.reserve(contacts);
    newton.solve(room.W, v, mu, out, tolerance, limit);
  } else {
    AclmFixedPoint aclm(room.memory);
    aclm.reserve(contacts);
    aclm.set_operator(room.W);
    aclm.solve(v, mu, out, tolerance, limit);
  }
  out[size] = limit.left;
}

void newton(const double* in, double* out) { together(in, out, true); }
void aclm(const double* in, double* out) { together(in, out, false); }

// in: contacts, W, v, mu, whether there is a start, start, scale, work
void gauss_seidel(const double* in, double* out) {
  Take take{in};
  Room room;
  const int contacts = take.whole(), size = 3 * contacts;
  take_matrix(take, room.W, size, size);
  const double* v = take_vector(take, size);
  const double mu = take.real();
  const bool has_start = take.real() != 0.0;
  const double *start = take_vector(take, size), scale = take.real();
  WorkLimit limit{take.real()};
  room.gauss_seidel.reserve(contacts);
  const Solution solution = room.gauss_seidel.solve(room.W, v, mu, has_start ? start : nullptr, scale, limit, out);
  Put put{out + size};
  put.real(solution.residual);
  put.real(solution.sweeps);
  put.real(limit.left);
}

// in: contacts, W, v, mu, e, whether there is a start, start, whether any motion is held, H, work
void impact(const double* in, double* out) {
  Take take{in};
  Room room;
  const int contacts = take.whole(), size = 3 * contacts;
  take_matrix(take, room.W, size, size);
  const double* v = take_vector(take, size);
  const double mu = take.real(), e = take.real();
  HeldFriction held(room.memory);
  held.reserve(contacts);
  held.has_start = take.real() != 0.0;
  copy_numbers(held.start.data(), take_vector(take, size), size);
  const bool holds = take.real() != 0.0;
  take_matrix(take, room.H, size, size);
  WorkLimit limit{take.real()};
  PoissonImpact poisson(room.memory, room.gauss_seidel);
  room.gauss_seidel.reserve(contacts);
  poisson.reserve(contacts);
  if (holds) yield_to_friction(room.W, v, mu, room.H, room.gauss_seidel, limit, held);
  const Solution solution = poisson.solve(holds ? held.W : room.W, v, mu, e, held.has_start ? held.start.data() : nullptr,
                                          holds ? held.slip.data() : nullptr, limit, out);
  Put put{out + size};
  put.real(solution.residual);
  put.real(solution.sweeps);
  put.real(limit.left);
  if (holds) copy_numbers(put.out, held.slip.data(), size);
}

constexpr Named KERNELS[] = {
    {"system", system},
    {"eigenvalue", eigenvalue},
    {"orthonormal_rows", orthonormal_rows},
    {"friction_in_disc", friction_in_disc},
    {"residual", residual},
    {"one_contact", one_contact},
    {"extrapolation", extrapolation},
    {"work", work},
    {"newton", newton},
    {"aclm", aclm},
    {"gauss_seidel", gauss_seidel},
    {"impact", impact},
};

}  // namespace

SHIPCOLLISION_EXPORT bool shipcollision_evaluate_solvers(const char* name, const double* in, size_t ins, double* out,
                                                         size_t outs, size_t count) {
  return evaluate(KERNELS, name, in, ins, out, outs, count);
}
