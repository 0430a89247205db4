#include "mechanism/measures/relative_measure.h"

#include <cmath>
#include <tuple>

namespace gestell::mechanism
{

namespace
{

using MovedVector = Placement::MovedVector;
using Gradient    = Eigen::Map<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

/// gradient += w . J of a vector on the body.  J of a free body consists of multiples of E, many of them zero.
void add_turn(const Placement &body, const Vector3d &w, const MovedVector &a, Gradient &gradient)
{
  const bool free = gradient.size() > 0 && !body.turns() && !body.is_linear(0);
  for (Eigen::Index i = 0; free && i < gradient.size(); i += 3)
    if (const double c = a.J(0, i); c != 0.)
      for (int d = 0; d < 3; ++d)
        gradient[i + d] += c * w[d];
  for (Eigen::Index i = 0; !free && i < gradient.size(); ++i)
    gradient[i] += w.dot(a.J.col(i));
}

} // namespace

/// Motion of both places, and the gradients with respect to their measures.
struct RelativeMeasure::Pair
{
  Pair(const Places &places, const double *u, const double *v, double *gradient, Eigen::Index stride)
      : first(places.first), second(places.second), x_1(places.x_1), x_2(places.x_2), u_1(u),
        u_2(u + first.n_measures()), v_1(v), v_2(v ? v + first.n_measures() : nullptr),
        of_1(gradient, first.n_measures(), Eigen::InnerStride<>(stride)),
        of_2(gradient + stride * first.n_measures(), second.n_measures(), Eigen::InnerStride<>(stride)),
        d(x_2.value - x_1.value)
  {
    of_1.setZero();
    of_2.setZero();
    if (v)
    {
      d_rate = x_2.rate - x_1.rate;
      d_bias = x_2.bias - x_1.bias;
    }
  }

  /// of_1 -= w . J_1, of_2 += w . J_2: gradient of w . (x_2 - x_1) at constant w.
  void add_difference(const Vector3d &w)
  {
    turn_1(-w, x_1);
    turn_2(w, x_2);
  }
  void turn_1(const Vector3d &w, const MovedVector &a) { add_turn(first, w, a, of_1); }
  void turn_2(const Vector3d &w, const MovedVector &a) { add_turn(second, w, a, of_2); }
  void direction_1(const Vector3d &e, MovedVector &moved) const { first.direction(e, u_1, v_1, moved); }
  void direction_2(const Vector3d &e, MovedVector &moved) const { second.direction(e, u_2, v_2, moved); }

