// Windage of a prepared ship, which shipcollision_fmu/ship/windage.py computes.
#pragma once

namespace shipcollision {

struct Windage {
  double A_Fw, A_Lw, s_L, s_H, C_Dt, C_Dl_bow, C_Dl_stern, delta, kappa;
};

}  // namespace shipcollision
