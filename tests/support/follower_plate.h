#pragma once

#include "tests/support/scene_parts.h"

#include <Eigen/Eigenvalues>

#include <complex>
#include <string>
#include <vector>

namespace gestell::tests
{

/// A plate of 2 kg and 0.3 kg m^2 in the plane of x and z on springs: 1 kN/m along x at 0.3 m above its centre, 900 N/m
/// along z and 50 N m/rad about y, under a load of P upwards from it that turns with it.  It flutters from P = -301 N
/// on, upwards that is.  `b` [s] dampers by their springs.
inline std::string follower_plate(double P, double b)
{
  return planar_body("plate", "2", "0.3", "[0, 0, 0]") +
         element("x", "spring-damper",
                 {{"from", "plate"},
                  {"at_from", "[0, 0, 0.3]"},
                  {"direction", "[1, 0, 0]"},
                  {"stiffness", "1000"},
                  {"damping", number(1000. * b)}}) +
         element("z", "spring-damper",
                 {{"from", "plate"}, {"direction", "[0, 0, 1]"}, {"stiffness", "900"}, {"damping", number(900. * b)}}) +
         element("y", "spring-damper",
                 {{"from", "plate"}, {"about", "[0, 1, 0]"}, {"stiffness", "50"}, {"damping", number(50. * b)}}) +
         element("thrust", "force",
                 {{"from", "plate"},
                  {"at_from", "[0, 0, 0.1]"},
                  {"direction", "[0, 0, -1]"},
                  {"carried_by", "plate"},
                  {"constant", number(P)}});
}

/// s of its six small motions, exp(s t): K of x and the angle is [k, k h + P; k h, k h^2 + c].
inline std::vector<std::complex<double>> plate_roots(double P, double b)
{
  Eigen::Matrix3d held, K;
  held << 1000., 300., 0., 300., 140., 0., 0., 0., 900.;
  K = held;
  K(0, 1) += P;
  const Eigen::Vector3d       lightness(1. / 2., 1. / 0.3, 1. / 2.);
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  A.topRightCorner<3, 3>().setIdentity();
  A.bottomLeftCorner<3, 3>()                        = -Eigen::Matrix3d(lightness.asDiagonal() * K);
  A.bottomRightCorner<3, 3>()                       = -b * Eigen::Matrix3d(lightness.asDiagonal() * held);
  const Eigen::Matrix<std::complex<double>, 6, 1> s = A.eigenvalues();
  return {s.data(), s.data() + s.size()};
}

} // namespace gestell::tests
