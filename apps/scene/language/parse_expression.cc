#include "apps/scene/language/parse_expression.h"

#include "apps/scene/language/tokens.h"
#include "apps/scene/language/units.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{
namespace
{

const std::map<std::string, mechanism::Relation> relations = {{">", mechanism::Relation::above},
                                                              {">=", mechanism::Relation::not_below},
                                                              {"<", mechanism::Relation::below},
                                                              {"<=", mechanism::Relation::not_above}};

/// An unknown name, with the names that may be intended, the most likely first.
struct UnknownName
{
  std::size_t              token;
  std::vector<std::string> meant;
  std::string              before, after; ///< message around a proposal
};

class Parser
{
public:
  Parser(const std::string &text, const std::vector<Variable> &variables, const NameLookup &parameters,
         const std::vector<std::string> &names)
      : text_(text), variables_(variables), parameters_(parameters), names_(names), tokens_(tokens_of(text))
  {
  }

  Expression whole()
  {
    if (at_end())
      throw std::invalid_argument("\"" + text_ + "\" is empty; a number with a unit such as \"40 mm\" is expected");
    const Expression e = sum();
    if (!at_end())
      missing_operator();
    return at(next_, [&] { return check_turns(e), e; });
  }

  /// Replaces the token by `text`.
  void replace(std::size_t token, const std::string &text)
  {
    auto other = tokens_of(text);
    other.pop_back();
    const auto place = tokens_.begin() + token;
    tokens_.insert(tokens_.erase(place), other.begin(), other.end());
  }

  [[noreturn]] void fail(const std::string &what, std::size_t token) const
  {
    throw std::invalid_argument("\"" + text_ + "\" " + what + character(tokens_[token].place));
  }

private:
  // --- errors

  /// Names of parameters and variables.
  std::vector<std::string> known_names() const
  {
    std::vector<std::string> known = names_;
    for (const Variable &variable : variables_)
      known.push_back(variable.name);
    return known;
  }

  [[noreturn]] void fail(const std::string &what) const { fail(what, next_); }

  /// The result of `operation`; its errors are about the token.
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
      throw UnknownName{next_, units_meant(token().text), "has an unknown unit '" + token().text + "'", ""};
    refuse_decimal_comma();
    if (token().kind == Token::symbol && relations.count(token().text))
      fail("compares outside of a condition; write if(a " + token().text + " b, value, other value)");
    fail("lacks an operator (* / + -) before '" + token().text + "'");
  }
  void refuse_decimal_comma() const
  {
    if (is(",") && next_ > 0 && tokens_[next_ - 1].kind == Token::number && token(1).kind == Token::number)
    {
      const std::string whole = tokens_[next_ - 1].text;
      fail(whole.find('.') == std::string::npos
               ? "has a decimal comma; write " + whole + "." + token(1).text
               : "has a decimal comma; write a decimal point, and no separator between thousands");
    }
  }

