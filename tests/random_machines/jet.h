#pragma once

#include <array>
#include <cmath>

namespace gestell::tests
{

/// A function of coordinates along a motion q(tau), t + tau: value, first and second derivative by tau while q'' = 0,
/// and gradient by q.
struct Jet
{
  static constexpr int most = 10; ///< coordinates of a machine

  double                   v = 0., d = 0., dd = 0.;
  std::array<double, most> g{};

  Jet() = default;
  Jet(double value) : v(value) {}
};

/// f(x) with its derivatives at x.v
inline Jet composed(const Jet &x, double f, double df, double ddf)
{
  Jet y;
  y.v  = f;
  y.d  = df * x.d;
  y.dd = ddf * x.d * x.d + df * x.dd;
  for (int i = 0; i < Jet::most; ++i)
    y.g[i] = df * x.g[i];
  return y;
}

inline Jet operator*(double a, const Jet &x)
{
  return composed(x, a * x.v, a, 0.);
}
inline Jet operator-(const Jet &x)
{
  return -1. * x;
}
inline Jet operator+(Jet a, const Jet &b)
{
  a.v += b.v;
  a.d += b.d;
  a.dd += b.dd;
  for (int i = 0; i < Jet::most; ++i)
    a.g[i] += b.g[i];
  return a;
}
inline Jet operator-(const Jet &a, const Jet &b)
{
  return a + -1. * b;
}
inline Jet operator*(const Jet &a, const Jet &b)
{
  Jet y;
  y.v  = a.v * b.v;
  y.d  = a.d * b.v + a.v * b.d;
  y.dd = a.dd * b.v + 2. * a.d * b.d + a.v * b.dd;
  for (int i = 0; i < Jet::most; ++i)
    y.g[i] = a.g[i] * b.v + a.v * b.g[i];
  return y;
}
inline Jet sin(const Jet &x)
{
  return composed(x, std::sin(x.v), std::cos(x.v), -std::sin(x.v));
}
inline Jet cos(const Jet &x)
{
  return composed(x, std::cos(x.v), -std::sin(x.v), -std::cos(x.v));
}
inline Jet sqrt(const Jet &x)
{
  const double root = std::sqrt(x.v);
  return composed(x, root, 0.5 / root, -0.25 / (root * x.v));
}

} // namespace gestell::tests
