#pragma once

#include "mechanism/local_motion.h"

#include <cmath>

namespace gestell::mechanism
{

/// Play of an element: relative displacements s of two bodies that are free for |s| <= gap.
struct Play
{
  static constexpr int max_motions = 2;

  int    n              = 0;    ///< number of displacements s, zero at the centre of the play; 0: no play
  double gap            = 0.;   ///< [m, rad]
  bool   both           = true; ///< false: no lower limit of s, as for a stop, whose gap may be negative
  double s[max_motions] = {}, rate[max_motions] = {}, bias[max_motions] = {}; ///< s' = G v, s'' = G a + bias

  /// Distance of s from the middle, of one side from where s is counted.
  double eccentricity() const { return both ? std::hypot(s[0], s[1]) : s[0]; }
  bool   presses() const { return n > 0 && eccentricity() > gap; }
};

/**
 * Facet of an element with stiffness or damping, for natural frequencies and the step of an integrator.
 *
 * Stiffness K = -dp/du and damping D = -dp/dv [k x k, column major] are zeroed by the functions of facets.h before a
 * method is called; it sets the nonzero entries.
 */
class Structure
{
public:
  /// K and D of the engaged element (play closed) at the configuration u;
  /// without geometric stiffness. Used for natural frequencies. Zero (the default) for technological forces and drives,
  /// which are not structure.
  virtual void engaged(const double *u, double *K, double *D) const { (void)u, (void)K, (void)D; }

  /// K and D of the stiffest branch of the law near u, technological forces included, for the stability of the
  /// integrator.  Default: engaged().
  virtual void stiffest(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// K and D of the part that acts in every branch of the law, also when the element is open: the oil film of a rod
  /// with play.  Default: engaged(), of a law without a branch in which it is open.
  virtual void open_branch(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// Stiffness grows with the deflection, so that stiffest() at one configuration is not a bound: a Hertzian contact.
  virtual bool stiffens() const { return false; }

  /// Geometric stiffness [k x k, column major]: of a force that rotates with the motion, -d(G^T)/du P, at the forces of
  /// `motion` (of a joint its multipliers), and of the rates G v it depends on.  At rest it is the tangent together
  /// with engaged(); dp/du of ForceLaw::derivatives() less it is the whole derivative.
  virtual void geometric(const LocalMotion &, const double *history, double *K) const { (void)history, (void)K; }

  /// Position function that the engaged element closes, g(u) = 0 (compression of a rod, twist of a coupling):
  /// returns false if there is none; else g, its gradient [k] and its second derivative along v, v^T g'' v.
  virtual bool closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const
  {
    return (void)u, (void)v, (void)g, (void)gradient, (void)curvature, false;
  }

  /// The play at u, v with the gradients G of its displacements [k x n, column major].
  virtual Play play(const double *u, const double *v, double *G) const { return (void)u, (void)v, (void)G, Play(); }

  /// Deflection [m, rad] beyond the gap of its play under a force [N, N m].
  virtual double yielding(double force) const { return (void)force, 0.; }

  /// Penetration [m or rad] of bodies in contact; 0: open, or no contact.
  virtual double penetration(const LocalMotion &) const { return 0.; }

protected:
  ~Structure() = default;
};

} // namespace gestell::mechanism
