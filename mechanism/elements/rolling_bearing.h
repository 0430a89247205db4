#pragma once

#include "mechanism/differentiable_element.h"

#include <vector>

namespace gestell::mechanism
{

/**
 * Rolling bearing: a radial force by a table over the eccentricity of its shaft, the same in all radial directions, and
 * an axial spring.
 *
 * Measures: displacement (y1, y2, z) of the shaft relative to the bearing [m], z along the axis. With r = |y|
 *
 *     p_y = -F(r) y/r - b y',     p_z = -c_a z - b z'
 *
 * F(0) = 0; F passes through the rows, never falls and has a continuous stiffness F'; beyond the last row it continues
 * straight. The radial energy, the integral of F, and c_a z^2/2 are stored.
 *
 * Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304 (slopes at the rows);
 * docs/theory/elements.md, Rolling bearing.
 */
class RollingBearing : public DifferentiableElement<RollingBearing, 3, Structure>
{
public:
  struct Row
  {
    double deflection; ///< r [m], > 0, rising
    double force;      ///< F [N], >= 0, not falling
  };

  struct Parameters
  {
    std::vector<Row> rows;                 ///< one or more, without that at r = 0
    double           damping         = 0.; ///< b [N s/m], >= 0
    double           axial_stiffness = 0.; ///< c_a [N/m], >= 0
  };

  explicit RollingBearing(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *, Number *p) const
  {
    using std::sqrt;
    const Number r2     = m.u[0] * m.u[0] + m.u[1] * m.u[1];
    Number       secant = Number(at(0.).stiffness); // F/r
    if (value(r2) > 0.)
    {
      const Number r = sqrt(r2);
      const Value  F = at(value(r));
      secant         = (F.force + F.stiffness * (r - value(r))) / r;
    }
    p[0] = -secant * m.u[0] - damping_ * m.v[0];
    p[1] = -secant * m.u[1] - damping_ * m.v[1];
    p[2] = -axial_stiffness_ * m.u[2] - damping_ * m.v[2];
  }

  void                  engaged(const double *u, double *K, double *D) const override;
  void                  stiffest(const double *u, double *K, double *D) const override;
  double                stored_energy(const LocalMotion &motion, const double *history) const override;
  double                stored_power(const LocalMotion &motion, const double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  struct Value
  {
    double force, stiffness, energy; ///< F, F', integral of F
  };
  /// Cubic from r = begin on, until the next one begins; the last one is straight.
  struct Piece
  {
    double begin, force, stiffness, second, third, energy;
  };
  Value at(double r) const;

  std::vector<Piece> pieces_;
  double             damping_, axial_stiffness_;
};

} // namespace gestell::mechanism
