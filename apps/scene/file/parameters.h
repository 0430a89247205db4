#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/scene/language/parse_expression.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The values of [parameters]: each a number or an expression of other parameters, in any order.
class Parameters
{
public:
  Parameters() = default;
  /// @param table  the table [parameters], or null if there is none.
  /// @throws std::invalid_argument with file and line for circles, names that mean something else, and wrong values.
  explicit Parameters(const SceneNode *table);

  std::optional<Quantity>  find(const std::string &name) const;
  std::vector<std::string> names() const;

  /// A number or an expression; what a plain number measures is not known.
  Quantity evaluate(const SceneNode &value) const;
  /// The same of `variables` as well; `kind` as of parse_expression().
  Expression expression(const SceneNode &value, const std::vector<Variable> &variables,
                        const Kind *kind = nullptr) const;

private:
  Quantity evaluate_entry(const SceneNode &table, const std::string &name, std::vector<std::string> &open);

  std::map<std::string, Quantity> values_;
};

} // namespace gestell::apps
