#include "apps/session/sensitivity/output_gradients.h"

#include "apps/session/session.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
const SensitivityOutput &output_of(const SensitivityResult &found, const std::string &name)
{
  const auto output = std::find_if(found.outputs.begin(), found.outputs.end(),
                                   [&](const SensitivityOutput &one) { return one.output == name; });
  if (output != found.outputs.end())
    return *output;
  std::vector<std::string> names;
  for (const SensitivityOutput &one : found.outputs)
    names.push_back(one.output);
  throw std::invalid_argument("the run has no output \"" + name + "\" with a derivative" + suggestion(name, names));
}
} // namespace

OutputGradients output_gradients(const std::string &path, const std::vector<std::string> &overrides,
                                 const std::vector<std::string> &keys, const std::vector<std::string> &outputs,
                                 fem::Scripts scripts)
{
  std::string list;
  for (const std::string &key : keys)
    list += (list.empty() ? "" : ",") + key;
  if (list.empty())
    throw std::invalid_argument("gradients need at least one entry of the scene, such as parameters.c_P");
  Session      session(path, overrides, scripts);
  const Result result = session.run(list);
  if (!result.sensitivities)
    throw coupling::ConvergenceFailure(result.run->failure);
  if (!result.sensitivities->failure.empty())
    throw coupling::ConvergenceFailure(result.sensitivities->failure);
  OutputGradients found;
  found.gradients.resize(Eigen::Index(outputs.size()), Eigen::Index(keys.size()));
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const SensitivityOutput &output      = output_of(*result.sensitivities, outputs[i]);
    found.gradients.row(Eigen::Index(i)) = output.derivative.transpose();
    found.values.push_back(output.value);
  }
  return found;
}

} // namespace gestell::apps
