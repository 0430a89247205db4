#pragma once

#include "coupling/integration/system/excitation.h"

#include <vector>

namespace gestell::coupling
{

/**
 * f_t at t_0 + k h.  A harmonic turns from point to point by the same angle: cosines and sines of omega t are computed
 * at every 16th point and multiplied by those of j omega h in between, which adds a rounding error of one product.
 * The value depends on (t_0, h, k) alone, not on the points asked for before.
 */
class ExcitationOnGrid
{
public:
  explicit ExcitationOnGrid(const Excitation &excitation) : excitation_(excitation) {}

  /// Allocates only when h changes.  @pre k >= 0
  void find(double t_0, double h, long k);
  /// f_t [n] of the last find().
  const Eigen::VectorXd &value() const { return f_; }

private:
  static constexpr long points = 16; ///< between two of which a cosine costs less than the product

  using Turns = Eigen::Array<double, Eigen::Dynamic, 2>; ///< cos, sin by harmonic

  const Excitation  &excitation_;
  double             t_0_ = 0., h_ = 0.;
  long               block_ = -1; ///< of `points` points, whose first is first_
  Turns              first_, now_;
  Eigen::VectorXd    f_;
  std::vector<Turns> steps_; ///< of j omega h
};

} // namespace gestell::coupling
