#pragma once

#include "mechanism/local_motion.h"

#include <cmath>

namespace gestell::mechanism
{

/// Play of an element: relative motions s of two bodies in which it leaves them free as far as |s| <= gap.
struct Play
{
  static constexpr int max_motions = 2;

  int    n              = 0;    ///< number of motions s, which are zero in the middle of the play; 0: there is no play
  double gap            = 0.;   ///< [m, rad]
  bool   both           = true; ///< false: nothing limits s below, as of a stop, whose gap may be negative
  double s[max_motions] = {}, rate[max_motions] = {}, bias[max_motions] = {}; ///< s' = G v, s'' = G a + bias

  /// Distance of s from the middle, of one side from where s is counted.
  double eccentricity() const { return both ? std::hypot(s[0], s[1]) : s[0]; }
  bool   presses() const { return n > 0 && eccentricity() > gap; }
};

/**
 * Facet of an element that is stiff or damps: what natural frequencies and the step of an integrator see of it.
 *
 * Stiffness K = -dp/du and damping D = -dp/dv [k x k, column major] are zero when a method is called; it sets what
 * differs.  The functions of facets.h see to that.
 */
class Structure
{
public:
  /// K and D the element has as part of the structure when it is engaged (play closed) at the configuration u;
  /// without geometric stiffness. Used for natural frequencies. Zero (the default) for technological forces and drives,
  /// which are not structure.
  virtual void engaged(const double *u, double *K, double *D) const { (void)u, (void)K, (void)D; }

  /// K and D of the stiffest branch of the law near u, technological forces included: what the step of an integrator
  /// has to stand.  Default: engaged().
  virtual void stiffest(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// K and D as engaged() tells them of what acts in every branch of the law, so that it stays when the element is
  /// open: the oil film of a rod with play.  Default: engaged(), of a law without a branch in which it is open.
  virtual void open_branch(const double *u, double *K, double *D) const { engaged(u, K, D); }

  /// Stiffness grows with the deflection, so that stiffest() at one configuration is not a bound: a Hertzian contact.
  virtual bool stiffens() const { return false; }

  /// Geometric stiffness [k x k, column major]: of a force that turns with the motion, -d(G^T)/du P, at the forces of
  /// `motion` (of a joint its multipliers), and of the rates G v it depends on.  At rest it is the tangent together
  /// with engaged(); dp/du of ForceLaw::derivatives() less it is the whole derivative.
  virtual void geometric(const LocalMotion &, const double *history, double *K) const { (void)history, (void)K; }

  /// Position function the element closes when it is engaged, g(u) = 0 (compression of a rod, twist of a coupling):
  /// returns false if there is none; else g, its gradient [k] and its second derivative along v, v^T g'' v.
  virtual bool closure(const double *u, const double *v, double &g, double *gradient, double &curvature) const
  {
    return (void)u, (void)v, (void)g, (void)gradient, (void)curvature, false;
  }

  /// The play at u, v with the gradients G of its displacements [k x n, column major].
  virtual Play play(const double *u, const double *v, double *G) const { return (void)u, (void)v, (void)G, Play(); }

  /// How far [m, rad] beyond the gap of its play the element yields to a force [N, N m].
  virtual double yielding(double force) const { return (void)force, 0.; }

  /// How deep [m or rad] bodies that a contact keeps apart lie in each other; 0: they do not, or nothing keeps them.
  virtual double penetration(const LocalMotion &) const { return 0.; }

protected:
  ~Structure() = default;
};

} // namespace gestell::mechanism
