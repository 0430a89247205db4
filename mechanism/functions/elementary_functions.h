#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <cmath>

namespace gestell::mechanism
{

/// Smooth functions of one variable: log for x > 0, tan between its poles.
enum class Function
{
  sin,
  cos,
  tan,
  exp,
  log,
  tanh,
  atan
};

// Each function is written for plain numbers and for dual numbers whose parts may themselves be of any such type;
// therefore duals of duals, of any depth, also work.  Eigen's own functions lack atan and, nested, do not all compile.

inline double scaled(double x, double factor)
{
  return x * factor;
}

inline double evaluated(Function f, double x)
{
  switch (f)
  {
  case Function::sin:
    return std::sin(x);
  case Function::cos:
    return std::cos(x);
  case Function::tan:
    return std::tan(x);
  case Function::exp:
    return std::exp(x);
  case Function::log:
    return std::log(x);
  case Function::tanh:
    return std::tanh(x);
  case Function::atan:
    return std::atan(x);
  }
  return x;
}

/// x^n.
inline double integer_power(double x, int n)
{
  if (n < 0)
    return 1. / integer_power(x, -n);
  double power = 1.;
  for (double square = x; n > 0; n /= 2, square *= square)
    if (n % 2 == 1)
      power *= square;
  return power;
}

/// x^c, smooth for x > 0.
inline double real_power(double x, double c)
{
  return c == 0.5 ? std::sqrt(x) : std::pow(x, c);
}

inline double angle(double y, double x)
{
  return std::atan2(y, x);
}

template <typename Number>
struct ValueAndSlope
{
  Number value, slope;
};

template <typename Number>
ValueAndSlope<Number> value_and_slope(Function f, const Number &x)
{
  const Number y = evaluated(f, x);
  switch (f)
  {
  case Function::sin:
    return {y, evaluated(Function::cos, x)};
  case Function::cos:
    return {y, Number(-evaluated(Function::sin, x))};
  case Function::tan:
    return {y, Number(Number(1.) + y * y)};
  case Function::exp:
    return {y, y};
  case Function::log:
    return {y, Number(Number(1.) / x)};
  case Function::tanh:
    return {y, Number(Number(1.) - y * y)};
  case Function::atan:
    return {y, Number(Number(1.) / (Number(1.) + x * x))};
  }
  return {y, y};
}

inline bool is_finite(double x)
{
  return std::isfinite(x);
}
template <typename Derivatives>
bool is_finite(const Eigen::AutoDiffScalar<Derivatives> &x)
{
  return is_finite(x.value());
}

inline bool is_constant_zero(double x)
{
  return x == 0.;
}
template <typename Derivatives>
bool is_constant_zero(const Eigen::AutoDiffScalar<Derivatives> &x)
{
  bool zero = is_constant_zero(x.value());
  for (Eigen::Index i = 0; zero && i < x.derivatives().size(); ++i)
    zero = is_constant_zero(x.derivatives()[i]);
  return zero;
}

/// f(x) of a dual number, from f and f' at its value.  If x is constant, so is f, even if f' is infinite.
template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> by_chain_rule(const typename Derivatives::Scalar       &value,
                                                 const typename Derivatives::Scalar       &slope,
                                                 const Eigen::AutoDiffScalar<Derivatives> &x)
{
  Derivatives derivatives = x.derivatives() * slope;
  if (!is_finite(slope))
    for (Eigen::Index i = 0; i < derivatives.size(); ++i)
      if (is_constant_zero(x.derivatives()[i]))
        derivatives[i] = 0.;
  return Eigen::AutoDiffScalar<Derivatives>(value, derivatives);
}

template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> scaled(const Eigen::AutoDiffScalar<Derivatives> &x, double factor)
{
  return by_chain_rule(scaled(x.value(), factor), typename Derivatives::Scalar(factor), x);
}

template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> evaluated(Function f, const Eigen::AutoDiffScalar<Derivatives> &x)
{
  const auto [value, slope] = value_and_slope<typename Derivatives::Scalar>(f, x.value());
  return by_chain_rule(value, slope, x);
}

template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> integer_power(const Eigen::AutoDiffScalar<Derivatives> &x, int n)
{
  using Inner       = typename Derivatives::Scalar;
  const Inner lower = integer_power(x.value(), n - 1);
  return by_chain_rule<Derivatives>(Inner(lower * x.value()), scaled(lower, n), x);
}

template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> real_power(const Eigen::AutoDiffScalar<Derivatives> &x, double c)
{
  return by_chain_rule(real_power(x.value(), c), scaled(real_power(x.value(), c - 1.), c), x);
}

/// atan2(y, x); its jump of 2 pi at y = 0, x < 0 is not a kink of a formula.
template <typename Derivatives>
Eigen::AutoDiffScalar<Derivatives> angle(const Eigen::AutoDiffScalar<Derivatives> &y,
                                         const Eigen::AutoDiffScalar<Derivatives> &x)
{
  using Inner      = typename Derivatives::Scalar;
  const Inner r2   = Inner(x.value() * x.value() + y.value() * y.value());
  const Inner of_y = Inner(x.value() / r2), of_x = Inner(-y.value() / r2);
  return Eigen::AutoDiffScalar<Derivatives>(angle(y.value(), x.value()),
                                            Derivatives(y.derivatives() * of_y + x.derivatives() * of_x));
}

} // namespace gestell::mechanism
