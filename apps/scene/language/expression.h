#pragma once

#include "apps/scene/language/quantity.h"
#include "mechanism/functions/formula.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Result of the parser: a value, or a formula of variables, in SI units, with its dimension.
struct Expression
{
  mechanism::Formula formula;
  Dimension          dimension{};
  bool               checked = true; ///< as in Quantity
  Counts             counts  = Counts::nothing;

  Expression() = default;
  Expression(const Quantity &q) : formula(q.value), dimension(q.dimension), checked(q.checked), counts(q.counts) {}
  Expression(const mechanism::Formula &f, const Dimension &d, bool is_checked, Counts c)
      : formula(f), dimension(d), checked(is_checked), counts(c)
  {
  }

  bool is_value() const { return formula.is_constant(); }
  bool is_zero() const { return is_value() && formula.constant() == 0.; }
};

// Arithmetic with dimensions.  Throws std::invalid_argument with the error, "adds kg to m; ..."; the parser adds its
// position.

Expression added(const Expression &a, const Expression &b);
Expression subtracted(const Expression &a, const Expression &b);
Expression multiplied(const Expression &a, const Expression &b);
Expression divided(const Expression &a, const Expression &b);
Expression negated(const Expression &a);
/// a per `minutes`: a number of shaft revolutions in a time.
Expression shaft_turns(const Expression &a, const Expression &minutes);
/// @throws std::invalid_argument for turns of a shaft times a length or a mass, of a whole expression: n*D_1/D_2 has
/// none.
void       check_turns(const Expression &e);
Expression raised(const Expression &a, const Expression &exponent);

/// a - b, for a comparison of the two.
Expression compared(const Expression &a, const Expression &b);
Expression chosen(const Expression &argument, mechanism::Relation relation, const Expression &then,
                  const Expression &otherwise);

/// The formula of an expression that must be of `kind`; like value_as() for values.
mechanism::Formula formula_as(const Expression &expression, const Kind &kind, const std::string &text);

/// Value of the function; `name` is one of function_names() other than "if".
Expression called(const std::string &name, const std::vector<Expression> &arguments);

/// sin cos tan sqrt abs exp log min max tanh atan atan2 sign step if.
const std::vector<std::string> &function_names();
bool                            is_function(const std::string &name);

} // namespace gestell::apps
