#include "apps/analysis/frf/state_space_answer.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// The answer differentiated by time so often: of a signal of the position.
coupling::LinearAnswer differentiated(coupling::LinearAnswer answer, int derivatives)
{
  if (derivatives == 1)
    answer.v.swap(answer.q);
  if (derivatives == 2)
    answer.a.swap(answer.q);
  return answer;
}

/// Coordinates and their rates; if joints constrain them, numbers of free motions.
std::vector<std::string> state_names(const coupling::Machine &machine, const coupling::StateSpace &system)
{
  std::vector<std::string> names;
  for (const char *const rate : {"", "'"})
    for (Eigen::Index i = 0; i < system.Z.cols(); ++i)
      names.push_back((system.bound ? "free motion " + std::to_string(i + 1) : machine.coordinate_name(int(i))) + rate);
  return names;
}

std::string named(const std::string &name, const std::string &unit, int derivatives)
{
  const char *const per[] = {"", "/s", "/s^2"};
  return name + " [" + unit + per[derivatives] + "]";
}

} // namespace

StateSpaceModel state_space_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options)
{
  check_frf_options(options);
  coupling::Machine                  &machine = prepared.small();
  const auto                          point   = operating_point(scene, machine, options.at);
  const auto                          answers = named_answers(scene, machine, options, point);
  const auto                          forces  = named_forces(scene, machine, options, point);
  StateSpaceModel                     model;
  std::vector<coupling::LinearAnswer> outputs;
  for (std::size_t i = 0; i < answers.size(); ++i)
  {
    outputs.push_back(differentiated(answers[i].answer, answers[i].derivatives));
    model.outputs.push_back(named(options.to[i], answers[i].unit, answers[i].derivatives));
  }
  for (std::size_t j = 0; j < options.from.size(); ++j)
    model.inputs.push_back(named(options.from[j], forces.second[j] == "m" ? "N" : "N m", 0));
  try
  {
    model.system = coupling::state_space(coupling::LinearResponse(machine, point.point), forces.first, outputs);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(scene.file + ": state space: " + error.what());
  }
  model.scene  = scene.name;
  model.at     = options.at;
  model.t      = point.state.t;
  model.states = state_names(machine, model.system);
  for (int i = 0; i < machine.size(); ++i)
    model.coordinates.push_back(machine.coordinate_name(i));
  return model;
}

} // namespace gestell::apps
