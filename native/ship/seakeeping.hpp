// Stiffness and damping in heave, roll and pitch, which shipcollision_fmu/ship/seakeeping.py computes for a prepared
// ship.
#pragma once

namespace shipcollision {

struct Seakeeping {
  double K_33, K_44, K_55, D_33, D_44, D_44q, D_55, GM_T, GM_L, BM_T, tan_deck, x_F, z_H, z_R, z_P;
};

}  // namespace shipcollision
