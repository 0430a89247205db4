#include "apps/study/runs/run_derivatives.h"

#include "apps/output/values/sensitivity_result.h"
#include "apps/scene/language/parse_quantity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr double formula_step = 1e-6; ///< of the range of a variable, for quotients of formulas

/// SI per unit of the variable.
double factor_of(const StudyVariable &variable)
{
  if (variable.unit.empty())
    return 1.;
  return parse_quantity("1 " + variable.unit, [](const std::string &) { return std::optional<Quantity>(); }).value;
}

/// The name under which sensitivities tell an entry of the answer.
std::string told_name(const std::vector<std::string> &path)
{
  if (path.front() == "signals" && path.size() == 3)
    return path[1] + '.' + path[2];
  if (path.front() == "modes" && path.size() == 2)
    return path[0] + '.' + path[1];
  throw std::invalid_argument("there are no derivatives of " + path.front());
}

/// Of one entry by all keys.
Eigen::VectorXd entry_derivative(const std::vector<std::string> &path, const SensitivityResult &found)
{
  const std::string name = told_name(path);
  for (const SensitivityOutput &output : found.outputs)
    if (output.output == name && output.derivative.allFinite())
      return output.derivative;
  throw std::invalid_argument("the run tells no derivative of " + name);
}

} // namespace

std::string differentiated_keys(const std::vector<VariableRequest> &variables)
{
  std::string keys;
  for (const VariableRequest &request : variables)
  {
    if (request.keys.size() != 1 || !request.variable.words.empty())
      throw std::invalid_argument("variable " + request.variable.name + " has no derivatives");
    keys += (keys.empty() ? "" : ",") + request.keys.front();
  }
  return keys;
}

Eigen::MatrixXd output_derivatives(const OutputFormulas &outputs, const Result &result, const SceneVariants &variants,
                                   const std::vector<VariableRequest> &variables, const Eigen::VectorXd &levels)
{
  if (!result.sensitivities || !result.sensitivities->failure.empty())
    throw std::invalid_argument("the run has no derivatives" +
                                (result.sensitivities ? ": " + result.sensitivities->failure : std::string()));
  const auto                   entries = outputs.entries_of(result);
  std::vector<Eigen::VectorXd> by_key;
  for (const auto &path : outputs.paths())
    by_key.push_back(entry_derivative(path, *result.sensitivities));
  const auto values_beside = [&](Eigen::Index variable, double step)
  {
    Eigen::VectorXd nearby = levels;
    nearby[variable] += step;
    auto         moved = entries;
    const double in_si = step * factor_of(variables[std::size_t(variable)].variable);
    for (std::size_t e = 0; e < moved.size(); ++e)
      moved[e].value += by_key[e][variable] * in_si;
    const auto      values = outputs.values_of(moved, variants.parameters_at(nearby), nearby);
    Eigen::VectorXd column(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      column[Eigen::Index(i)] = values[i].value;
    return column;
  };
  Eigen::MatrixXd derivatives;
  for (Eigen::Index i = 0; i < levels.size(); ++i)
  {
    const double          step   = formula_step * variables[std::size_t(i)].variable.half_range();
    const Eigen::VectorXd column = (values_beside(i, step) - values_beside(i, -step)) / (2. * step);
    derivatives.conservativeResize(column.size(), levels.size());
    derivatives.col(i) = column;
  }
  return derivatives;
}

} // namespace gestell::apps