  [[noreturn]] void unknown_name(const std::string &name) const
  {
    std::string listed;
    for (const Variable &variable : variables_)
      listed += (listed.empty() ? "" : ", ") + variable.name + " (" + variable.meaning + ")";
    auto       meant = near_names(name, known_names());
    const auto units = units_meant(name);
    meant.insert(meant.end(), units.begin(), units.end());
    throw UnknownName{next_, meant,
                      "names '" + name + "', which is neither a " + (variables_.empty() ? "" : "variable, a ") +
                          "parameter nor a unit",
                      (variables_.empty() ? "" : "; the variables are " + listed) +
                          "; parameters are declared in [parameters]"};
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
    if (token(ahead).kind != Token::name || is("(", ahead + 1))
      return false;
    return units().count(token(ahead).text) || (turn_units().count(token(ahead).text) && is_per_time(ahead + 1));
  }
  bool is_per_time(std::size_t ahead) const
  {
    const auto unit = units().find(token(ahead + 1).text);
    return is("/", ahead) && unit != units().end() && equal(unit->second.dimension, {0, 0, 1});
  }
  /// For a name with is_unit().
  static const Quantity &unit_named(const std::string &name)
  {
    return units().count(name) ? units().at(name) : turn_units().at(name);
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
      const std::size_t sign       = next_++;
      const bool        over       = tokens_[sign].text == "/";
      const bool        per_minute = over && at_minute() && a.counts == Counts::nothing && equal(a.dimension, {});
      number_with_unit_            = false;
      const Expression b           = factor();
      if (over && number_with_unit_)
        fail("is ambiguous: put the part after '/' or the part before its unit in parentheses", sign);
      a = at(sign, [&] { return per_minute ? shaft_turns(a, b) : over ? divided(a, b) : multiplied(a, b); });
    }
    return a;
  }

  /// Whether the next factor is "min", "(min)", "(1 min)", or the same with hours.
  bool at_minute() const
  {
    const bool        inside = is("(");
    const std::size_t unit   = !inside ? 0 : token(1).kind == Token::number && token(1).value == 1. ? 2 : 1;
    const std::size_t after  = unit + 1;
    const bool        ends   = inside ? is(")", after) : !is("^", after) && !is_unit(after);
    return is_unit(unit) && unit_named(token(unit).text).counts == Counts::minutes && ends &&
           !is_operand(token(unit).text);
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
    const bool        unit_before = std::exchange(number_with_unit_, false);
    const Expression  exponent    = factor();
    if (number_with_unit_)
      fail("has a unit after its exponent; write 1e-3 mm, or put the power in parentheses", sign);
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
    refuse_decimal_comma();
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
      return ++next_, Quantity{3.14159265358979323846, {}, true, Counts::pi};
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
      fail("calls an unknown function '" + name + "'" + suggestion(name, function_names()));
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

  /// Parses if(a < b, then, otherwise) after its parenthesis.
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
  Expression with_units(const Expression &number)
  {
    const Quantity one{1., {}, true, Counts::nothing};
    const auto     first   = next_;
    bool           divided = false, any = false;
    Expression     e = number, group = one; ///< with the units; only the units
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
        fail("is ambiguous; write \"N/(m s)\" or \"N s/m\"");
      const std::size_t begin = next_;
      next_ += per ? 1 : reciprocal ? 2 : 0;
      const Expression unit   = unit_power();
      const auto       joined = [&](const Expression &a)
      { return at(begin, [&] { return per || reciprocal ? apps::divided(a, unit) : multiplied(a, unit); }); };
      e       = joined(e);
      group   = joined(group);
      divided = divided || per || reciprocal;
      any     = true;
    }
    number_with_unit_ = any;
    return is_per_minute(group) ? at(first, [&] { return shaft_turns(number, apps::divided(one, group)); }) : e;
  }

  /// "1/min", "min^-1", "1/min/s" without another unit count shaft revolutions.
  static bool is_per_minute(const Expression &group)
  {
    return group.counts == Counts::minutes && group.dimension[2] < 0. &&
           equal(group.dimension, {0, 0, group.dimension[2]});
  }

  Expression unit_power()
  {
    const std::string name = token().text;
    if (is_operand(name)) // an operand never comes here: this name follows a number or a unit
      ambiguous_name(name);
    const std::size_t begin = next_++;
    if (!take("^"))
      return unit_named(name);
    if (name == "%")
      fail("needs % without an exponent: \"2 %\" is 0.02; write its square as \"(2 %)^2\"");
    const double sign = take("-") ? -1. : 1.;
    if (token().kind != Token::number || token().value != std::floor(token().value))
      fail("needs an integer as the exponent of the unit '" + name + "'");
    const Quantity exponent{sign * tokens_[next_++].value, {}, true, Counts::nothing};
    return at(begin, [&] { return raised(unit_named(name), exponent); });
  }

  const std::string               text_;
  const std::vector<Variable>    &variables_;
  const NameLookup               &parameters_;
  const std::vector<std::string> &names_;  ///< of all parameters: not copied, an expression is read for each of them
  std::vector<Token>              tokens_; ///< the last one is of kind `end`
  std::size_t                     next_             = 0;
  bool                            number_with_unit_ = false; ///< the operand just read was "2 mm" without parentheses
};

/// It can be read and, if there is a kind, is of it.
bool makes_sense(Parser &parser, const Kind *kind, const std::string &text)
{
  try
  {
    const Expression e = parser.whole();
    if (kind)
      formula_as(e, *kind, text);
    return true;
  }
  catch (const std::invalid_argument &)
  {
    return false;
  }
  catch (const UnknownName &)
  {
    return false;
  }
}

} // namespace

Expression parse_expression(const std::string &text, const std::vector<Variable> &variables,
                            const NameLookup &parameters, const std::vector<std::string> &names, const Kind *kind)
{
  constexpr std::size_t longest_text = 1000; // keeps the recursion far from the end of the stack
  if (text.size() > longest_text)
    throw std::invalid_argument("\"" + text.substr(0, 40) + "...\" is longer than " + std::to_string(longest_text) +
                                " characters; split it into parameters");
  Parser parser(text, variables, parameters, names);
  try
  {
    return parser.whole();
  }
  catch (const UnknownName &unknown)
  {
    for (const std::string &meant : unknown.meant)
    {
      Parser other(text, variables, parameters, names);
      other.replace(unknown.token, meant);
      if (makes_sense(other, kind, text))
        parser.fail(unknown.before + "; did you mean '" + meant + "'?" + unknown.after, unknown.token);
    }
    parser.fail(unknown.before + (kind ? "; " + with_article(*kind) + " is given as \"" + kind->example + "\"" : "") +
                    unknown.after,
                unknown.token);
  }
}

} // namespace gestell::apps
