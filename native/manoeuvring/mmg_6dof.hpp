// The MMG model with roll (4 degrees of freedom) and with heave, roll and pitch (6): the twin of
// shipcollision_fmu/manoeuvring/mmg_6dof.py.
#pragma once

#include "../ship/damping.hpp"
#include "../ship/frames.hpp"
#include "../ship/restoring.hpp"
#include "mmg.hpp"

namespace shipcollision {

// What is integrated: eta and nu.
class Mmg6Dof final : public Mmg {
 public:
  bool set_up(const PreparedShip& ship, int degrees_of_freedom, Text& why);

  Forces compute_forces(const Six& eta, const Six& nu, const Machines& machines,
                        const Surroundings& around) const override;

 protected:
  Integrated pack(const Six& eta, const Six& nu) const override;
  void unpack(const Integrated& x, Six& eta, Six& nu) const override;
  Integrated find_derivative(const Integrated& x, double delta, double n, const Surroundings& around) const override;
  double find_inflow(const Integrated& x, const Surroundings& around) const override;

 private:
  struct Angles {
    double s_phi, c_phi, s_theta, c_theta, s_psi, c_psi;
  };
  struct Wrenches {
    Six hull, propeller, rudder;
  };

  Angles find_angles(double phi, double theta, double psi) const;
  Three find_current(const Angles& angles, const Surroundings& around) const;
  Wrenches compute_wrenches(double u, double v, double p, double q, double r, double delta, double n) const;
  void add_inertia_forces(double u, double v, double w, double p, double q, double r, Six& force) const;

  bool level_;
  Restoring restoring_;
  Damping damping_;
  double z_H_, z_P_, z_R_, z_RY_;
  double M_even_[6], M_odd_[6];  // upper triangles
  double even_[3][3], odd_[3][3];
  double munk_[2];
};

}  // namespace shipcollision
