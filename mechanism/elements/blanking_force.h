#pragma once

#include "mechanism/differentiable_element.h"

#include <cmath>

namespace gestell::mechanism
{

/**
 * Blanking (shearing through) of a sheet, with its history.
 *
 * Measure u [m]: displacement of the punch against the die in feed direction; penetration z = u - x_T.  The force
 * F >= 0 [N] resists: p = -F.  With F_max = k_s L_s h, z_m = eps_m h, z_d = z_m + eps_d h the virgin curve is
 *
 *     0 < z < z_m     F_v = F_max [1 - (1 - z/z_m)^n]                                                     rise
 *     z_m <= z < z_d  F_v = F_max [1 - (1 - rho)(3 xi^2 - 2 xi^3)],   xi = (z - z_m)/(z_d - z_m)          fracture
 *     z_d <= z < h    F_v = rho F_max [1 - (3 xi^2 - 2 xi^3)],        xi = (z - z_d)/(h - z_d)            slug friction
 *     else            F_v = 0
 *
 * and with the largest penetration z_max <= h so far (h if the sheet is severed),
 *
 *     F = F_v(z) if z >= z_max, else max(0, F_v(z_max) - c_el (z_max - z));      0 permanently once z has reached h.
 *
 * The stored energy F^2/(2 c_el) is released by unloading; the rest is dissipated.  Source: reference model of the
 * crank press, section 3; docs/theory/elements.md.
 */
class BlankingForce : public DifferentiableElement<BlankingForce, 1, Branches, Structure>
{
public:
  struct Parameters
  {
    double thickness            = 0.;   ///< h [m], > 0
    double cut_length           = 0.;   ///< L_s [m], > 0
    double shear_resistance     = 0.;   ///< k_s [Pa], > 0
    double peak_penetration     = 0.35; ///< eps_m, z_m / h, in (0, 1)
    double rise_exponent        = 8.;   ///< n, >= 1
    double fracture_penetration = 0.25; ///< eps_d, (z_d - z_m)/h, > 0, eps_m + eps_d < 1
    double friction_share       = 0.08; ///< rho, in [0, 1]
    double elastic_stiffness    = 0.;   ///< c_el [N/m], above the initial slope n F_max/z_m
    double contact_at           = 0.;   ///< x_T [m], u at which the punch touches
  };

  explicit BlankingForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const double z_max  = history[0];
    const Number z      = m.u[0] - parameters_.contact_at;
    const Branch branch = m.by_history ? branch_of(history) : branch_at(value(z), z_max);
    if (branch == elastic)
      p[0] = -(virgin(virgin_branch(z_max), z_max) - parameters_.elastic_stiffness * (z_max - z));
    else
      p[0] = -virgin(branch, z);
  }

  /// c_el, the stiffness of unloading and reloading.
  void stiffest(const double *u, double *K, double *D) const override;

  /// history: z_max [m], active branch.
  int  n_history() const override { return 2; }
  void start(const LocalMotion &motion, double *history) const override;
  void accept(const LocalMotion &motion, double *history) const override;

  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;

  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  double peak_force() const { return F_max_; } ///< F_max [N]

private:
  enum Branch
  {
    rise,
    fracture,
    slug_friction,
    elastic,
    apart,
    through
  };

  static Branch branch_of(const double *history) { return static_cast<Branch>(static_cast<int>(history[1])); }

  Branch virgin_branch(double z) const
  {
    return !(z > 0.)                   ? apart
           : z < z_m_                  ? rise
           : z < z_d_                  ? fracture
           : z < parameters_.thickness ? slug_friction
                                       : through;
  }

  Branch branch_at(double z, double z_max) const
  {
    if (z_max >= parameters_.thickness)
      return through;
    if (z >= z_max)
      return virgin_branch(z);
    const double unloading = virgin(virgin_branch(z_max), z_max) - parameters_.elastic_stiffness * (z_max - z);
    return unloading > 0. ? elastic : apart;
  }

  /// F_v by the formula of one branch, also beyond its ends; 0 in those without contact.
  template <typename Number>
  Number virgin(Branch branch, const Number &z) const
  {
    const double h = parameters_.thickness, rho = parameters_.friction_share;
    if (branch == rise)
      return F_max_ * (1. - power(Number(1. - z / z_m_)));
    if (branch == fracture)
    {
      const Number xi = (z - z_m_) / (z_d_ - z_m_);
      return F_max_ * (1. - (1. - rho) * xi * xi * (3. - 2. * xi));
    }
    if (branch == slug_friction)
    {
      const Number xi = (z - z_d_) / (h - z_d_);
      return rho * F_max_ * (1. - xi * xi * (3. - 2. * xi));
    }
    return Number(0.);
  }

  /// x^n; for x < 0, beyond the maximum, it is continued only for integer n; otherwise all derivatives that exist at x
  /// = 0 are zero there, and the continuation is zero.
  template <typename Number>
  Number power(const Number &x) const
  {
    using std::pow;
    const double n = parameters_.rise_exponent;
    if (x < 0. && n != std::floor(n))
      return Number(0.);
    return pow(x, n);
  }

  double lift_off(double z_max) const; ///< z_e, penetration at which the unloading line reaches zero

  Parameters parameters_;
  double     F_max_, z_m_, z_d_;
};

} // namespace gestell::mechanism
