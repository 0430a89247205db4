#include "mechanism/functions/formula.h"

#include "mechanism/require.h"

#include <algorithm>

namespace gestell::mechanism
{
Formula::Formula(double constant)
{
  code_.push_back({Op::constant, 0, constant});
}

Formula Formula::variable(int i)
{
  require(i >= 0 && i < max_variables, "formula", "variable", i, "from 0 to " + std::to_string(max_variables - 1));
  Formula f;
  f.code_[0] = {Op::variable, i};
  return f;
}

int Formula::n_variables() const
{
  int n = 0;
  for (const Instruction &now : code_)
    if (now.op == Op::variable)
      n = std::max(n, now.index + 1);
  return n;
}

Formula::Derivatives Formula::along(const double *x, const double *d, const double *sides) const
{
  using Dual                         = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
  using Dual2                        = Eigen::AutoDiffScalar<Eigen::Matrix<Dual, 1, 1>>;
  const int                        n = n_variables();
  std::array<Dual2, max_variables> moving;
  for (int i = 0; i < n; ++i)
  {
    using Inner = Eigen::Matrix<double, 1, 1>;
    using Outer = Eigen::Matrix<Dual, 1, 1>;
    moving[i]   = Dual2(Dual(x[i], Inner(d[i])), Outer(Dual(d[i])));
  }
  const Dual2 f = value(moving.data(), sides);
  return {f.value().value(), f.value().derivatives()[0], f.derivatives()[0].derivatives()[0]};
}

// --- programs of programs

/// Appends the program of the other formula; its kinks follow those of this one.
void Formula::append(const Formula &other)
{
  const int first = n_kinks();
  for (Instruction now : other.code_)
  {
    if (now.op >= Op::abs && now.op <= Op::branch)
      now.index += first;
    code_.push_back(now);
  }
  kinks_.insert(kinks_.end(), other.kinks_.begin(), other.kinks_.end());
}

Formula Formula::followed_by(Instruction instruction) const
{
  Formula f = *this;
  f.code_.push_back(instruction);
  return f.folded();
}

Formula Formula::with_kink(Op op, const std::string &function) const
{
  Formula f = *this;
  f.code_.push_back({op, n_kinks()});
  f.kinks_.push_back(function);
  return f.folded();
}

Formula Formula::folded() const
{
  require(depth_ <= max_depth, "formula", "intermediate results at once", depth_,
          std::to_string(max_depth) + " or fewer; reduce the nesting of parentheses");
  require(n_kinks() <= max_kinks, "formula", "number of abs, min, max, sign, step and if", n_kinks(),
          std::to_string(max_kinks) + " or fewer; use a table");
  return n_variables() > 0 ? *this : Formula(value<double>(nullptr));
}

Formula Formula::joined(const Formula &a, const Formula &b)
{
  Formula f = a;
  f.append(b);
  f.depth_ = std::max(a.depth_, b.depth_ + 1);
  return f;
}

Formula Formula::operator-() const
{
  return followed_by({Op::negate});
}

Formula operator+(const Formula &a, const Formula &b)
{
  using Op = Formula::Op;
  if (b.is_constant())
    return a.followed_by({Op::offset, 0, b.constant()});
  if (a.is_constant())
    return b + a;
  return Formula::joined(a, b).followed_by({Op::add});
}

Formula operator-(const Formula &a, const Formula &b)
{
  if (a.is_constant() || b.is_constant())
    return a + -b;
  return Formula::joined(a, b).followed_by({Formula::Op::subtract});
}

Formula operator*(const Formula &a, const Formula &b)
{
  using Op = Formula::Op;
  if (b.is_constant())
    return a.followed_by({Op::scale, 0, b.constant()});
  if (a.is_constant())
    return b * a;
  return Formula::joined(a, b).followed_by({Op::multiply});
}

Formula operator/(const Formula &a, const Formula &b)
{
  return Formula::joined(a, b).followed_by({Formula::Op::divide});
}

Formula power(const Formula &a, const Formula &b)
{
  using Op = Formula::Op;
  if (!b.is_constant())
    return applied(Function::exp, b * applied(Function::log, a));
  const double c = b.constant();
  if (c == 0.)
    return 1.;
  if (c == 1.)
    return a;
  constexpr int largest_integer_power = 1000000; // larger powers give 0, 1 or infinity, as a root does
  if (c == std::round(c) && std::abs(c) <= largest_integer_power && !a.is_constant())
    return a.followed_by({Op::integer_power, static_cast<int>(c)});
  return a.followed_by({Op::root, 0, c});
}

Formula applied(Function f, const Formula &a)
{
  return a.followed_by({Formula::Op::function, static_cast<int>(f)});
}

Formula atan2(const Formula &y, const Formula &x)
{
  return Formula::joined(y, x).followed_by({Formula::Op::angle});
}

Formula abs(const Formula &a)
{
  return a.with_kink(Formula::Op::abs, "abs");
}

Formula sign(const Formula &a)
{
  return a.with_kink(Formula::Op::sign, "sign");
}

Formula step(const Formula &a)
{
  return a.with_kink(Formula::Op::step, "step");
}

Formula min(const Formula &a, const Formula &b)
{
  return Formula::joined(a, b).with_kink(Formula::Op::min, "min");
}

Formula max(const Formula &a, const Formula &b)
{
  return Formula::joined(a, b).with_kink(Formula::Op::max, "max");
}

// argument, branch -> (then, jump) or (otherwise)
Formula conditional(const Formula &argument, Relation relation, const Formula &then, const Formula &otherwise)
{
  using Op = Formula::Op;
  if (argument.is_constant())
    return formula::satisfies(argument.constant(), relation) ? then : otherwise;
  const int n_then = static_cast<int>(then.code_.size()), n_otherwise = static_cast<int>(otherwise.code_.size());
  Formula   f = argument;
  f.kinks_.push_back("if");
  f.code_.push_back({Op::branch, argument.n_kinks(), 0., n_then + 1, relation});
  f.append(then);
  f.code_.push_back({Op::jump, 0, 0., n_otherwise});
  f.append(otherwise);
  f.depth_ = std::max({argument.depth_, then.depth_, otherwise.depth_});
  return f.folded();
}

} // namespace gestell::mechanism
