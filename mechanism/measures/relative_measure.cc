#include "mechanism/measures/relative_measure.h"

#include <cmath>

namespace gestell::mechanism
{

namespace
{

using MovedVector = Placement::MovedVector;
using Gradient    = Eigen::Map<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

/// gradient_1 -= w . J_1, gradient_2 += w . J_2: of w . (x_2 - x_1), w held.
void add_difference(const Vector3d &w, const MovedVector &x_1, const MovedVector &x_2, Gradient &of_1, Gradient &of_2)
{
  for (Eigen::Index i = 0; i < of_1.size(); ++i)
    of_1[i] -= w.dot(x_1.J.col(i));
  for (Eigen::Index i = 0; i < of_2.size(); ++i)
    of_2[i] += w.dot(x_2.J.col(i));
}

void add_turn(const Vector3d &w, const MovedVector &a, Gradient &gradient)
{
  for (Eigen::Index i = 0; i < gradient.size(); ++i)
    gradient[i] += w.dot(a.J.col(i));
}

} // namespace

RelativeMeasure::Value RelativeMeasure::evaluate(const Placement &first, const Placement &second,
                                                 const MovedVector &x_1, const MovedVector &x_2, const double *u,
                                                 const double *v, double *gradient, Eigen::Index stride) const
{
  const int     k_1 = first.n_measures(), k_2 = second.n_measures();
  const double *v_2 = v ? v + k_1 : nullptr;
  Gradient      of_1(gradient, k_1, Eigen::InnerStride<>(stride)),
      of_2(gradient + stride * k_1, k_2, Eigen::InnerStride<>(stride));
  of_1.setZero();
  of_2.setZero();
  const Vector3d d      = x_2.value - x_1.value;
  const Vector3d d_rate = v ? Vector3d(x_2.rate - x_1.rate) : Vector3d::Zero();
  const Vector3d d_bias = v ? Vector3d(x_2.bias - x_1.bias) : Vector3d::Zero();
  switch (form)
  {
  case Form::along:
  {
    if (carrier == Carrier::space)
    {
      add_difference(a, x_1, x_2, of_1, of_2);
      return {a.dot(d), a.dot(d_rate), a.dot(d_bias)};
    }
    const bool  on_first = carrier == Carrier::first;
    MovedVector e;
    (on_first ? first : second).direction(a, on_first ? u : u + k_1, on_first ? v : v_2, e);
    add_difference(e.value, x_1, x_2, of_1, of_2);
    add_turn(d, e, on_first ? of_1 : of_2);
    if (!v)
      return {e.value.dot(d), 0., 0.};
    return {e.value.dot(d), e.value.dot(d_rate) + e.rate.dot(d),
            e.value.dot(d_bias) + 2. * e.rate.dot(d_rate) + e.bias.dot(d)};
  }
  case Form::square:
  {
    MovedVector e, f;
    first.direction(a, u, v, e);
    second.direction(b, u + k_1, v_2, f);
    add_turn(f.value, e, of_1);
    add_turn(e.value, f, of_2);
    if (!v)
      return {e.value.dot(f.value), 0., 0.};
    return {e.value.dot(f.value), e.rate.dot(f.value) + e.value.dot(f.rate),
            e.bias.dot(f.value) + 2. * e.rate.dot(f.rate) + e.value.dot(f.bias)};
  }
  case Form::distance:
  {
    const double   length = d.norm();
    const Vector3d e      = length > 0. ? Vector3d(d / length) : Vector3d::UnitX();
    const double   rate   = e.dot(d_rate);
    add_difference(e, x_1, x_2, of_1, of_2);
    return {length, rate, e.dot(d_bias) + (length > 0. ? (d_rate.squaredNorm() - rate * rate) / length : 0.)};
  }
  case Form::inclination:
  {
    const double x = a.dot(d), y = b.dot(d), r2 = x * x + y * y;
    if (!(r2 > 0.))
      return {0., 0., 0.};
    const Vector3d w    = (x * b - y * a) / r2;
    const double   rate = w.dot(d_rate), stretch = (x * a.dot(d_rate) + y * b.dot(d_rate)) / r2;
    add_difference(w, x_1, x_2, of_1, of_2);
    return {std::atan2(y, x), rate, w.dot(d_bias) - 2. * stretch * rate};
  }
  case Form::angle:
  {
    MovedVector e, f, moved;
    first.direction(a, u, v, e);
    first.direction(b, u, v, f);
    second.direction(a, u + k_1, v_2, moved);
    const double x = e.value.dot(moved.value), y = f.value.dot(moved.value), r2 = x * x + y * y;
    if (!(r2 > 0.)) // body 2 has tilted by a right angle: it has no angle about this axis
      return {0., 0., 0.};
    const Vector3d of_moved = (x * f.value - y * e.value) / r2;
    add_turn(of_moved, moved, of_2);
    add_turn(Vector3d(x / r2 * moved.value), f, of_1);
    add_turn(Vector3d(-y / r2 * moved.value), e, of_1);
    if (!v)
      return {std::atan2(y, x), 0., 0.};
    const Vector3d across = (x * f.bias - y * e.bias) / r2;
    const double   x_rate = e.rate.dot(moved.value) + e.value.dot(moved.rate),
                 y_rate = f.rate.dot(moved.value) + f.value.dot(moved.rate), rate = (x * y_rate - y * x_rate) / r2;
    return {std::atan2(y, x), rate,
            of_moved.dot(moved.bias) + across.dot(moved.value) +
                2. * (x * f.rate.dot(moved.rate) - y * e.rate.dot(moved.rate)) / r2 -
                2. * (x * x_rate + y * y_rate) / r2 * rate};
  }
  case Form::spin:
  {
    Value sum{0., 0., 0.};
    for (int i = 0; i < 3; ++i)
      for (const bool of_second : {false, true})
      {
        MovedVector e;
        (of_second ? second : first).direction(Vector3d::Unit(i), of_second ? u + k_1 : u, of_second ? v + k_1 : v, e);
        const Vector3d w = (of_second ? 0.5 : -0.5) * a.cross(e.value);
        add_turn(w, e, of_second ? of_2 : of_1);
        sum.rate += w.dot(e.rate);
        sum.bias += w.dot(e.bias);
      }
    return sum;
  }
  case Form::gear:
  case Form::ratio:
    break;
  }
  double s = 0., rate = 0.;
  for (int i = 0; i < k_1 + k_2; ++i)
  {
    gradient[stride * i] = ratios[i];
    s += ratios[i] * u[i];
    rate += v ? ratios[i] * v[i] : 0.;
  }
  if (form == Form::ratio)
    return {s, rate, 0.};
  Vector3d    of_d;
  const Value centres = mesh(d, d_rate, d_bias, s / reach, of_d);
  add_difference(of_d, x_1, x_2, of_1, of_2);
  return {s + centres.s, rate + centres.rate, centres.bias};
}

/// Wheels that mesh have turned with the line of centres, but for a small rest: of all psi + 2 pi n the nearest counts.
RelativeMeasure::Value RelativeMeasure::mesh(const Vector3d &d, const Vector3d &d_rate, const Vector3d &d_bias,
                                             double turned, Vector3d &of_d) const
{
  const double x = a.dot(d), y = b.dot(d), r2 = x * x + y * y, r = std::sqrt(r2);
  of_d.setZero();
  if (!(r2 > 0.))
    return {0., 0., 0.};
  const double   psi    = std::atan2(y, x);
  const Vector3d across = (x * b - y * a) / r2, radial = (x * a + y * b) / r;
  const double   psi_rate = across.dot(d_rate), r_rate = radial.dot(d_rate);
  of_d = -reach * across;
  Value        sum{-reach * (psi + 2. * M_PI * std::round((turned - psi) / (2. * M_PI))), -reach * psi_rate,
            -reach * (across.dot(d_bias) - 2. * psi_rate * r_rate / r)};
  const double c = std::abs(reach);
  if (flank == 0. || r <= c) // no common tangent of the base circles: none of its force is radial
    return sum;
  const double cosine = c / r, sine = std::sqrt((1. - cosine) * (1. + cosine)), push = flank * sine / c;
  of_d += push * radial;
  sum.s += flank * (sine / cosine - std::acos(cosine) - std::tan(pressure_angle) + pressure_angle);
  sum.rate += push * r_rate;
  sum.bias += push * (radial.dot(d_bias) + r * psi_rate * psi_rate) + flank * cosine / (r2 * sine) * r_rate * r_rate;
  return sum;
}

PlacedMeasure PlacedMeasure::linear()
{
  PlacedMeasure own;
  own.first          = Placement(Vector3d::Zero(), Vector3d::Zero(), {{Vector3d::Zero(), Vector3d::Zero()}});
  own.measure.form   = RelativeMeasure::Form::ratio;
  own.measure.ratios = {1.};
  return own;
}

RelativeMeasure::Value PlacedMeasure::evaluate(const double *u, const double *v, double *gradient) const
{
  MovedVector x_1, x_2;
  if (measure.form != RelativeMeasure::Form::ratio) // which looks at no place
  {
    first.position(u, v, x_1);
    second.position(u + first.n_measures(), v ? v + first.n_measures() : nullptr, x_2);
  }
  else
    x_1.value = x_1.rate = x_1.bias = x_2.value = x_2.rate = x_2.bias = Vector3d::Zero();
  return measure.evaluate(first, second, x_1, x_2, u, v, gradient);
}

void PlacedMeasure::add_curvature(const double *u, double factor, double *matrix) const
{
  double     gradient[max_measures];
  const auto bias = [&](const double *v) { return evaluate(u, v, gradient).bias; };
  add_polarised<max_measures>(n_measures(), bias, factor, matrix);
}

} // namespace gestell::mechanism
