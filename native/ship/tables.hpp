// Tables of a prepared ship: the twins of those in shipcollision_fmu/ship/tables/manoeuvring.py, as far as steps need
// them, in the order of the prepared file.
#pragma once

namespace shipcollision {

struct ManoeuvringTable {
  double R_0, X_vv, X_vr, X_rr, X_vvvv, Y_v, Y_r, Y_vvv, Y_vvr, Y_vrr, Y_rrr, N_v, N_r, N_vvv, N_vvr, N_vrr, N_rrr;
};

struct PropellerTable {
  double D_p, t_P, w_P0, x_P, C_1, C_2_plus, C_2_minus, k_0, k_1, k_2, astern_factor;
};

struct RudderTable {
  double A_R, H_R, f_alpha, t_R, a_H, x_H, x_R, l_R, gamma_R_minus, gamma_R_plus, epsilon, kappa, max_angle_deg,
      rate_deg_per_s;
};

struct EngineTable {
  double rate, max_rev_per_s, max_astern_rev_per_s, reversal_delay;
};

}  // namespace shipcollision
