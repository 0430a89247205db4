#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/QR>

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Coefficient above which an equation is part of a dependence; true ones have some coefficients of order one.
constexpr double used_part = 1e-6;

/**
 * Redundant joint equations in one position: rank of G W^T by a pivoted QR decomposition, with every row scaled to its
 * size.
 *
 * Rows that make bodies rigid are taken as independent first: an equation of a joint can depend on those of joints and
 * bodies, but never the other way round.
 */
class ConstraintRank
{
public:
  /// @param rows  G W^T [n_c x n], joint_jacobian()
  ConstraintRank(const Machine &machine, Eigen::MatrixXd rows);
  /// At a motion of the machine.
  static ConstraintRank at(const Machine &machine, double t, const Eigen::VectorXd &q);

  bool full() const { return dependent_ == 0; }
  /// Text of all redundant equations: on which joints they depend, the bodies these constrain, and the remedy.
  std::string dependence() const;
  /// The equation that is almost redundant, if there is one: a dead position; else empty.
  std::string nearly_dependent() const;

private:
  std::string              joint_of(int row) const; ///< quoted; empty if the row makes a body rigid
  std::vector<std::string> bodies_of(int row) const;

  const Machine                              &machine_;
  Eigen::MatrixXd                             rows_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  int                                         dependent_ = 0;
};

} // namespace gestell::coupling
