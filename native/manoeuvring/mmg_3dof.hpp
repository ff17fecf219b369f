// The MMG standard model in surge, sway and yaw: the twin of shipcollision_fmu/manoeuvring/mmg_3dof.py.
#pragma once

#include "mmg.hpp"

namespace shipcollision {

// What is integrated: x, y, psi, u, v, r.
class Mmg3Dof final : public Mmg {
 public:
  bool set_up(const PreparedShip& ship, Text& why);

  Forces compute_forces(const Six& eta, const Six& nu, const Machines& machines,
                        const Surroundings& around) const override;

 protected:
  Integrated pack(const Six& eta, const Six& nu) const override;
  void unpack(const Integrated& x, Six& eta, Six& nu) const override;
  Integrated find_derivative(const Integrated& x, double delta, double n, const Surroundings& around) const override;
  double find_inflow(const Integrated& x, const Surroundings& around) const override;

 private:
  double m_u_, m_v_, m_vr_, m_r_, determinant_;
};

}  // namespace shipcollision
