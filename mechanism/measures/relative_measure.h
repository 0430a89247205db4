#pragma once

#include "mechanism/measures/placement.h"

#include <vector>

namespace gestell::mechanism
{

/**
 * A scalar s of the motion of two points x_1, x_2 on two bodies, with d = x_2 - x_1:
 *
 *     along          a . d               a fixed in space, or carried by one of the bodies    [m]
 *     square         a_1 . b_2           cosine between directions carried by the two         [1]
 *     distance       |d|                                                                      [m]
 *     inclination    atan2(b . d, a . d) angle of the line about a x b, in (-pi, pi]          [rad]
 *     angle          atan2(b_1 . a_2 - a_1 . b_2, a_1 . a_2 + b_1 . b_2)   of body 2 against
 *                    body 1 about a x b                                                    [rad]
 *     ratio          sum c_i u_i         of the measures themselves                           [m or rad]
 *     spin           s' = a . (w_2 - w_1), angular velocities; s itself has no meaning, 0     [rad/s]
 *     gear, strand   sum c_i u_i - c psi + f [h(D) - h(D_0)], the common tangent of two wheels  [m]
 *
 * of which D = |d| in the plane of a, b and psi is the inclination, for `gear` continued over any number of turns near
 * s = 0, for `strand` in (-pi, pi]. The tangent touches circles with the sum or difference b = |c/f| of their radii; it
 * has the length sqrt(D^2 - b^2) between them, and
 *
 *     h(D) = sqrt(D^2 - b^2) - b arccos(b/D),     h' = sqrt(1 - (b/D)^2).
 *
 * Ideal joints prescribe its value, elements act on it, signals report it.
 *
 * Source: docs/theory/joints.md (2); of spin contact.md (4a), of gear, strand position_functions.md (2a).
 */
struct RelativeMeasure
{
  enum class Form
  {
    along,
    square,
    distance,
    inclination,
    angle,
    ratio,
    spin,
    gear,
    strand
  };
  enum class Carrier
  {
    space,
    first,
    second
  };

  /// Whether s jumps by 2 pi at pi.
  bool wraps() const { return form == Form::inclination || form == Form::angle; }

  Form                form    = Form::along;
  Vector3d            a       = Vector3d::Zero(); ///< direction; of `square` on body 1
  Vector3d            b       = Vector3d::Zero(); ///< for `square` on body 2; for both angles normal to a
  Carrier             carrier = Carrier::space;   ///< of a in `along`
  std::vector<double> ratios;                     ///< c_i [k] of `ratio`, `gear` and `strand`
  double              reach      = 0.;            ///< c of `gear`, not zero, and `strand` [m]
  double              flank      = 0.;            ///< f of `gear` and `strand`; 0: forces have no part along d
  double              distance_0 = 0.;            ///< D_0 of both [m], at least |c/f|

  /// s, s' = G u' and s'' = G u'' + bias.
  struct Value
  {
    double s, rate, bias;
  };

  /// The two places with where they are at u, v [k].
  struct Places
  {
    const Placement              &first, &second;
    const Placement::MovedVector &x_1, &x_2;
  };

  /// @param v         null: s and G alone are wanted, the places know no rates
  /// @param gradient  G: k numbers, each `stride` behind the one before
  Value evaluate(const Places &places, const double *u, const double *v, double *gradient,
                 Eigen::Index stride = 1) const;

private:
  struct Pair;

  Value along(Pair &pair) const;
  Value square(Pair &pair) const;
  Value distance(Pair &pair) const;
  Value inclination(Pair &pair) const;
  Value angle(Pair &pair) const;
  Value spin(Pair &pair) const;
  Value ratio(Pair &pair) const;
  /// Of `gear` and `strand`: what the line of centres adds to `wound`, the sum c_i u_i of the wheels.
  Value mesh(const Vector3d &d, const Vector3d &d_rate, const Vector3d &d_bias, double wound, Vector3d &of_d) const;
};

/// Positions of two bodies, and a scalar of their motion.
struct PlacedMeasure
{
  Placement       first, second;
  RelativeMeasure measure;

  static constexpr int max_measures = 2 * Placement::max_measures;

  /// One measure of the machine itself: s = u.
  static PlacedMeasure linear();

  int                    n_measures() const { return first.n_measures() + second.n_measures(); }
  RelativeMeasure::Value evaluate(const double *u, const double *v, double *gradient) const;
  /// matrix += factor s''(u) [k x k, column major].
  void add_curvature(const double *u, double factor, double *matrix) const;
};

/**
 * matrix [k x k, column major] += factor s''(u), where bias(v) is the quadratic form v^T s''(u) v of a velocity v [k]:
 * its polarisation gives the entries exactly.
 *
 * @param k  at most most_measures
 */
template <int most_measures, class Bias>
void add_polarised(int k, const Bias &bias, double factor, double *matrix)
{
  double v[most_measures] = {}, own[most_measures];
  for (int i = 0; i < k; ++i)
  {
    v[i]   = 1.;
    own[i] = bias(v);
    v[i]   = 0.;
  }
  for (int j = 0; j < k; ++j)
    for (int i = 0; i <= j; ++i)
    {
      v[i] = v[j]       = 1.;
      const double both = i == j ? own[i] : 0.5 * (bias(v) - own[i] - own[j]);
      v[i] = v[j] = 0.;
      matrix[i + k * j] += factor * both;
      if (i != j)
        matrix[j + k * i] += factor * both;
    }
}

} // namespace gestell::mechanism
