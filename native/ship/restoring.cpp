#include "restoring.hpp"

#include "../numbers/elementary.hpp"

namespace shipcollision {

Restoring::Restoring(const Seakeeping& sea)
    : K_33_(sea.K_33),
      K_44_(sea.K_44),
      K_55_(sea.K_55),
      K_44_BM_(0.5 * sea.K_44 * sea.BM_T / sea.GM_T),
      x_F_(sea.x_F),
      tan2_deck_(sea.tan_deck * sea.tan_deck),
      cos_deck_(cos(atan(sea.tan_deck))) {}

double Restoring::compute_roll_moment(double s_phi, double c_phi) const {
  const double tan2 = c_phi > cos_deck_ ? s_phi * s_phi / (c_phi * c_phi) : tan2_deck_;
  return -(K_44_ + K_44_BM_ * tan2) * s_phi;
}

Six Restoring::operator()(double D, double s_phi, double c_phi, double s_theta, double c_theta) const {
  const double Z_n = -K_33_ * (D - x_F_ * s_theta);
  const double Q_phi = compute_roll_moment(s_phi, c_phi), Q_theta = -K_55_ * s_theta;
  const double about_z = Q_phi * s_theta / c_theta;
  const double Y = Z_n * c_theta * s_phi, Z = Z_n * c_theta * c_phi;
  return {{-Z_n * s_theta, Y, Z, Q_phi, about_z * s_phi + Q_theta * c_phi - x_F_ * Z,
           about_z * c_phi - Q_theta * s_phi + x_F_ * Y}};
}

}  // namespace shipcollision
