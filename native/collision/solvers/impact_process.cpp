#include "impact_process.hpp"

#include "slip_flow.hpp"

namespace shipcollision {

namespace {

constexpr double STILL = 1e-14;
constexpr double REST = 1e-100;
constexpr double RANK = 1e-9;
constexpr double IMMOBILE = 1e-12;
constexpr double STEP = 0.5;
constexpr double NEAR = 0.005;
constexpr double STOPPED = 1e-4;
constexpr int MAX_STEPS = 200;

struct Two {
  double x, y;
};

// The state of an impact on its path, in units of the approach speed and W_nn.
class Path {
 public:
  Path(const SlipFlow& flow, double returned, const Two& slip) : flow_(flow), returned_(returned), slip_(slip) {}

  void follow();
  double E_n = 0.0, E_t = 0.0;

 private:
  void move(double p, double P_1, double P_2, double N, double E_t);
  bool turn();
  bool follow_straight(double q_1, double q_2, double p_most);
  bool step_along_slip();
  bool keep_direction(double ahead);
  Two find_direction(double x, double y) const;
  double find_end(double a_n) const;

  SlipFlow flow_;
  double returned_;  // e^2
  double v_n_ = -1.0;
  Two slip_;
  double stored_ = 0.0;  // work that restitution may still give back
  bool compressing_ = true;
};

// Adds the impulses and works of a stretch that lies as a whole in compression or in restitution.
void Path::move(double p, double P_1, double P_2, double N, double lost) {
  v_n_ += p + flow_.n_1 * P_1 + flow_.n_2 * P_2;
  slip_ = {slip_.x + flow_.w_1 * p + flow_.A_1 * P_1, slip_.y + flow_.w_2 * p + flow_.A_2 * P_2};
  stored_ -= N * (compressing_ ? returned_ : 1.0);
  E_n -= N;
  E_t += lost;
}

// Whether the impact ends here, where v_n is zero; else changes from compression to restitution, or back.
bool Path::turn() {
  v_n_ = 0.0;
  compressing_ = !compressing_;
  return !compressing_ && stored_ <= 0.0;
}

void Path::follow() {
  if (flow_.mu == 0.0) {
    follow_straight(0.0, 0.0, INFINITE);
    return;
  }
  if (hypot(slip_.x, slip_.y) > STILL && step_along_slip()) return;
  slip_ = {0.0, 0.0};
  const double q_1 = flow_.A_1 != 0.0 ? -flow_.w_1 / flow_.A_1 : 0.0;
  const double q_2 = flow_.A_2 != 0.0 ? -flow_.w_2 / flow_.A_2 : 0.0;
  if (hypot(q_1, q_2) <= flow_.mu) {
    follow_straight(q_1, q_2, INFINITE);
    return;
  }
  double c, s;
  flow_.solve_reslip(c, s);
  follow_straight(-flow_.mu * c, -flow_.mu * s, INFINITE);
}

// The impulse at which restitution has given back its share; infinite where it never has.
double Path::find_end(double a_n) const {
  if (compressing_) return INFINITE;
  const double square = v_n_ * v_n_ + 2.0 * a_n * stored_;
  return square >= 0.0 && v_n_ + sqrt(square) > 0.0 ? 2.0 * stored_ / (v_n_ + sqrt(square)) : INFINITE;
}

// Whether the impact ends on the straight path dP/dp = (1, q_1, q_2) before p_most, at which the slip stops.
bool Path::follow_straight(double q_1, double q_2, double p_most) {
  const double a_n = 1.0 + flow_.n_1 * q_1 + flow_.n_2 * q_2;  // dv_n/dp
  if (p_most == INFINITE && a_n <= RANK) return true;          // no impulse in this direction moves the hulls apart
  for (;;) {
    const double v_n = v_n_, to_zero = v_n * a_n < 0.0 ? -v_n / a_n : INFINITE, to_end = find_end(a_n);
    const double p = min(min(to_zero, to_end), p_most);
    if (p == INFINITE) return true;
    const double a_1 = flow_.w_1 + flow_.A_1 * q_1, a_2 = flow_.w_2 + flow_.A_2 * q_2;
    const double slipped = q_1 * (slip_.x + 0.5 * a_1 * p) + q_2 * (slip_.y + 0.5 * a_2 * p);
    move(p, q_1 * p, q_2 * p, p * (v_n + 0.5 * a_n * p), -p * slipped);
    p_most -= p;
    if (p == to_end) return true;
    if (p != to_zero) return false;
    if (turn()) return true;
  }
}

Two Path::find_direction(double x, double y) const {
  const double length = hypot(x, y), size = -flow_.mu / (length != 0.0 ? length : 1.0);
  return {size * x, size * y};
}

// Whether the impact ends while the contact slips: in straight steps, friction of each of which is the mean of Runge and
// Kutta's four directions.
bool Path::step_along_slip() {
  const auto& [w_1, w_2, n_1, n_2, A_1, A_2, mu] = flow_;
  const double rate = flow_.rate(), stopped = STOPPED * max(1.0, hypot(slip_.x, slip_.y));
  for (int i = 0; i < MAX_STEPS; ++i) {
    const auto [x, y] = slip_;
    const double sigma = hypot(x, y);
    if (sigma <= stopped) return false;
    const Two a = find_direction(x, y);
    const double u = w_1 + A_1 * a.x, v = w_2 + A_2 * a.y, turning = (v * x - u * y) / sigma;
    // Of turning, by angle.
    const double bend = -(w_1 * x + w_2 * y) / sigma + mu * (A_1 - A_2) * (x * x - y * y) / (sigma * sigma);
    if (abs(turning) <= max(INVARIANT * rate, -NEAR * bend)) return keep_direction(bend < 0.0 ? turning / bend : 0.0);
    const double p = STEP * sigma / (hypot(u, v) + abs(bend));
    const Two b = find_direction(x + 0.5 * p * u, y + 0.5 * p * v);
    const Two c = find_direction(x + 0.5 * p * (w_1 + A_1 * b.x), y + 0.5 * p * (w_2 + A_2 * b.y));
    const Two d = find_direction(x + p * (w_1 + A_1 * c.x), y + p * (w_2 + A_2 * c.y));
    const double q_1 = (a.x + 2.0 * (b.x + c.x) + d.x) / 6.0, q_2 = (a.y + 2.0 * (b.y + c.y) + d.y) / 6.0;
    if (follow_straight(q_1, q_2, p)) return true;
  }
  return false;
}

// The same, straight on in the direction that lies -ahead [rad] from the slip.
bool Path::keep_direction(double ahead) {
  const double sigma = hypot(slip_.x, slip_.y), angle = atan2(slip_.y, slip_.x) - ahead;
  const double c = cos(angle), s = sin(angle), g = flow_.growth(angle);
  slip_ = {sigma * c, sigma * s};
  return follow_straight(-flow_.mu * c, -flow_.mu * s, g < 0.0 ? -sigma / g : INFINITE);
}

}  // namespace

Loss estimate_losses(const Rows& W, const Three& v, double mu, double e, const Rows* H) {
  const double speed = -v[0], W_nn = W[0][0];
  if (speed <= REST || W_nn <= 0.0) return {0.0, 0.0};
  Rows to_slip = W;
  for (int i = 0; i < 3 && H != nullptr; ++i) to_slip.at[i] = W[i] + (*H)[i];
  const double w_1 = to_slip[1][0], a = to_slip[1][1], b = to_slip[1][2], w_2 = to_slip[2][0], d = to_slip[2][2];
  const double turn = 0.5 * atan2(2.0 * b, a - d), c = cos(turn), s = sin(turn);
  const double A_1 = a * c * c + 2.0 * b * c * s + d * s * s, A_2 = a * s * s - 2.0 * b * c * s + d * c * c;
  const double m_1 = A_1 >= IMMOBILE * W_nn ? 1.0 / W_nn : 0.0, m_2 = A_2 >= IMMOBILE * W_nn ? 1.0 / W_nn : 0.0;
  const SlipFlow flow{(c * w_1 + s * w_2) * m_1,
                      (c * w_2 - s * w_1) * m_2,
                      (c * W[0][1] + s * W[0][2]) * m_1,
                      (c * W[0][2] - s * W[0][1]) * m_2,
                      A_1 * m_1,
                      A_2 * m_2,
                      mu};
  Path path(flow, e * e, {(c * v[1] + s * v[2]) / speed, (c * v[2] - s * v[1]) / speed});
  path.follow();
  const double unit = speed * speed / W_nn;
  return {path.E_n * unit, path.E_t * unit};
}

}  // namespace shipcollision
