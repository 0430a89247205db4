#pragma once

#include "apps/scene/language/expression.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A variable of a formula; the i-th of a list is variable(i).
struct Variable
{
  std::string name, meaning; ///< "u", "displacement"
  Dimension   dimension{};
  Counts      counts = Counts::nothing;
};

/// Value of a name in an expression; empty if there is no such parameter.
using NameLookup = std::function<std::optional<Quantity>(const std::string &name)>;

/**
 * Reads an expression by the grammar of parse_quantity(), which is this one without variables.
 *
 * @param variables   at most mechanism::Formula::max_variables.  In place of an operand a variable has priority over a
 *                    unit of the same name; a parameter of the same name makes its use an error.
 * @param parameters  returns the value of a name; `names` are all parameters.
 * @param kind        required kind, for proposals if a unit is unknown; it is not checked.
 * @throws std::invalid_argument with the text, the error, and its character position.
 */
Expression parse_expression(const std::string &text, const std::vector<Variable> &variables,
                            const NameLookup &parameters, const std::vector<std::string> &names,
                            const Kind *kind = nullptr);

} // namespace gestell::apps