  const Placement   &first, &second;
  const MovedVector &x_1, &x_2;
  const double      *u_1, *u_2, *v_1, *v_2; ///< v: null if rates are not needed
  Gradient           of_1, of_2;
  Vector3d           d, d_rate = Vector3d::Zero(), d_bias = Vector3d::Zero();
};

RelativeMeasure::Value RelativeMeasure::evaluate(const Places &places, const double *u, const double *v,
                                                 double *gradient, Eigen::Index stride) const
{
  Pair pair(places, u, v, gradient, stride);
  switch (form)
  {
  case Form::along:
    return along(pair);
  case Form::square:
    return square(pair);
  case Form::distance:
    return distance(pair);
  case Form::inclination:
    return inclination(pair);
  case Form::angle:
    return angle(pair);
  case Form::spin:
    return spin(pair);
  case Form::gear:
  case Form::strand:
  case Form::ratio:
    break;
  }
  return ratio(pair);
}

RelativeMeasure::Value RelativeMeasure::along(Pair &pair) const
{
  const auto &[d, d_rate, d_bias] = std::tie(pair.d, pair.d_rate, pair.d_bias);
  if (carrier == Carrier::space)
  {
    pair.add_difference(a);
    return {a.dot(d), a.dot(d_rate), a.dot(d_bias)};
  }
  const bool  on_first = carrier == Carrier::first;
  MovedVector e;
  on_first ? pair.direction_1(a, e) : pair.direction_2(a, e);
  pair.add_difference(e.value);
  on_first ? pair.turn_1(d, e) : pair.turn_2(d, e);
  if (!pair.v_1)
    return {e.value.dot(d), 0., 0.};
  return {e.value.dot(d), e.value.dot(d_rate) + e.rate.dot(d),
          e.value.dot(d_bias) + 2. * e.rate.dot(d_rate) + e.bias.dot(d)};
}

RelativeMeasure::Value RelativeMeasure::square(Pair &pair) const
{
  MovedVector e, f;
  pair.direction_1(a, e);
  pair.direction_2(b, f);
  pair.turn_1(f.value, e);
  pair.turn_2(e.value, f);
  if (!pair.v_1)
    return {e.value.dot(f.value), 0., 0.};
  return {e.value.dot(f.value), e.rate.dot(f.value) + e.value.dot(f.rate),
          e.bias.dot(f.value) + 2. * e.rate.dot(f.rate) + e.value.dot(f.bias)};
}

RelativeMeasure::Value RelativeMeasure::distance(Pair &pair) const
{
  const double   length = pair.d.norm();
  const Vector3d e      = length > 0. ? Vector3d(pair.d / length) : Vector3d::UnitX();
  const double   rate   = e.dot(pair.d_rate);
  pair.add_difference(e);
  return {length, rate, e.dot(pair.d_bias) + (length > 0. ? (pair.d_rate.squaredNorm() - rate * rate) / length : 0.)};
}

RelativeMeasure::Value RelativeMeasure::inclination(Pair &pair) const
{
  const double x = a.dot(pair.d), y = b.dot(pair.d), r2 = x * x + y * y;
  if (!(r2 > 0.))
    return {0., 0., 0.};
  const Vector3d w    = (x * b - y * a) / r2;
  const double   rate = w.dot(pair.d_rate), stretch = (x * a.dot(pair.d_rate) + y * b.dot(pair.d_rate)) / r2;
  pair.add_difference(w);
  return {std::atan2(y, x), rate, w.dot(pair.d_bias) - 2. * stretch * rate};
}

/// Uses both directions of each body, so that the angle of a tilted body does not depend on the choice of a about the
/// axis.
RelativeMeasure::Value RelativeMeasure::angle(Pair &pair) const
{
  MovedVector e, f, m, n;
  pair.direction_1(a, e);
  pair.direction_1(b, f);
  pair.direction_2(a, m);
  pair.direction_2(b, n);
  const double x = e.value.dot(m.value) + f.value.dot(n.value), y = f.value.dot(m.value) - e.value.dot(n.value),
               r2 = x * x + y * y;
  if (!(r2 > 0.)) // body 2 is upside down: it has no angle about this axis
    return {0., 0., 0.};
  pair.turn_2(Vector3d((x * f.value - y * e.value) / r2), m);
  pair.turn_2(Vector3d((-x * e.value - y * f.value) / r2), n);
  pair.turn_1(Vector3d((x * m.value - y * n.value) / r2), f);
  pair.turn_1(Vector3d((-x * n.value - y * m.value) / r2), e);
  if (!pair.v_1)
    return {std::atan2(y, x), 0., 0.};
  const auto rate_of = [](const MovedVector &c, const MovedVector &d)
  { return c.rate.dot(d.value) + c.value.dot(d.rate); };
  const auto bias_of = [](const MovedVector &c, const MovedVector &d)
  { return c.bias.dot(d.value) + 2. * c.rate.dot(d.rate) + c.value.dot(d.bias); };
  const double x_rate = rate_of(e, m) + rate_of(f, n), y_rate = rate_of(f, m) - rate_of(e, n),
               x_bias = bias_of(e, m) + bias_of(f, n), y_bias = bias_of(f, m) - bias_of(e, n),
               rate = (x * y_rate - y * x_rate) / r2;
  return {std::atan2(y, x), rate, (x * y_bias - y * x_bias) / r2 - 2. * (x * x_rate + y * y_rate) / r2 * rate};
}

RelativeMeasure::Value RelativeMeasure::spin(Pair &pair) const
{
  Value sum{0., 0., 0.};
  for (int i = 0; i < 3; ++i)
    for (const bool of_second : {false, true})
    {
      MovedVector e;
      of_second ? pair.direction_2(Vector3d::Unit(i), e) : pair.direction_1(Vector3d::Unit(i), e);
      const Vector3d w = (of_second ? 0.5 : -0.5) * a.cross(e.value);
      of_second ? pair.turn_2(w, e) : pair.turn_1(w, e);
      sum.rate += w.dot(e.rate);
      sum.bias += w.dot(e.bias);
    }
  return sum;
}

/// For `ratio`, `gear` and `strand`.
RelativeMeasure::Value RelativeMeasure::ratio(Pair &pair) const
{
  const Eigen::Index k_1 = pair.of_1.size(), k_2 = pair.of_2.size();
  double             s = 0., rate = 0.;
  for (Eigen::Index i = 0; i < k_1 + k_2; ++i)
  {
    const double c                                = ratios[std::size_t(i)];
    (i < k_1 ? pair.of_1[i] : pair.of_2[i - k_1]) = c;
    s += c * pair.u_1[i];
    rate += pair.v_1 ? c * pair.v_1[i] : 0.;
  }
  if (form == Form::ratio)
    return {s, rate, 0.};
  Vector3d    of_d;
  const Value centres = mesh(pair.d, pair.d_rate, pair.d_bias, s, of_d);
  pair.add_difference(of_d);
  return {s + centres.s, rate + centres.rate, centres.bias};
}

/// Meshing wheels have rotated with the line of centres up to a small difference: the nearest psi + 2 pi n is used.
RelativeMeasure::Value RelativeMeasure::mesh(const Vector3d &d, const Vector3d &d_rate, const Vector3d &d_bias,
                                             double wound, Vector3d &of_d) const
{
  const double x = a.dot(d), y = b.dot(d), r2 = x * x + y * y, r = std::sqrt(r2);
  of_d.setZero();
  if (!(r2 > 0.))
    return {0., 0., 0.};
  const double   psi    = std::atan2(y, x);
  const double   turns  = form == Form::gear ? std::round((wound / reach - psi) / (2. * M_PI)) : 0.;
  const Vector3d across = (x * b - y * a) / r2, radial = (x * a + y * b) / r;
  const double   psi_rate = across.dot(d_rate), r_rate = radial.dot(d_rate);
  of_d = -reach * across;
  Value        sum{-reach * (psi + 2. * M_PI * turns), -reach * psi_rate,
            -reach * (across.dot(d_bias) - 2. * psi_rate * r_rate / r)};
  const double circles = flank == 0. ? r : std::abs(reach / flank);
  if (r <= circles) // no common tangent of the circles: none of its force is radial
    return sum;
  const auto h = [=](double D) { return std::sqrt((D - circles) * (D + circles)) - circles * std::acos(circles / D); };
  const double slope = std::sqrt((1. - circles / r) * (1. + circles / r));
  of_d += flank * slope * radial;
  sum.s += flank * (h(r) - h(distance_0));
  sum.rate += flank * slope * r_rate;
  sum.bias += flank * (slope * (radial.dot(d_bias) + r * psi_rate * psi_rate) +
                       circles * circles / (r * r2 * slope) * r_rate * r_rate);
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
  if (measure.form != RelativeMeasure::Form::ratio) // a ratio needs no positions
  {
    first.position(u, v, x_1);
    second.position(u + first.n_measures(), v ? v + first.n_measures() : nullptr, x_2);
  }
  else
    x_1.value = x_1.rate = x_1.bias = x_2.value = x_2.rate = x_2.bias = Vector3d::Zero();
  return measure.evaluate({first, second, x_1, x_2}, u, v, gradient);
}

void PlacedMeasure::add_curvature(const double *u, double factor, double *matrix) const
{
  double     gradient[max_measures];
  const auto bias = [&](const double *v) { return evaluate(u, v, gradient).bias; };
  add_polarised<max_measures>(n_measures(), bias, factor, matrix);
}

} // namespace gestell::mechanism
