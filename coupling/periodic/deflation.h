#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * Deflates known zeros of r(z) from a search: M r has only the other zeros, with
 *
 *     M(z) = prod_k (size^2/|z - z_k|^2 + 1),
 *
 * infinite at each z_k and 1 far from it.
 *
 * Source: Farrell, Birkisson and Funke, SIAM Journal on Scientific Computing 37(4), 2015, A2026-A2045, with p = 2 and
 * shift 1.
 */
class Deflation
{
public:
  /// @param size  distance within which M keeps off, > 0
  explicit Deflation(double size) : size_(size) {}

  void add(const Eigen::VectorXd &z) { known_.push_back(z); }

  /// M, and its gradient over z divided by M.  At a known zero M is as large as a 1e-12th of the size away.
  double factor(const Eigen::VectorXd &z, Eigen::VectorXd &slope) const;

private:
  double                       size_;
  std::vector<Eigen::VectorXd> known_;
};

} // namespace gestell::coupling
