#include "alart_curnier.hpp"

#include "../dynamics/small_blocks.hpp"
#include "contact_law.hpp"

namespace shipcollision {

namespace {

constexpr double WARM_WEIGHTS[] = {1e-7, 1e-10};
constexpr double PROXIMAL_WEIGHTS[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
constexpr int MAX_WARM_STEPS = 6;
constexpr int MAX_STEPS = 15;
constexpr double STALLED = 1e3;

void clip_to_cones(const double* P, int contacts, double mu, double* inside) {
  for (int n = 0; n < 3 * contacts; n += 3) {
    const double normal = max(P[n], 0.0), size = hypot(P[n + 1], P[n + 2]), radius = mu * normal;
    const double share = size > radius ? radius / size : 1.0;
    inside[n] = normal;
    inside[n + 1] = P[n + 1] * share;
    inside[n + 2] = P[n + 2] * share;
  }
}

}  // namespace

AlartCurnier::AlartCurnier(Memory& memory)
    : weighted_(memory), slope_(memory), D_(memory), shifted_(memory), rho_(memory), P_(memory), best_on_way_(memory),
      inside_(memory), best_(memory), after_(memory), error_(memory), step_(memory), right_(memory),
      equations_(memory) {}

bool AlartCurnier::reserve(int contacts) {
  contacts_ = contacts;
  const int size = 3 * contacts;
  bool is_there = weighted_.resize(size, size) && slope_.resize(size, size) && equations_.resize(contacts);
  Vector* const vectors[] = {&D_,    &shifted_, &rho_,   &P_,    &best_on_way_, &inside_,
                             &best_, &after_,   &error_, &step_, &right_};
  for (Vector* vector : vectors) {
    is_there = is_there && vector->resize(size);
  }
  return is_there;
}

void AlartCurnier::solve(const Dense& W, const double* v, double mu, double* P, double tolerance, WorkLimit& work) {
  constexpr int WARM = 2, ALL = 12;
  const int size = 3 * contacts_;
  for (int n = 0; n < size; ++n) D_[n] = W[n][n] > 0.0 ? W[n][n] : W[n - n % 3][n - n % 3];
  for (int n = 0; n < size; ++n) copy_numbers(weighted_[n], W[n], size);
  copy_numbers(P_.data(), P, size);
  copy_numbers(best_.data(), P, size);
  double least = law_residual(W, v, mu, P);
  bool is_solved = true;
  for (int i = 0; i < ALL; ++i) {
    const bool is_warm = i < WARM;
    if (is_warm && !is_solved) continue;
    if (i == WARM) copy_numbers(P_.data(), best_.data(), size);
    const double w = is_warm ? WARM_WEIGHTS[i] : PROXIMAL_WEIGHTS[i - WARM];
    for (int n = 0; n < size; ++n) {
      weighted_[n][n] = W[n][n] + w * D_[n];
      shifted_[n] = v[n] - w * D_[n] * P_[n];
    }
    is_solved = solve_newton(mu, 0.3 * tolerance, work, is_warm ? MAX_WARM_STEPS : MAX_STEPS);
    clip_to_cones(P_.data(), contacts_, mu, inside_.data());
    const double residual = law_residual(W, v, mu, inside_.data());
    work.spend_residual(contacts_);
    if (residual < least) {
      copy_numbers(best_.data(), inside_.data(), size);
      least = residual;
    }
    if (least <= tolerance || work.is_spent()) break;
  }
  copy_numbers(P, best_.data(), size);
}

// From P_ to impulses of which every equation holds to `tolerance` [m/s]; if none does, the best on the way, and false.
bool AlartCurnier::solve_newton(double mu, double tolerance, WorkLimit& work, int steps) {
  const int size = 3 * contacts_;
  for (int n = 0; n < size; n += 3) {
    rho_[n] = 1.0 / weighted_[n][n];
    rho_[n + 1] = rho_[n + 2] = 1.0 / max(max(weighted_[n + 1][n + 1], weighted_[n + 2][n + 2]), 1e-300);
  }
  copy_numbers(best_on_way_.data(), P_.data(), size);
  double least = INFINITE;
  bool is_solved = false;
  for (int i = 0; i < steps; ++i) {
    evaluate_equations(P_.data(), mu);
    const double missed = are_finite(error_.data(), size) ? largest_size(error_.data(), size) : INFINITE;
    const bool stalls = least <= missed && missed <= STALLED * tolerance;
    if (missed < least) {
      copy_numbers(best_on_way_.data(), P_.data(), size);
      least = missed;
    }
    is_solved = missed <= tolerance || stalls;
    if (is_solved || work.is_spent()) break;
    work.spend_newton_step(contacts_, closed_);
    if (!find_step(mu)) break;
    for (int n = 0; n < size; ++n) P_[n] -= step_[n];
    if (!are_finite(P_.data(), size)) break;
  }
  copy_numbers(P_.data(), best_on_way_.data(), size);
  return is_solved;
}

void AlartCurnier::evaluate_equations(const double* P, double mu) {
  multiply(weighted_, P, after_.data());
  closed_ = sliding_ = 0;
  for (int i = 0; i < contacts_; ++i) {
    const int n = 3 * i;
    const double* rho = &rho_[n];
    double *after = &after_[n], *error = &error_[n], moved[3];
    for (int k = 0; k < 3; ++k) {
      after[k] += shifted_[n + k];
      moved[k] = P[n + k] - rho[k] * after[k];
    }
    const double size = hypot(moved[1], moved[2]);
    Equation& equation = equations_[i];
    equation.touches = moved[0] > 0.0;
    equation.slides = equation.touches && size > mu * moved[0];
    equation.place = closed_;
    for (int k = 0; k < 3; ++k) error[k] = equation.touches ? after[k] : P[n + k] / rho[k];
    if (equation.touches) ++closed_;
    if (!equation.slides) continue;
    ++sliding_;
    equation.share = mu * moved[0] / size;
    for (int k = 0; k < 2; ++k) {
      equation.unit[k] = moved[k + 1] / size;
      error[k + 1] = (P[n + k + 1] - equation.share * moved[k + 1]) / rho[k + 1];
    }
  }
}

// Newton's step: what is taken off P. False for a singular system.
bool AlartCurnier::find_step(double mu) {
  const int size = 3 * contacts_, rows = 3 * closed_;
  for (int n = 0; n < size; ++n) step_[n] = error_[n] * rho_[n];
  if (closed_ == 0) return true;
  if (!slope_.resize(rows, rows)) return false;
  for (int i = 0; i < contacts_; ++i) {
    const Equation& equation = equations_[i];
    if (!equation.touches) continue;
    for (int k = 0; k < 3; ++k) {
      const double* W = weighted_[3 * i + k];
      double *row = slope_[3 * equation.place + k], lost = 0.0;
      for (int j = 0; j < contacts_; ++j) {
        if (equations_[j].touches) {
          copy_numbers(row + 3 * equations_[j].place, W + 3 * j, 3);
        } else {
          lost += dot(W + 3 * j, &step_[3 * j], 3);
        }
      }
      right_[3 * equation.place + k] = lost;  // the velocity that the contacts which are apart take off
    }
    if (equation.slides) {
      add_sliding(equation, i, mu);
    } else {
      for (int k = 0; k < 3; ++k) right_[3 * equation.place + k] = error_[3 * i + k] - right_[3 * equation.place + k];
    }
  }
  if (!solve_system(slope_, right_.data())) return false;
  for (int i = 0; i < contacts_; ++i) {
    if (equations_[i].touches) copy_numbers(&step_[3 * i], &right_[3 * equations_[i].place], 3);
  }
  return true;
}

// Turns the rows of a contact that slides from its velocity to the equations of sliding.
void AlartCurnier::add_sliding(const Equation& equation, int contact, double mu) {
  const int n = 3 * equation.place, m = 3 * contact, rows = slope_.rows();
  const double rho_n = rho_[m], rho_t = rho_[m + 1];
  double B[2][3], A[2][3];  // by the velocity of the contact, and by its impulse
  for (int i = 0; i < 2; ++i) {
    B[i][0] = mu * equation.unit[i] * (rho_n / rho_t);
    A[i][0] = -mu * equation.unit[i] / rho_t;
    for (int j = 0; j < 2; ++j) {
      const double plane = i == j ? 1.0 : 0.0;
      B[i][j + 1] = equation.share * (plane - equation.unit[i] * equation.unit[j]);
      A[i][j + 1] = (plane - B[i][j + 1]) / rho_t;
    }
  }
  double *row_n = slope_[n], *row_1 = slope_[n + 1], *row_2 = slope_[n + 2];
  for (int j = 0; j < rows; ++j) {
    const double x = row_n[j], y = row_1[j], z = row_2[j];
    row_1[j] = B[0][0] * x + B[0][1] * y + B[0][2] * z;
    row_2[j] = B[1][0] * x + B[1][1] * y + B[1][2] * z;
  }
  for (int j = 0; j < 3; ++j) {
    row_1[n + j] += A[0][j];
    row_2[n + j] += A[1][j];
  }
  const double x = right_[n], y = right_[n + 1], z = right_[n + 2];
  right_[n] = error_[m] - x;
  right_[n + 1] = error_[m + 1] - (B[0][0] * x + B[0][1] * y + B[0][2] * z);
  right_[n + 2] = error_[m + 2] - (B[1][0] * x + B[1][1] * y + B[1][2] * z);
}

}  // namespace shipcollision
