#pragma once

#include "coupling/periodic/branch_equations.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Steps along a branch F(z, lambda) = 0, lengths measured by
 *
 *     |dz|^2/size^2 + dlambda^2/range^2 = ds^2.
 *
 * Newton's method begins with the derivatives of a nearby point and updates them in every step (Broyden 1965); they are
 * recomputed if convergence is slow. So a point needs few passages with tangents: one at the end, for its own
 * derivatives and multipliers.
 */
class BranchFollower
{
public:
  /// A point of the branch with what the next one needs.
  struct Point
  {
    Eigen::VectorXd  z, tangent; ///< [m], [m + 1], scaled: dz/size, dlambda/range
    double           lambda = 0.;
    PeriodicSolution solution;
    Eigen::MatrixXd  derivative;      ///< (dF/dz, dF/dlambda) [m x (m + 1)]; empty: not known
    double           regular    = 0.; ///< sign of det dF/dz times its least pivot
    int              iterations = 0;
  };

  /// What is found at a point: its motion and events alone, or multipliers, derivatives and tangent too.
  enum class Detail
  {
    motion,
    all
  };

  /// @param range      of the parameter, with the sign of its way
  /// @param tolerance  of closing()
  BranchFollower(BranchEquations &equations, double range, double tolerance);

  /// The point at fixed lambda nearest to z, with the tangent that goes on along that of `near`.
  bool at_parameter(const Eigen::VectorXd &z, double lambda, const Point &near, Point &point);
  /// The point a step along the tangent of another.
  bool beyond(const Point &from, double ds, Point &point);
  /// The point across `across` at a share of the way between two others.
  bool between(const Eigen::VectorXd &across, const Point &low, const Point &high, double share, Detail detail,
               Point &point);

  /// From a to b along the tangent of a.
  double arclength(const Point &a, const Point &b) const;
  /// Lengths of z count against the largest so far; tangents of points that are there follow.
  void grow_size(Point &point);
  /// Gives a point the unknowns that fit its motion, at its value of the parameter or across its tangent.
  /// @throws ConvergenceFailure if it does not close in them
  void refit(Point &point, bool at_parameter = false);
  /// grow_size() from a motion at rest, which has no length: that which it has at the end of the range by its
  /// derivatives.
  void size_from_rest(Point &point);

private:
  bool correct(Eigen::VectorXd z, double lambda, const Eigen::VectorXd &across, const Point &near, Point &point);
  bool finish(const Eigen::VectorXd &ahead, Point &point);
  Eigen::MatrixXd derivative(const Eigen::VectorXd &z, double lambda);
  Eigen::MatrixXd bordered(const Eigen::MatrixXd &derivative, const Eigen::VectorXd &last) const;
  Eigen::MatrixXd unscaled(const Eigen::MatrixXd &bordered) const;

  BranchEquations &equations_;
  double           range_, tolerance_, size_ = 1e-300;
};

} // namespace gestell::coupling
