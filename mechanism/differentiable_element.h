#pragma once

#include "mechanism/branches.h"
#include "mechanism/commands.h"
#include "mechanism/force_law.h"
#include "mechanism/structure.h"

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <type_traits>

namespace gestell::mechanism
{

/// LocalMotion in plain or dual numbers, as the argument of a law.
template <typename Number>
struct Measures
{
  double        t;
  const Number *u, *v, *a;
  bool          by_history;       ///< as in LocalMotion
  const double *lambda = nullptr; ///< as in LocalMotion; constant within a tangent
};

/**
 * A ForceLaw written once for any number type; dual numbers give its tangent. `Facets` of the element:
 * Branches, Structure, Commands.
 *
 * `Law` (the derived class) provides
 *
 *     template <typename Number>
 *     void law(const Measures<Number> &measures, const double *history, Number *p) const;
 *
 * with k measures.  Each measure carries one dual direction in which u, v and a move together as (w.u, w.v, w.a): the
 * tangent  w.u dp/du + w.v dp/dv + w.a dp/da  costs k directions, not 3 k; dp/du and dp/dv separately cost 2 k.
 */
template <class Law, int k, class... Facets>
class DifferentiableElement : public ForceLaw, public Facets...
{
public:
  template <int n_directions>
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, n_directions, 1>>;

  int n_measures() const final { return k; }

  const Branches  *branches() const override { return own<Branches>(); }
  const Structure *structure() const override { return own<Structure>(); }
  const Commands  *commands() const override { return own<Commands>(); }

  void force(const LocalMotion &motion, const double *history, double *p) const final
  {
    law(Measures<double>{motion.t, motion.u, motion.v, motion.a, motion.by_history, motion.lambda}, history, p);
  }

  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const final
  {
    using Direction = Eigen::Matrix<double, k, 1>;
    Dual<k> u[k], v[k], a[k], p_dual[k];
    for (int i = 0; i < k; ++i)
    {
      u[i] = Dual<k>(motion.u[i], w.u * Direction::Unit(i));
      v[i] = Dual<k>(motion.v[i], w.v * Direction::Unit(i));
      a[i] = Dual<k>(motion.a[i], w.a * Direction::Unit(i));
    }
    law(Measures<Dual<k>>{motion.t, u, v, a, motion.by_history, motion.lambda}, history, p_dual);
    for (int i = 0; i < k; ++i)
    {
      p[i] = p_dual[i].value();
      for (int j = 0; j < k; ++j)
        dp[i + k * j] = p_dual[i].derivatives()[j];
    }
  }

  void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                   double *dp_dv) const final
  {
    using Direction = Eigen::Matrix<double, 2 * k, 1>;
    Dual<2 * k> u[k], v[k], a[k], p_dual[k];
    for (int i = 0; i < k; ++i)
    {
      u[i] = Dual<2 * k>(motion.u[i], Direction::Unit(i));
      v[i] = Dual<2 * k>(motion.v[i], Direction::Unit(k + i));
      a[i] = Dual<2 * k>(motion.a[i]);
    }
    law(Measures<Dual<2 * k>>{motion.t, u, v, a, motion.by_history, motion.lambda}, history, p_dual);
    for (int i = 0; i < k; ++i)
    {
      p[i] = p_dual[i].value();
      for (int j = 0; j < k; ++j)
      {
        dp_du[i + k * j] = p_dual[i].derivatives()[j];
        dp_dv[i + k * j] = p_dual[i].derivatives()[k + j];
      }
    }
  }

private:
  template <class Facet>
  const Facet *own() const
  {
    if constexpr ((std::is_base_of_v<Facet, Facets> || ...))
      return this;
    else
      return nullptr;
  }

  template <typename Number>
  void law(const Measures<Number> &measures, const double *history, Number *p) const
  {
    static_cast<const Law &>(*this).template law<Number>(measures, history, p);
  }
};

/// Value of a plain or dual number, for decisions.
inline double value(double x)
{
  return x;
}
template <typename Derivatives>
double value(const Eigen::AutoDiffScalar<Derivatives> &x)
{
  return x.value();
}

} // namespace gestell::mechanism
