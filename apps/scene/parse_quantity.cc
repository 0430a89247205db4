#include "apps/scene/quantity.h"
#include "apps/scene/tokens.h"
#include "apps/scene/units.h"
#include "coupling/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr std::size_t longest_text = 1000; // keeps the recursion far from the end of the stack

const std::vector<std::string> function_names = {"sin", "cos", "tan", "sqrt", "abs", "exp", "log", "min", "max"};

bool is_function(const std::string &name)
{
  return std::find(function_names.begin(), function_names.end(), name) != function_names.end();
}

bool is_number(const Quantity &q)
{
  return !q.checked || equal(q.dimension, {});
}

Counts joined(Counts a, Counts b)
{
  if (a == Counts::radians || b == Counts::radians)
    return Counts::radians; // 2 pi rad times a frequency is an angular speed
  return std::max(a, b);
}

Quantity product(const Quantity &a, const Quantity &b, int sign)
{
  Quantity c;
  c.value = sign > 0 ? a.value * b.value : a.value / b.value;
  for (int i = 0; i < 3; ++i)
    c.dimension[i] = a.dimension[i] + sign * b.dimension[i];
  c.checked = a.checked && b.checked;
  c.counts  = joined(a.counts, b.counts);
  return c;
}

Quantity to_power(const Quantity &a, double exponent)
{
  Quantity c = a;
  c.value    = std::pow(a.value, exponent);
  for (double &d : c.dimension)
    d *= exponent;
  return c;
}

class Parser
{
public:
  Parser(const std::string &text, const NameLookup &parameters, const std::vector<std::string> &names)
      : text_(text), parameters_(parameters), known_names_(names), tokens_(tokens_of(text))
  {
    const auto unit_list = unit_names();
    known_names_.insert(known_names_.end(), unit_list.begin(), unit_list.end());
  }

  Quantity whole()
  {
    if (at_end())
      fail("is empty; a number with a unit such as \"40 mm\" is expected");
    const Quantity q = sum();
    if (!at_end())
      missing_operator();
    if (!std::isfinite(q.value))
      fail("is not a finite number");
    return q;
  }

private:
  [[noreturn]] void fail(const std::string &what) const { throw std::invalid_argument("\"" + text_ + "\" " + what); }

  bool         at_end() const { return next_ == tokens_.size(); }
  const Token &token(int ahead = 0) const { return next_ + ahead < tokens_.size() ? tokens_[next_ + ahead] : end_; }
  bool         is(const std::string &symbol, int ahead = 0) const
  {
    return token(ahead).kind == Token::symbol && token(ahead).text == symbol;
  }
  bool is_unit(int ahead = 0) const
  {
    return token(ahead).kind == Token::name && units().count(token(ahead).text) && !is("(", ahead + 1);
  }
  bool take(const std::string &symbol) { return is(symbol) ? (++next_, true) : false; }

  [[noreturn]] void missing_operator() const
  {
    if (token().kind == Token::name && !parameters_(token().text) && !is_function(token().text))
      fail("has an unknown unit '" + token().text + "'" + near(token().text, unit_names()));
    fail("lacks an operator (* / + -) before '" + token().text + "'");
  }
  static std::string near(const std::string &name, const std::vector<std::string> &names)
  {
    const auto nearest = coupling::nearest_name(name, names);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
  }

  Quantity sum()
  {
    Quantity a = product_of_factors();
    while (is("+") || is("-"))
    {
      const int sign = is("+") ? 1 : -1;
      ++next_;
      const Quantity b = product_of_factors();
      a                = added(a, b, sign);
    }
    return a;
  }

  Quantity added(const Quantity &a, const Quantity &b, int sign) const
  {
    if (a.checked && b.checked && !equal(a.dimension, b.dimension))
      fail(std::string(sign > 0 ? "adds " : "subtracts ") + describe(b.dimension) + (sign > 0 ? " to " : " from ") +
           describe(a.dimension) + "; both must be of one kind");
    Quantity c = a.checked ? a : b; // the one whose dimension is known tells that of the sum
    c.value    = a.value + sign * b.value;
    c.counts   = joined(a.counts, b.counts);
    return c;
  }

  Quantity product_of_factors()
  {
    Quantity a = factor();
    while (is("*") || is("/"))
    {
      const int  sign   = is("*") ? 1 : -1;
      const bool minute = sign < 0 && token(1).text == "min" && !parameters_("min");
      ++next_;
      number_with_unit_ = false;
      const Quantity b  = factor();
      if (sign < 0 && number_with_unit_)
        fail("can be read in two ways: put what stands after '/' in parentheses, or what stands before its unit");
      if (sign < 0 && b.value == 0.)
        fail("divides by zero");
      a = product(a, b, sign);
      if (minute && a.counts == Counts::nothing && equal(a.dimension, {0, 0, -1}))
        a.counts = Counts::turns;
    }
    return a;
  }

  Quantity factor()
  {
    if (take("+"))
      return factor();
    if (take("-"))
    {
      Quantity q = factor();
      q.value    = -q.value;
      return q;
    }
    return power();
  }

  Quantity power()
  {
    const Quantity base = operand();
    if (!take("^"))
      return base;
    const bool     unit_before = number_with_unit_;
    const Quantity exponent    = factor();
    if (!is_number(exponent))
      fail("has an exponent with a unit");
    if (!base.checked || !exponent.checked)
      return Quantity{std::pow(base.value, exponent.value), {}, false, base.counts};
    number_with_unit_ = unit_before;
    return to_power(base, exponent.value);
  }

