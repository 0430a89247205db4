#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/QR>

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Coefficient with which an equation counts as used: those that are have some of order one.
constexpr double used_part = 1e-6;

/**
 * Which equations of the joints follow from others in one position: rank of G W^T by a QR decomposition with pivots,
 * every row scaled to its size.
 *
 * Rows that make bodies rigid are taken as independent first: an equation of a joint follows from those of joints and
 * bodies, never the other way round.
 */
class ConstraintRank
{
public:
  /// @param rows  G W^T [n_c x n], joint_jacobian()
  ConstraintRank(const Machine &machine, Eigen::MatrixXd rows);
  /// At a motion of the machine.
  static ConstraintRank at(const Machine &machine, double t, const Eigen::VectorXd &q);

  bool full() const { return dependent_ == 0; }
  /// All equations that follow from others, from those of which joints, the bodies they hold, and what can be done.
  std::string dependence() const;
  /// The equation that is nearest to follow from the others, if it is near: a dead position; else empty.
  std::string nearly_dependent() const;

private:
  std::string              joint_of(int row) const; ///< in quotes; empty where the row makes a body rigid
  std::vector<std::string> bodies_of(int row) const;

  const Machine                              &machine_;
  Eigen::MatrixXd                             rows_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  int                                         dependent_ = 0;
};

} // namespace gestell::coupling
