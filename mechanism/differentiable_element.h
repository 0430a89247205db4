#pragma once

#include "mechanism/force_element.h"

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <type_traits>

namespace gestell::mechanism
{

/**
 * A ForceElement whose law is written once, for any number type; dual numbers give its tangent.
 *
 * `Law` (the derived class) provides
 *
 *     template <typename Number>
 *     void law(double t, const Number *u, const Number *v, const Number *a, const double *history, Number *p) const;
 *
 * with k measures.  Each measure carries one dual direction in which u, v and a move together as (w.u, w.v, w.a): the
 * tangent  w.u dp/du + w.v dp/dv + w.a dp/da  costs k directions, not 3 k.
 */
template <class Law, int k>
class DifferentiableElement : public ForceElement
{
public:
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, k, 1>>;

  int n_measures() const final { return k; }

  void force(const LocalMotion &motion, const double *history, double *p) const final
  {
    static_cast<const Law &>(*this).template law<double>(motion.t, motion.u, motion.v, motion.a, history, p);
  }

  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const final
  {
    Dual u[k], v[k], a[k], p_dual[k];
    for (int i = 0; i < k; ++i)
    {
      u[i] = Dual(motion.u[i], w.u * Eigen::Matrix<double, k, 1>::Unit(i));
      v[i] = Dual(motion.v[i], w.v * Eigen::Matrix<double, k, 1>::Unit(i));
      a[i] = Dual(motion.a[i], w.a * Eigen::Matrix<double, k, 1>::Unit(i));
    }
    static_cast<const Law &>(*this).template law<Dual>(motion.t, u, v, a, history, p_dual);
    for (int i = 0; i < k; ++i)
    {
      p[i] = p_dual[i].value();
      for (int j = 0; j < k; ++j)
        dp[i + k * j] = p_dual[i].derivatives()[j];
    }
  }
};

/// The number in a plain or dual number, for decisions.
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
