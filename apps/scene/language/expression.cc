#include "apps/scene/language/expression.h"

#include "fem/values/two_pi.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using mechanism::Formula;
using mechanism::Function;

[[noreturn]] void fail(const std::string &what)
{
  throw std::invalid_argument(what);
}

bool is_number(const Expression &e)
{
  return !e.checked || equal(e.dimension, {});
}

/// 2 pi rad times a frequency is an angular speed.
Counts joined(Counts a, Counts b)
{
  return std::max(a, b);
}

bool counts_shaft_turns(const Expression &e)
{
  return e.counts == Counts::shaft_turns;
}

/// Whether a factor leaves shaft revolutions unchanged.  Lengths and masses must cancel by the end: check_turns().
bool leaves_turns(const Expression &e)
{
  return e.counts <= Counts::minutes && e.counts != Counts::pi;
}

[[noreturn]] void fail_turns(const std::string &verb, const Expression &a, const Expression &b)
{
  const Expression &other = counts_shaft_turns(a) ? b : a;
  if (other.counts == Counts::pi)
    fail(verb + " revolutions (1/min, rpm) and pi, but the factor 2 pi is already included in their angular speed; "
                "remove pi, or write the frequency in Hz");
  fail(verb + " revolutions (1/min, rpm) and " +
       (other.counts == Counts::radians ? "radians" : describe(other.dimension)) +
       ", where revolutions or radians could be meant; write the speed in rad/s, \"(2*pi*25) rad/s\", or in Hz, \"25 "
       "Hz\"");
}

Dimension sum(const Dimension &a, const Dimension &b, int sign)
{
  return {a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2]};
}

Dimension multiple(Dimension d, double factor)
{
  for (double &exponent : d)
    exponent *= factor;
  return d;
}

/// Common dimension of a and b, for a formula that combines both.  `verb` and `preposition` name the operation: adds b
/// to a.
Expression alike(const Expression &a, const Expression &b, const std::string &verb, const std::string &preposition)
{
  const bool a_nothing = a.is_zero() && equal(a.dimension, {}); // zero of anything is zero
  const bool b_nothing = b.is_zero() && equal(b.dimension, {});
  if (a.checked && b.checked && !a_nothing && !b_nothing && !equal(a.dimension, b.dimension))
    fail(verb + " " + describe(b.dimension) + " " + preposition + " " + describe(a.dimension) +
         "; both must have the same dimension");
  // The operand with a known dimension determines the dimension of the result.
  Expression c = a_nothing || (!a.checked && b.checked && !b_nothing) ? b : a;
  c.counts     = joined(a.counts, b.counts);
  if (counts_shaft_turns(a) == counts_shaft_turns(b) || a.is_zero() || b.is_zero())
    return c;
  const Expression &other = counts_shaft_turns(a) ? b : a;
  if (other.checked && other.counts != Counts::radians)
    fail(verb + " revolutions (1/min, rpm) " + preposition +
         " a value that may be in revolutions or radians; write all in 1/min or all in rad/s");
  c.counts = Counts::radians; // a plain number of [parameters] is in rad/s
  return c;
}

Expression with(Expression e, const Formula &formula)
{
  e.formula = formula;
  return e;
}

/// f(x) of a plain number or an angle.
Expression elementary(const std::string &name, Function f, const Expression &x)
{
  if (!is_number(x))
    fail("takes " + name + "() of " + describe(x.dimension) + "; it needs a plain number or an angle");
  const bool of_angle = name == "sin" || name == "cos" || name == "tan";
  if (counts_shaft_turns(x) && !of_angle)
    fail("takes " + name + "() of revolutions (1/min, rpm); it needs a plain number");
  if (x.counts == Counts::minutes && of_angle)
    fail("takes " + name +
         "() of a value in minutes or hours, which is ambiguous; for revolutions write 1500/min first, for time use "
         "seconds");
  return {applied(f, x.formula), {}, x.checked, Counts::nothing};
}

const std::map<std::string, Function> &elementary_functions()
{
  static const std::map<std::string, Function> functions = {
      {"sin", Function::sin}, {"cos", Function::cos},   {"tan", Function::tan},  {"exp", Function::exp},
      {"log", Function::log}, {"tanh", Function::tanh}, {"atan", Function::atan}};
  return functions;
}

} // namespace

const std::vector<std::string> &function_names()
{
  static const std::vector<std::string> names = {"sin", "cos",  "tan",  "sqrt",  "abs",  "exp",  "log", "min",
                                                 "max", "tanh", "atan", "atan2", "sign", "step", "if"};
  return names;
}

bool is_function(const std::string &name)
{
  return std::find(function_names().begin(), function_names().end(), name) != function_names().end();
}

Expression added(const Expression &a, const Expression &b)
{
  return with(alike(a, b, "adds", "to"), a.formula + b.formula);
}

Expression subtracted(const Expression &a, const Expression &b)
{
  return with(alike(a, b, "subtracts", "from"), a.formula - b.formula);
}

