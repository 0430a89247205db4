#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/scene/language/parse_expression.h"

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A parameter is overridden, but no value of the scene depends on it.
struct IdleParameter : std::invalid_argument
{
  using std::invalid_argument::invalid_argument;
};

/// The values of [parameters]: each a number or an expression of other parameters, in any order.
class Parameters
{
public:
  Parameters() = default;
  /// @param table  the table [parameters], or null if there is none.
  /// @throws std::invalid_argument with file and line for circular definitions, reserved names, and wrong values.
  explicit Parameters(const SceneNode *table);

  std::optional<Quantity>         find(const std::string &name) const;
  const std::vector<std::string> &names() const;

  /// Value of a number or an expression; the dimension of a plain number is unknown.
  Quantity evaluate(const SceneNode &value) const;
  /// The same including `variables`; `kind` as for parse_expression().
  Expression expression(const SceneNode &value, const std::vector<Variable> &variables,
                        const Kind *kind = nullptr) const;

  /// Rejects an overridden parameter (`--set`) on which no value read so far depends: a typing error would otherwise be
  /// ignored silently.
  /// @throws std::invalid_argument with the most similar name
  void refuse_idle_overrides() const;

private:
  struct Table; ///< the entries by name
  Quantity evaluate_entry(const Table &table, const std::string &name, std::vector<std::string> &open);
  void     use(const std::string &name) const;

  std::map<std::string, Quantity>              values_;
  std::vector<std::string>                     names_;     ///< of these, in the same order
  std::map<std::string, std::set<std::string>> needs_;     ///< other parameters on which a parameter depends
  std::map<std::string, Place>                 overrides_; ///< from the command line
  mutable std::set<std::string>                used_;      ///< by values outside the table, with their dependencies
};

} // namespace gestell::apps
