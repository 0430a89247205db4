#include "apps/scene/parse_expression.h"

#include "apps/scene/tokens.h"
#include "apps/scene/units.h"
#include "coupling/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr std::size_t longest_text = 1000; // keeps the recursion far from the end of the stack

const std::map<std::string, mechanism::Relation> relations = {{">", mechanism::Relation::above},
                                                              {">=", mechanism::Relation::not_below},
                                                              {"<", mechanism::Relation::below},
                                                              {"<=", mechanism::Relation::not_above}};

class Parser
{
public:
  Parser(const std::string &text, const std::vector<Variable> &variables, const NameLookup &parameters,
         const std::vector<std::string> &names)
      : text_(text), variables_(variables), parameters_(parameters), known_names_(names), tokens_(tokens_of(text))
  {
    for (const Variable &variable : variables)
      known_names_.push_back(variable.name);
    const auto unit_list = unit_names();
    known_names_.insert(known_names_.end(), unit_list.begin(), unit_list.end());
  }

  Expression whole()
  {
    if (at_end())
      throw std::invalid_argument("\"" + text_ + "\" is empty; a number with a unit such as \"40 mm\" is expected");
    const Expression e = sum();
    if (!at_end())
      missing_operator();
    return e;
  }

private:
  // --- errors

  [[noreturn]] void fail(const std::string &what, std::size_t token) const
  {
    throw std::invalid_argument("\"" + text_ + "\" " + what + character(tokens_[token].place));
  }
  [[noreturn]] void fail(const std::string &what) const { fail(what, next_); }

  /// The result of `operation`; what it says against it is about the token.
  template <typename Operation>
  Expression at(std::size_t token, Operation operation) const
  {
    Expression e;
    try
    {
      e = operation();
    }
    catch (const std::invalid_argument &error)
    {
      fail(error.what(), token);
    }
    if (e.is_value() && !std::isfinite(e.formula.constant()))
      fail("is not a finite number", token);
    return e;
  }

  [[noreturn]] void missing_operator() const
  {
    if (token().kind == Token::name && !is_operand(token().text) && !is_function(token().text) && !is_unit())
      fail("has an unknown unit '" + token().text + "'" + near(token().text, unit_names()));
    if (token().kind == Token::symbol && relations.count(token().text))
      fail("compares outside of a condition; write if(a " + token().text + " b, value, other value)");
    fail("lacks an operator (* / + -) before '" + token().text + "'");
  }
  static std::string near(const std::string &name, const std::vector<std::string> &names)
  {
    const auto nearest = coupling::nearest_name(name, names);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
  }

  [[noreturn]] void unknown_name(const std::string &name) const
  {
    std::string listed;
    for (const Variable &variable : variables_)
      listed += (listed.empty() ? "" : ", ") + variable.name + " (" + variable.meaning + ")";
    fail("names '" + name + "', which is neither a " + (variables_.empty() ? "" : "variable, a ") +
         "parameter nor a unit" + near(name, known_names_) +
         (variables_.empty() ? "" : "; the variables are " + listed) + "; parameters are declared in [parameters]");
  }

  [[noreturn]] void ambiguous_name(const std::string &name) const
  {
    const std::string kind = variable(name) < 0 ? "parameter" : "variable";
    fail("uses '" + name + "', which is a unit and a " + kind + "; for the " + kind +
         " write an operator and, after '/', parentheses: \"2 * (" + name + ")\"; for the unit use another one" +
         (kind == "parameter" ? " or rename the parameter" : ""));
  }

  // --- tokens

  bool         at_end() const { return token().kind == Token::end; }
  const Token &token(std::size_t ahead = 0) const { return tokens_[std::min(next_ + ahead, tokens_.size() - 1)]; }
  bool         is(const std::string &symbol, std::size_t ahead = 0) const
  {
    return token(ahead).kind == Token::symbol && token(ahead).text == symbol;
  }
  bool is_unit(std::size_t ahead = 0) const
  {
    return token(ahead).kind == Token::name && units().count(token(ahead).text) && !is("(", ahead + 1);
  }
  bool take(const std::string &symbol) { return is(symbol) ? (++next_, true) : false; }

  int variable(const std::string &name) const
  {
    for (std::size_t i = 0; i < variables_.size(); ++i)
      if (variables_[i].name == name)
        return static_cast<int>(i);
    return -1;
  }
  bool is_operand(const std::string &name) const { return variable(name) >= 0 || parameters_(name); }

  // --- grammar

  Expression sum()
  {
    Expression a = product_of_factors();
    while (is("+") || is("-"))
    {
      const std::size_t sign = next_++;
      const Expression  b    = product_of_factors();
      a                      = at(sign, [&] { return tokens_[sign].text == "+" ? added(a, b) : subtracted(a, b); });
    }
    return a;
  }

  Expression product_of_factors()
  {
    Expression a = factor();
    while (is("*") || is("/"))
    {
      const std::size_t sign   = next_++;
      const bool        over   = tokens_[sign].text == "/";
      const bool        minute = over && token().text == "min" && !is_operand("min");
      number_with_unit_        = false;
      const Expression b       = factor();
      if (over && number_with_unit_)
        fail("can be read in two ways: put what stands after '/' in parentheses, or what stands before its unit", sign);
      a = at(sign, [&] { return over ? divided(a, b) : multiplied(a, b); });
      if (minute && a.counts == Counts::nothing && equal(a.dimension, {0, 0, -1}))
        a.counts = Counts::turns;
    }
    return a;
  }

  Expression factor()
  {
    if (take("+"))
      return factor();
    if (take("-"))
      return negated(factor());
    return power();
  }

