#pragma once

#include "mechanism/differentiable_element.h"

#include <array>

namespace gestell::mechanism
{

/**
 * Two one-sided springs along the two common tangents of two wheels: strands of a belt, which only pull, or flanks of
 * teeth, which only push. Measures u = (u_L, u_R, D - D_0) [m]: left and right tangent, seen from the first wheel
 * towards the second against the axis, in the direction in which it is loaded, and the distance of the centres. With
 * d_i = u_i + d_0
 *
 *     d_i > 0 and c d_i + b u_i' > 0:   F_i = c d_i + b u_i',   p_i = -F_i,        otherwise p_i = 0.
 *
 * d_0 > 0 is the elongation of a belt by its pretension, d_0 < 0 half of a backlash, or slack. With b > 0 a force
 * begins with a jump. The energy c d_i^2/2 is stored while d_i > 0, the rest is dissipated. The force p_3 is zero.
 *
 * Source: docs/theory/elements.md, Belts, chains and gears.
 */
class CommonTangents : public DifferentiableElement<CommonTangents, 3, Branches, Structure>
{
public:
  struct Parameters
  {
    double stiffness = 0.; ///< c [N/m] of one tangent, > 0
    double damping   = 0.; ///< b [N s/m], >= 0
    double initial   = 0.; ///< d_0 [m]
    double circles   = 0.; ///< sum or difference of the radii of the circles that the tangents touch [m], signed
    double distance  = 0.; ///< D_0 [m], above |circles|
  };

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const auto &own = parameters_;
    for (int i = 0; i < 2; ++i)
    {
      const Branch branch = m.by_history ? branch_of(history, i) : branch_at(value(m.u[i]), value(m.v[i]));
      p[i] = branch == loaded ? Number(-own.stiffness * (m.u[i] + own.initial) - own.damping * m.v[i]) : Number(0.);
    }
    p[2] = Number(0.);
  }

  /// Of the tangents that are loaded, at least of the one closest to it.
  void engaged(const double *u, double *K, double *D) const override;
  void stiffest(const double *u, double *K, double *D) const override;
  void open_branch(const double *, double *, double *) const override {}

  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;

  /// history: branches of both tangents.
  int                n_history() const override { return 2; }
  void               start(const LocalMotion &motion, double *history) const override;
  int                n_guards(const double *history) const override;
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

protected:
  CommonTangents(const std::string &name, const Parameters &parameters);

  const Parameters &parameters() const { return parameters_; }
  /// F_L, F_R [N]
  std::array<double, 2> loads(const LocalMotion &motion, const double *history) const;
  /// Sine of the angle between the line of centres and a tangent, with the sign of `circles`.
  double sine(const LocalMotion &motion) const;

private:
  enum Branch
  {
    open,
    loaded,
    released
  };

  virtual std::string event(bool loading) const = 0;
  double              deflection(const LocalMotion &motion, int i) const; ///< d_i, at least zero [m]
  double              load(double u, double v) const                      ///< F/c [m]
  {
    return u + parameters_.initial + parameters_.damping / parameters_.stiffness * v;
  }
  static Branch branch_of(const double *history, int i) { return static_cast<Branch>(static_cast<int>(history[i])); }
  Branch        branch_at(double u, double v) const
  {
    return !(u + parameters_.initial > 0.) ? open : load(u, v) > 0. ? loaded : released;
  }

  Parameters parameters_;
};

/// Belt or chain. Signals: the pull of its strands, and the force on either shaft, the sum of both as vectors.
class Belt : public CommonTangents
{
public:
  explicit Belt(const Parameters &parameters) : CommonTangents("belt", parameters) {}

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  std::string event(bool loading) const final { return loading ? "taut" : "slack"; }
};

/**
 * Teeth of two gears with the base helix angle beta_b; both flanks of a tooth may be loaded. Signals: F = F_L - F_R
 * normal to the teeth and its parts, at the pitch point of the current distance, with the current pressure angle
 * alpha_t:
 *
 *     F_t = F cos(beta_b) cos(alpha_t),     F_r = (F_L + F_R) cos(beta_b) sin(alpha_t),     F_a = F sin(beta_b)
 */
class GearPair : public CommonTangents
{
public:
  /// @param helix  beta_b [rad], positive: F_a acts on the second gear along the axis while F > 0
  GearPair(const Parameters &parameters, double helix) : CommonTangents("gear pair", parameters), helix_(helix) {}

  Play                  play(const double *u, const double *v, double *G) const override;
  double                yielding(double force) const override { return force / parameters().stiffness; }
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  std::string event(bool loading) const final { return loading ? "contact" : "separation"; }

  double helix_;
};

} // namespace gestell::mechanism
