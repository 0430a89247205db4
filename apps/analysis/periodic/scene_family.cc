#include "apps/analysis/periodic/scene_family.h"

#include "apps/scene/file/scene_override.h"
#include "apps/session/repeating_machine.h"
#include "coupling/frame/number_in_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Splits a number from its unit.
double split(const std::string &option, const std::string &text, std::string &unit)
{
  double            value = 0.;
  const char *const end   = coupling::read_number(text.c_str(), value);
  if (end == text.c_str())
    throw std::invalid_argument(option + " " + text + ": needs a number, with its unit if it has one: \"800 1/min\"");
  unit = end;
  unit.erase(0, unit.find_first_not_of(' ') == std::string::npos ? unit.size() : unit.find_first_not_of(' '));
  return value;
}

/// Lowest frequency of the loads on the frame and on bodies [rad/s]; infinite if none oscillates.
double lowest_frequency(const Scene &scene)
{
  double lowest = std::numeric_limits<double>::infinity();
  for (const LoadRequest &load : scene.loads)
    for (const auto &oscillation : load.oscillations)
      lowest = std::min(lowest, std::abs(oscillation.omega));
  return lowest;
}

/// Tables of a scene that do not affect the motion, with their contents.
const std::map<std::string, std::string> &without_effect()
{
  static const std::map<std::string, std::string> tables = {{"name", "the name of the scene"},
                                                            {"description", "the description of the scene"},
                                                            {"extends", "the scene that this scene extends"},
                                                            {"run", "the integration and the duration of a run"},
                                                            {"start", "the initial state of the search"},
                                                            {"modes", "the listed modes and their configuration"},
                                                            {"output", "the requested results"},
                                                            {"reduction", "the reduction of the frame"}};
  return tables;
}

/// The first part of a key: "run" of "run.step".
std::string table_of(const std::string &key)
{
  std::string table = key.substr(0, key.find('.'));
  table.erase(std::remove_if(table.begin(), table.end(), [](char c) { return c == ' ' || c == '"' || c == '\''; }),
              table.end());
  return table;
}

void require_effect(const std::string &key)
{
  const auto found = without_effect().find(table_of(key));
  if (found == without_effect().end())
    return;
  throw std::invalid_argument("--along " + key + ": this key sets " + found->second +
                              ", which does not change the equations of motion; choose a parameter (parameters.NAME), "
                              "or a number of an element, a load, a drive or a body, such as element.NAME.stiffness");
}

} // namespace

void require_parameter(const Variant &file, const std::string &key)
{
  require_effect(key);
  const std::string table = "parameters.";
  if (key.compare(0, table.size(), table) != 0)
    return;
  const std::string name = key.substr(table.size());
  const auto        all  = names_in(file.root.find("parameters"));
  if (std::find(all.begin(), all.end(), name) != all.end())
    return;
  throw std::invalid_argument("--along " + key + ": " + file.path + " has no parameter '" + name + "'" +
                              suggestion(name, all));
}

SceneFamily::SceneFamily(Variant file, PreparedMachine &machine, const PeriodicRequest &request,
                         const coupling::PeriodicProblem &like)
    : file_(std::move(file)), key_(request.along), request_(request), like_(like)
{
  if (request.from.empty() || request.to.empty())
    throw std::invalid_argument("--along " + key_ + ": --from and --to are missing");
  std::string other;
  from_ = split("--from", request.from, unit_);
  to_   = split("--to", request.to, other);
  if (unit_.empty())
    unit_ = other;
  if (!other.empty() && other != unit_)
    throw std::invalid_argument("--from " + request.from + " and --to " + request.to + ": use the same unit in both");
  if (from_ == to_)
    throw std::invalid_argument("--from and --to are both " + request.from + "; the range is empty");
  const Scene first = scene_at(from_), last = last_scene();
  if (!on_reduced_frame(first))
    return;
  if (!same_frame(first, last))
    throw std::invalid_argument(
        "--along " + key_ +
        ": this key changes the frame, which would have to be meshed and reduced again for each of about 100 values; "
        "choose a key of the mechanism, or compute single values with --set " +
        key_ + "=...");
  frame_ = std::make_shared<coupling::ReducedFrame>(without_pictures(*machine.machine.model().reduced_frame()));
}

Scene SceneFamily::scene_at(double value) const
{
  std::string text;
  append_exact(text, value);
  return file_.with(key_ + '=' + (unit_.empty() ? text : '"' + text + ' ' + unit_ + '"')).scene();
}

Scene SceneFamily::last_scene() const
{
  try
  {
    return scene_at(to_);
  }
  catch (const std::invalid_argument &)
  {
    const std::string why = standstill(from_, to_);
    if (why.empty())
      throw;
    throw std::invalid_argument("--to " + request_.to + ": " + why +
                                ", where the load no longer oscillates; end the branch before this value");
  }
}

std::string SceneFamily::standstill(double within, double beyond) const
{
  const double range = std::abs(beyond - within);
  const double first = lowest_frequency(scene_at(within));
  double       last  = first;
  bool         ends  = false;
  const auto   probe = [&](double value)
  {
    try
    {
      last   = lowest_frequency(scene_at(value));
      within = value;
    }
    catch (const std::invalid_argument &)
    {
      beyond = value;
      ends   = true;
    }
  };
  probe(beyond);
  constexpr int halvings = 50; // from the range to its rounding, 2^-50 = 1e-15
  for (int k = 0; ends && k < halvings; ++k)
    probe(0.5 * (within + beyond));
  constexpr double zero_frequency = 1e-9; // frequency of a load that counts as zero, of that where the search begins
  if (!ends || !(last < zero_frequency * first))
    return {};
  const double where = std::abs(beyond) < zero_frequency * range ? 0. : beyond;
  return "the period becomes infinite at " + key_ + " = " + short_text(where) + (unit_.empty() ? "" : ' ' + unit_);
}

std::shared_ptr<MachineMember> SceneFamily::member(double value) const
{
  auto member = std::make_shared<MachineMember>(MachineMember{prepared_scene(scene_at(value), frame_.get()), like_});
  member->problem.system = &member->prepared->machine;
  if (!like_.period_is_unknown() && request_.period.empty())
    member->problem.period = like_.ratio * load_period(*member->scene, member->prepared->machine);
  return member;
}

coupling::ProblemFamily SceneFamily::problems() const
{
  return [this](double value)
  {
    std::shared_ptr<MachineMember> found = member(value);
    return coupling::FamilyMember{found->problem, found};
  };
}

} // namespace gestell::apps