Expression compared(const Expression &a, const Expression &b)
{
  return with(alike(a, b, "compares", "with"), a.formula - b.formula);
}

Expression multiplied(const Expression &a, const Expression &b)
{
  const bool turns = counts_shaft_turns(a) || counts_shaft_turns(b);
  if (turns && !leaves_turns(counts_shaft_turns(a) ? b : a))
    fail_turns("multiplies", a, b);
  return {a.formula * b.formula, sum(a.dimension, b.dimension, 1), a.checked && b.checked, joined(a.counts, b.counts)};
}

Expression divided(const Expression &a, const Expression &b)
{
  if (b.is_zero())
    fail("divides by zero");
  const Expression quotient{a.formula / b.formula, sum(a.dimension, b.dimension, -1), a.checked && b.checked,
                            joined(a.counts, b.counts)};
  if (!counts_shaft_turns(b) && (!counts_shaft_turns(a) || leaves_turns(b)))
    return quotient;
  const bool in_radians = a.counts >= Counts::shaft_turns && b.counts >= Counts::shaft_turns;
  if (!in_radians || !equal({0., 0., quotient.dimension[2]}, {}))
    fail_turns("divides", a, b);
  return {quotient.formula, quotient.dimension, quotient.checked, Counts::nothing}; // with a ratio of speeds
}

void check_turns(const Expression &e)
{
  const Dimension beside{e.dimension[0], e.dimension[1], 0.};
  if (counts_shaft_turns(e) && e.checked && !equal(beside, {}))
    fail_turns("multiplies", e, Quantity{1., beside, true, Counts::nothing});
}

Expression shaft_turns(const Expression &a, const Expression &minutes)
{
  return multiplied(a, {two_pi / minutes.formula, multiple(minutes.dimension, -1.), true, Counts::shaft_turns});
}

Expression negated(const Expression &a)
{
  return with(a, -a.formula);
}

Expression raised(const Expression &a, const Expression &exponent)
{
  if (!is_number(exponent))
    fail("has an exponent with a unit");
  if (counts_shaft_turns(a))
    fail("raises revolutions (1/min, rpm) to a power; write the speed in rad/s or Hz");
  if (!exponent.is_value())
  {
    if (!is_number(a))
      fail("raises " + describe(a.dimension) + " to an exponent that varies; only a plain number can have one");
    if (a.is_value() && !(a.formula.constant() > 0.))
      fail("raises a number that is not above zero to an exponent that varies");
  }
  const Formula value = power(a.formula, exponent.formula);
  if (!a.checked || !exponent.checked)
    return {value, {}, false, a.counts};
  if (!exponent.is_value())
    return {value, {}, true, Counts::nothing};
  return {value, multiple(a.dimension, exponent.formula.constant()), true, a.counts};
}

Expression chosen(const Expression &argument, mechanism::Relation relation, const Expression &then,
                  const Expression &otherwise)
{
  return with(alike(then, otherwise, "chooses between", "and"),
              conditional(argument.formula, relation, then.formula, otherwise.formula));
}

Expression called(const std::string &name, const std::vector<Expression> &x)
{
  const std::size_t needed = name == "min" || name == "max" || name == "atan2" ? 2 : 1;
  if (x.size() != needed)
    fail("gives " + name + "() " + std::to_string(x.size()) + " arguments instead of " + std::to_string(needed));
  if (name == "min")
    return with(alike(x[0], x[1], "compares", "with"), min(x[0].formula, x[1].formula));
  if (name == "max")
    return with(alike(x[0], x[1], "compares", "with"), max(x[0].formula, x[1].formula));
  if (name == "atan2")
    return {atan2(x[0].formula, x[1].formula), {}, alike(x[0], x[1], "compares", "with").checked, Counts::radians};
  if (name == "abs")
    return with(x[0], abs(x[0].formula));
  if (name == "sign")
    return {sign(x[0].formula), {}, true, Counts::nothing};
  if (name == "step")
    return {step(x[0].formula), {}, true, Counts::nothing};
  if (name == "sqrt")
  {
    if (x[0].is_value() && x[0].formula.constant() < 0.)
      fail("takes the root of a negative number");
    if (counts_shaft_turns(x[0]))
      fail("takes the root of revolutions (1/min, rpm); write the speed in rad/s or Hz");
    return {power(x[0].formula, 0.5), multiple(x[0].dimension, 0.5), x[0].checked, x[0].counts};
  }
  return elementary(name, elementary_functions().at(name), x[0]);
}

mechanism::Formula formula_as(const Expression &e, const Kind &kind, const std::string &text)
{
  if (e.is_value())
    return value_as({e.formula.constant(), e.dimension, e.checked, e.counts}, kind, text);
  check_kind({0., e.dimension, e.checked, e.counts}, false, kind, text, "which is in " + describe(e.dimension));
  return e.formula * per_radian(e.counts, kind);
}

} // namespace gestell::apps
