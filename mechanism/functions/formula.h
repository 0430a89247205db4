#pragma once

#include "mechanism/functions/elementary_functions.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/// Relation of the argument of a condition to zero.
enum class Relation
{
  above,     ///< > 0
  not_below, ///< >= 0
  below,     ///< < 0
  not_above  ///< <= 0
};

/**
 * A scalar function f(x_0, x_1, ...), given at run time: a flat program for a stack machine.
 *
 * Formulas are combined from formulas, starting with constants and variables; constants are folded:
 *
 *     const Formula t = Formula::variable(0), u = Formula::variable(1);
 *     const Formula F = -900. * u - 5e6 * power(u, 3.) + 10. * applied(Function::sin, 18.8 * t);
 *     const double  x[] = {0.1, 2e-3}, value = F.value(x);
 *
 * value() accepts any number type: plain numbers, dual numbers for exact derivatives, duals of duals for second
 * derivatives. It does not allocate.  A formula has no units; they are the caller's responsibility.
 *
 * Kinks.  abs, sign, step, min, max and conditional are smooth on both sides of a kink, where their argument is zero: x
 * itself, a - b for min(a, b) and max(a, b), the argument of a condition.  With `sides` (n_kinks() numbers, > 0: the
 * side of positive arguments) value() evaluates each kink on that side, smoothly continued beyond it, so that a solver
 * can locate kinks one by one; without `sides` the arguments decide.  Square roots and non-integer powers c are then
 * continued below zero as -|x|^c, for example max(u, 0)^1.5 beyond its kink; without `sides` they are nan there.  Only
 * the selected branch of a conditional is evaluated, and the kinks of the other branch are inactive.
 */
class Formula
{
public:
  Formula(double constant = 0.);  ///< implicit: numbers are formulas
  static Formula variable(int i); ///< x_i, 0 <= i < max_variables

  bool   is_constant() const { return code_.size() == 1 && code_[0].op == Op::constant; }
  double constant() const { return code_[0].number; } ///< of a formula with is_constant()
  int    n_variables() const;                         ///< one more than the highest variable it depends on

  /// f(x); x [n_variables()].
  template <typename Number>
  Number value(const Number *x, const double *sides = nullptr) const
  {
    return run<Number>(x, sides, nullptr);
  }

  struct Derivatives
  {
    double value, first, second;
  };
  /// f, df/ds and d^2f/ds^2 at x + s d, s = 0: for a function of time with d = (1) its value, rate and acceleration.
  Derivatives along(const double *x, const double *d, const double *sides = nullptr) const;

  int                             n_kinks() const { return static_cast<int>(kinks_.size()); }
  const std::vector<std::string> &kinks() const { return kinks_; } ///< their functions: "abs", "if" ...
  /// Arguments [n_kinks()] of the active kinks; those of inactive ones are unchanged.
  template <typename Number>
  void kink_arguments(const Number *x, const double *sides, Number *arguments) const
  {
    run<Number>(x, sides, arguments);
  }

  Formula        operator-() const;
  friend Formula operator+(const Formula &a, const Formula &b);
  friend Formula operator-(const Formula &a, const Formula &b);
  friend Formula operator*(const Formula &a, const Formula &b);
  friend Formula operator/(const Formula &a, const Formula &b);
  /// a^b; for variable b, exp(b log a) with a > 0.
  friend Formula power(const Formula &a, const Formula &b);
  friend Formula applied(Function f, const Formula &a);
  friend Formula atan2(const Formula &y, const Formula &x);
  friend Formula abs(const Formula &a);
  friend Formula sign(const Formula &a); ///< -1 or 1; 0 at 0 if no side is given
  friend Formula step(const Formula &a); ///< 0 for a < 0, else 1
  friend Formula min(const Formula &a, const Formula &b);
  friend Formula max(const Formula &a, const Formula &b);
  /// `then` if `argument` is in `relation` to zero, else `otherwise`.
  friend Formula conditional(const Formula &argument, Relation relation, const Formula &then, const Formula &otherwise);

  static constexpr int max_variables = 16;
  static constexpr int max_depth     = 64; ///< numbers on the stack
  static constexpr int max_kinks     = 64;

private:
  enum class Op
  {
    constant,
    variable,
    add,
    subtract,
    multiply,
    divide,
    negate,
    offset,
    scale,
    integer_power,
    root, ///< any power that is not an integer
    function,
    angle,
    abs,
    sign,
    step,
    min,
    max,
    branch,
    jump
  };
  struct Instruction
  {
    Op       op;
    int      index    = 0;  ///< variable, function, exponent, kink
    double   number   = 0.; ///< constant, factor, exponent
    int      distance = 0;  ///< instructions to skip
    Relation relation = Relation::above;
  };

