#pragma once

#include "tests/support/cubic_system.h"

#include <cmath>

namespace gestell::tests
{

/// One element of two measures, p = (sin u_0 - u_0' u_1 - m u_1'', u_0 u_1 + 0.3 u_1'^2), on a base with a damped free
/// motion, an undamped one and a spring.
class CoupledSystem final : public CubicSystem
{
public:
  /// @param m      mass that the element couples
  /// @param third  share of the coordinate on the spring in u_0
  explicit CoupledSystem(double m = 0., double third = 0.)
      : CubicSystem(Eigen::Vector3d(1., 2., 3.).asDiagonal(), Eigen::Vector3d(0.4, 0., 0.2).asDiagonal(),
                    Eigen::Vector3d(0., 0., 5.).asDiagonal(),
                    {{0., Eigen::Vector3d(1., 0.5, third)}, {0., Eigen::Vector3d(0., -1., 1.)}}),
        m_(m)
  {
    loads().add_constant(0, 0.3);
  }

  std::vector<coupling::ForceBlock> blocks() const override { return {{0, 2}}; }
  void                              force(const coupling::LocalState &x, Vector &p) const override
  {
    p[0] = std::sin(x.u[0]) - x.v[0] * x.u[1];
    if (m_ != 0.)
      p[0] -= m_ * x.a[1];
    p[1] = x.u[0] * x.u[1] + 0.3 * x.v[1] * x.v[1];
  }
  void derivatives(const coupling::LocalState &x, Vector &p, Matrix &u, Matrix &v) const override
  {
    force(x, p);
    u << std::cos(x.u[0]), -x.v[0], x.u[1], x.u[0];
    v << -x.u[1], 0., 0., 0.6 * x.v[1];
  }
  void tangent(const coupling::LocalState &x, double w_u, double w_v, double w_a, Vector &p, Matrix &dp) const override
  {
    Matrix u(2, 2), v(2, 2);
    derivatives(x, p, u, v);
    dp = w_u * u + w_v * v;
    dp(0, 1) -= m_ * w_a;
  }

private:
  double m_;
};

} // namespace gestell::tests
