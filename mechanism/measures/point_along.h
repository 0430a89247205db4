#pragma once

#include "mechanism/local_motion.h"
#include "mechanism/measures/placement.h"

#include <array>

namespace gestell::mechanism
{

/**
 * The coordinate a . x(u) of a point of a body along a direction a fixed in space, with what a turn phi of the body
 * leaves of it and of its derivatives; the usual equation of a pin needs nothing else:
 *
 *     a . x(u) = b_0 + c_0 cos(phi) + s_0 sin(phi) + sum u_i (b_i + c_i cos(phi) + s_i sin(phi))
 *
 * over the linear measures u_i; c_i and s_i are zero unless these tilt the body.
 *
 * Source: Placement, multiplied out.
 */
class PointAlong
{
public:
  /// cos(phi), sin(phi)
  static Turn turn(const Placement &placement, const double *u);

  PointAlong(const Placement &placement, const Vector3d &a);

  /// a . x, and its gradient [k], in every `stride`-th entry.
  double value(const double *u, const Turn &turn, double *gradient, int stride) const;
  /// False: entry i of the gradient is always zero.
  bool depends(int i) const;
  /// a . x'' - gradient . u''
  double bias(const double *u, const double *v, const Turn &turn) const;

private:
  struct Term
  {
    double fixed = 0., cosine = 0., sine = 0.; ///< b_i, c_i, s_i
  };
  /// c_0 + sum u_i c_i, s_0 + sum u_i s_i
  Turn turned(const double *u) const;

  int                                       n_linear_ = 0;
  bool                                      turns_, tilts_ = false; ///< some c_i or s_i is not zero
  Term                                      point_;                 ///< i = 0
  std::array<Term, Placement::max_measures> linear_;
};

} // namespace gestell::mechanism
