#pragma once

#include "coupling/frame/reduced_frame.h"
#include "tests/support/scene_parts.h"

#include <Eigen/Eigenvalues>

#include <string>

namespace gestell::test
{

/// The chain of masses, to be reduced to all of its two modes.
inline const std::string reduced_chain = "name = \"chain\"\n" + tests::mass_chain() +
                                         tests::table("frame.support.foot", {{"stiffness_row", "[1e6, 0, 0]"}}) +
                                         tests::table("reduction", {{"method", "craig-bampton"}, {"modes", "2"}}) +
                                         tests::steps("10 us", "0.1 s") + "[output.signals]\nx = \"frame.top.uz\"\n";

/// What the reduction makes of it, (5.5.3/14-20) by hand.
inline coupling::ReducedFrame chain_frame()
{
  const double                                         m = 100., k = 1e6;
  const Eigen::Matrix2d                                C22 = (Eigen::Matrix2d() << 2. * k, -k, -k, 2. * k).finished();
  const Eigen::Vector2d                                C21(0., -k);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(C22 / m);
  Eigen::Matrix3d                                      T = Eigen::Matrix3d::Zero(), C = Eigen::Matrix3d::Zero();
  T(2, 0)               = 1.;
  T.block<2, 1>(0, 0)   = -C22.ldlt().solve(C21);
  T.block<2, 2>(0, 1)   = modes.eigenvectors() / std::sqrt(m);
  C.topLeftCorner(2, 2) = C22;
  C.block<2, 1>(0, 2)   = C21;
  C.block<1, 2>(2, 0)   = C21.transpose();
  C(2, 2)               = k;

  coupling::ReducedFrame frame;
  frame.n_interface = 1;
  frame.M           = m * T.transpose() * T;
  frame.M.bottomRightCorner(2, 2).setIdentity();
  frame.B = 1e-4 * frame.M;
  frame.C = Eigen::Vector3d(T.col(0).dot(C * T.col(0)), modes.eigenvalues()[0], modes.eigenvalues()[1]).asDiagonal();
  frame.omega0 = modes.eigenvalues().cwiseSqrt();
  fem::Interface top;
  top.name                       = "top";
  top.coordinate[fem::uz]        = 0;
  frame.interfaces               = {top};
  frame.translations_load        = Eigen::MatrixXd::Zero(3, 3);
  frame.translations_load.col(2) = m * T.transpose() * Eigen::Vector3d::Ones();
  frame.outputs                  = {{"support.foot", "N", k * T.row(0).transpose(), Eigen::Vector3d::Zero()}};
  frame.n_full                   = 3;
  frame.mass                     = 3. * m;
  frame.frequencies_hz           = Eigen::Vector3d(1., 2., 3.);
  frame.frequency_error          = Eigen::Vector3d::Zero();
  return frame;
}

} // namespace gestell::test
