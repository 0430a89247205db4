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

/// A parameter is given another value, and no value of the scene depends on it.
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
  /// @throws std::invalid_argument with file and line for circles, names that mean something else, and wrong values.
  explicit Parameters(const SceneNode *table);

  std::optional<Quantity>         find(const std::string &name) const;
  const std::vector<std::string> &names() const;

  /// A number or an expression; what a plain number measures is not known.
  Quantity evaluate(const SceneNode &value) const;
  /// The same of `variables` as well; `kind` as of parse_expression().
  Expression expression(const SceneNode &value, const std::vector<Variable> &variables,
                        const Kind *kind = nullptr) const;

  /// Refuses a parameter of the command line (`--set`) that no value read so far depends on: a slip of the pen would
  /// else change nothing without a word.
  /// @throws std::invalid_argument with the nearest name
  void refuse_idle_overrides() const;

private:
  struct Table; ///< the entries by name
  Quantity evaluate_entry(const Table &table, const std::string &name, std::vector<std::string> &open);
  void     use(const std::string &name) const;

  std::map<std::string, Quantity>              values_;
  std::vector<std::string>                     names_;     ///< of these, in the same order
  std::map<std::string, std::set<std::string>> needs_;     ///< of a parameter, others
  std::map<std::string, Place>                 overrides_; ///< those of the command line
  mutable std::set<std::string>                used_;      ///< by values outside the table, and what those need
};

} // namespace gestell::apps