  template <typename Number>
  Number run(const Number *x, const double *sides, Number *arguments) const;

  void    append(const Formula &other);
  Formula followed_by(Instruction instruction) const;
  Formula with_kink(Op op, const std::string &function) const;
  Formula folded() const; ///< a constant if it contains no variable

  static Formula joined(const Formula &a, const Formula &b); ///< both on the stack

  std::vector<Instruction> code_;
  std::vector<std::string> kinks_;
  int                      depth_ = 1;
};

namespace formula
{

template <typename Number>
double plain(const Number &x)
{
  return plain(x.value());
}
template <>
inline double plain(const double &x)
{
  return x;
}

inline bool satisfies(double x, Relation relation)
{
  return relation == Relation::above       ? x > 0.
         : relation == Relation::not_below ? x >= 0.
         : relation == Relation::below     ? x < 0.
                                           : x <= 0.;
}

} // namespace formula

template <typename Number>
Number Formula::run(const Number *x, const double *sides, Number *arguments) const
{
  Number stack[max_depth];
  int    top = -1;
  // Stores the argument of a kink and returns the value for decisions: that of the history if there is one.
  const auto side = [&](int kink, const Number &argument)
  {
    if (arguments)
      arguments[kink] = argument;
    return sides ? sides[kink] : formula::plain(argument);
  };
  for (std::size_t i = 0; i < code_.size(); ++i)
  {
    const Instruction &now = code_[i];
    switch (now.op)
    {
    case Op::constant:
      stack[++top] = Number(now.number);
      break;
    case Op::variable:
      stack[++top] = x[now.index];
      break;
    case Op::add:
      --top;
      stack[top] = Number(stack[top] + stack[top + 1]);
      break;
    case Op::subtract:
      --top;
      stack[top] = Number(stack[top] - stack[top + 1]);
      break;
    case Op::multiply:
      --top;
      stack[top] = Number(stack[top] * stack[top + 1]);
      break;
    case Op::divide:
      --top;
      stack[top] = Number(stack[top] / stack[top + 1]);
      break;
    case Op::negate:
      stack[top] = Number(-stack[top]);
      break;
    case Op::offset:
      stack[top] = Number(stack[top] + Number(now.number));
      break;
    case Op::scale:
      stack[top] = scaled(stack[top], now.number);
      break;
    case Op::integer_power:
      stack[top] = integer_power(stack[top], now.index);
      break;
    case Op::root:
    {
      const bool beyond = sides && formula::plain(stack[top]) < 0.;
      if (beyond)
        stack[top] = Number(-stack[top]);
      stack[top] = real_power(stack[top], now.number);
      if (beyond)
        stack[top] = Number(-stack[top]);
      break;
    }
    case Op::function:
      stack[top] = evaluated(static_cast<Function>(now.index), stack[top]);
      break;
    case Op::angle:
      --top;
      stack[top] = angle(stack[top], stack[top + 1]);
      break;
    case Op::abs:
      if (side(now.index, stack[top]) < 0.)
        stack[top] = Number(-stack[top]);
      break;
    case Op::sign:
    {
      const double s = side(now.index, stack[top]);
      stack[top]     = Number(s > 0. ? 1. : s < 0. ? -1. : s);
      break;
    }
    case Op::step:
    {
      const double s = side(now.index, stack[top]);
      stack[top]     = Number(s >= 0. ? 1. : s < 0. ? 0. : s);
      break;
    }
    case Op::min:
    case Op::max:
    {
      --top;
      const double s = side(now.index, Number(stack[top] - stack[top + 1]));
      if (std::isnan(s))
        return Number(s);
      if ((s > 0.) == (now.op == Op::min))
        stack[top] = stack[top + 1];
      break;
    }
    case Op::branch:
    {
      const double s = side(now.index, stack[top--]);
      if (std::isnan(s))
        return Number(s);
      if (!formula::satisfies(s, now.relation))
        i += static_cast<std::size_t>(now.distance);
      break;
    }
    case Op::jump:
      i += static_cast<std::size_t>(now.distance);
      break;
    }
  }
  return stack[0];
}

} // namespace gestell::mechanism