  Quantity operand()
  {
    if (token().kind == Token::number)
    {
      const Quantity number{token().value, {}, true, Counts::nothing};
      ++next_;
      return with_units(number);
    }
    if (take("("))
    {
      const Quantity q = sum();
      if (!take(")"))
        fail("lacks a closing ')'");
      const Quantity whole = with_units(q);
      number_with_unit_    = false;
      return whole;
    }
    if (token().kind == Token::name)
      return named();
    fail(at_end() ? "ends where a number is expected" : "has '" + token().text + "' where a number is expected");
  }

  Quantity named()
  {
    const std::string name = token().text;
    if (is("(", 1))
      return function(name);
    if (const auto value = parameters_(name))
      return ++next_, *value;
    if (name == "pi")
      return ++next_, Quantity{3.14159265358979323846, {}, true, Counts::nothing};
    if (is_unit())
    {
      const Quantity q  = with_units(Quantity{1., {}, true, Counts::nothing});
      number_with_unit_ = false;
      return q;
    }
    fail("names '" + name + "', which is neither a parameter nor a unit" + near(name, known_names_) +
         "; parameters are declared in [parameters]");
  }

  Quantity function(const std::string &name)
  {
    if (!is_function(name))
      fail("calls an unknown function '" + name + "'" + coupling::suggestion(name, function_names));
    next_ += 2;
    std::vector<Quantity> arguments{sum()};
    while (take(","))
      arguments.push_back(sum());
    if (!take(")"))
      fail("lacks a closing ')'");
    number_with_unit_ = false;
    return evaluated(name, arguments);
  }

  Quantity evaluated(const std::string &name, const std::vector<Quantity> &x) const
  {
    const bool two = name == "min" || name == "max";
    if (x.size() != (two ? 2u : 1u))
      fail("gives " + name + "() " + std::to_string(x.size()) + " arguments instead of " + (two ? "2" : "1"));
    if (two)
    {
      Quantity c = added(x[0], x[1], 1);
      c.value    = name == "min" ? std::min(x[0].value, x[1].value) : std::max(x[0].value, x[1].value);
      return c;
    }
    Quantity c = x[0];
    c.value    = std::abs(c.value);
    if (name == "abs")
      return c;
    if (name == "sqrt")
      return x[0].value < 0. ? (fail("takes the root of a negative number"), c) : to_power(x[0], 0.5);
    if (!is_number(x[0]))
      fail("takes " + name + "() of " + describe(x[0].dimension) + "; it needs a plain number or an angle");
    const double u     = x[0].value;
    const double value = name == "sin"   ? std::sin(u)
                         : name == "cos" ? std::cos(u)
                         : name == "tan" ? std::tan(u)
                         : name == "exp" ? std::exp(u)
                                         : std::log(u);
    return Quantity{value, {}, x[0].checked, Counts::nothing};
  }

  /// Units that follow a number without an operator.
  Quantity with_units(Quantity q)
  {
    bool divided = false, any = false;
    number_with_unit_ = false;
    for (;;)
    {
      const bool per        = is("/") && is_unit(1) && any;
      const bool reciprocal = token().kind == Token::number && token().value == 1. && is("/", 1) && is_unit(2);
      if (!per && !reciprocal && !is_unit())
        break;
      if (per && parameters_(token(1).text))
        ambiguous_name(token(1).text);
      if (divided && !per)
        fail("can be read in two ways; put the units below the line in parentheses, \"N/(m s)\", or above it, \"N "
             "s/m\"");
      next_ += per ? 1 : reciprocal ? 2 : 0;
      if (reciprocal && !any && token().text == "min" && !is("^", 1))
        ++next_, q = product(q, units().at("rpm"), 1);
      else
        q = product(q, unit_power(), per || reciprocal ? -1 : 1);
      divided = divided || per || reciprocal;
      any     = true;
    }
    number_with_unit_ = any;
    return q;
  }

  Quantity unit_power()
  {
    const std::string name = token().text;
    if (parameters_(name)) // an operand that is a parameter never comes here: this name follows a number or a unit
      ambiguous_name(name);
    ++next_;
    if (!take("^"))
      return units().at(name);
    const int sign = take("-") ? -1 : 1;
    if (token().kind != Token::number || token().value != std::floor(token().value))
      fail("needs a whole number as the exponent of the unit '" + name + "'");
    return to_power(units().at(name), sign * tokens_[next_++].value);
  }

  [[noreturn]] void ambiguous_name(const std::string &name) const
  {
    fail("uses '" + name +
         "', which is a unit and a parameter; for the parameter write an operator and, after '/', "
         "parentheses: \"2 * (" +
         name + ")\"; for the unit use another one or rename the parameter");
  }

  const std::string        text_;
  const NameLookup        &parameters_;
  std::vector<std::string> known_names_; ///< parameters and units
  std::vector<Token>       tokens_;
  Token                    end_;
  std::size_t              next_             = 0;
  bool                     number_with_unit_ = false; ///< the operand just read was "2 mm" without parentheses
};

} // namespace

Quantity parse_quantity(const std::string &text, const NameLookup &parameters, const std::vector<std::string> &names)
{
  if (text.size() > longest_text)
    throw std::invalid_argument("\"" + text.substr(0, 40) + "...\" is longer than " + std::to_string(longest_text) +
                                " characters; split it into parameters");
  return Parser(text, parameters, names).whole();
}

bool is_reserved_name(const std::string &name)
{
  return name == "pi" || is_function(name);
}

} // namespace gestell::apps