  Expression power()
  {
    const Expression base = operand();
    if (!is("^"))
      return base;
    const std::size_t sign        = next_++;
    const bool        unit_before = number_with_unit_;
    const Expression  exponent    = factor();
    if (base.checked && exponent.checked)
      number_with_unit_ = unit_before;
    return at(sign, [&] { return raised(base, exponent); });
  }

  Expression operand()
  {
    if (token().kind == Token::number)
    {
      const Quantity number{token().value, {}, true, Counts::nothing};
      ++next_;
      return with_units(number);
    }
    if (take("("))
    {
      const Expression e = sum();
      close();
      const Expression whole = with_units(e);
      number_with_unit_      = false;
      return whole;
    }
    if (token().kind == Token::name)
      return named();
    fail(at_end() ? "ends where a number is expected" : "has '" + token().text + "' where a number is expected");
  }

  void close()
  {
    if (!take(")"))
      fail("lacks a closing ')'");
  }

  Expression named()
  {
    const std::string name = token().text;
    if (is("(", 1))
      return function(name);
    if (const int i = variable(name); i >= 0)
    {
      if (parameters_(name))
        fail("uses '" + name + "', which is a variable of the formula and a parameter; rename the parameter");
      ++next_;
      return {mechanism::Formula::variable(i), variables_[i].dimension, true, variables_[i].counts};
    }
    if (const auto value = parameters_(name))
      return ++next_, *value;
    if (name == "pi")
      return ++next_, Quantity{3.14159265358979323846, {}, true, Counts::nothing};
    if (is_unit())
    {
      const Expression e = with_units(Quantity{1., {}, true, Counts::nothing});
      number_with_unit_  = false;
      return e;
    }
    unknown_name(name);
  }

  Expression function(const std::string &name)
  {
    if (!is_function(name))
      fail("calls an unknown function '" + name + "'" + coupling::suggestion(name, function_names()));
    const std::size_t begin = next_;
    next_ += 2;
    if (name == "if")
      return condition(begin);
    std::vector<Expression> arguments{sum()};
    while (take(","))
      arguments.push_back(sum());
    close();
    number_with_unit_ = false;
    return at(begin, [&] { return called(name, arguments); });
  }

  /// if(a < b, then, otherwise), from behind its parenthesis.
  Expression condition(std::size_t begin)
  {
    const Expression  a        = sum();
    const std::size_t sign     = next_;
    const auto        relation = relations.find(token().text);
    if (token().kind != Token::symbol || relation == relations.end())
      fail("has an if() without a comparison (< <= > >=) as its first argument");
    ++next_;
    const Expression b        = sum();
    const Expression argument = at(sign, [&] { return compared(a, b); });
    Expression       parts[2];
    for (Expression &part : parts)
    {
      if (!take(","))
        fail("gives if() too few arguments; write if(a < b, value, other value)");
      part = sum();
    }
    close();
    number_with_unit_ = false;
    return at(begin, [&] { return chosen(argument, relation->second, parts[0], parts[1]); });
  }

  /// Units that follow a number without an operator.
  Expression with_units(Expression e)
  {
    bool divided = false, any = false;
    number_with_unit_ = false;
    for (;;)
    {
      const bool per        = is("/") && is_unit(1) && any;
      const bool reciprocal = token().kind == Token::number && token().value == 1. && is("/", 1) && is_unit(2);
      if (!per && !reciprocal && !is_unit())
        break;
      if (per && is_operand(token(1).text))
        ambiguous_name(token(1).text);
      if (divided && !per)
        fail("can be read in two ways; put the units below the line in parentheses, \"N/(m s)\", or above it, \"N "
             "s/m\"");
      const std::size_t begin = next_;
      next_ += per ? 1 : reciprocal ? 2 : 0;
      if (reciprocal && !any && token().text == "min" && !is("^", 1))
        ++next_, e = multiplied(e, units().at("rpm"));
      else
      {
        const Expression unit = unit_power();
        e = at(begin, [&] { return per || reciprocal ? apps::divided(e, unit) : multiplied(e, unit); });
      }
      divided = divided || per || reciprocal;
      any     = true;
    }
    number_with_unit_ = any;
    return e;
  }

  Expression unit_power()
  {
    const std::string name = token().text;
    if (is_operand(name)) // an operand never comes here: this name follows a number or a unit
      ambiguous_name(name);
    const std::size_t begin = next_++;
    if (!take("^"))
      return units().at(name);
    if (name == "%")
      fail("needs % without an exponent: \"2 %\" is 0.02; write its square as \"(2 %)^2\"");
    const double sign = take("-") ? -1. : 1.;
    if (token().kind != Token::number || token().value != std::floor(token().value))
      fail("needs a whole number as the exponent of the unit '" + name + "'");
    const Quantity exponent{sign * tokens_[next_++].value, {}, true, Counts::nothing};
    return at(begin, [&] { return raised(units().at(name), exponent); });
  }

  const std::string            text_;
  const std::vector<Variable> &variables_;
  const NameLookup            &parameters_;
  std::vector<std::string>     known_names_; ///< parameters, variables and units
  std::vector<Token>           tokens_;      ///< the last one is of kind `end`
  std::size_t                  next_             = 0;
  bool                         number_with_unit_ = false; ///< the operand just read was "2 mm" without parentheses
};

} // namespace

Expression parse_expression(const std::string &text, const std::vector<Variable> &variables,
                            const NameLookup &parameters, const std::vector<std::string> &names)
{
  if (text.size() > longest_text)
    throw std::invalid_argument("\"" + text.substr(0, 40) + "...\" is longer than " + std::to_string(longest_text) +
                                " characters; split it into parameters");
  return Parser(text, variables, parameters, names).whole();
}

} // namespace gestell::apps
