#include "apps/study/runs/scene_variants.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/extending_scene.h"
#include "apps/scene/file/scene_override.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gestell::apps
{
namespace
{

/// The value as an entry of the scene: a number, a truth or text.
SceneNode value_node(const VariableRequest &request, double level)
{
  if (!request.choices.empty())
    return request.choices.at(std::size_t(std::lround(level)));
  SceneNode node;
  node.place.file = request.place;
  node.folder     = request.folder;
  node.text       = request.files.empty() ? request.text(level) : request.file(level);
  node.type       = SceneNode::Type::text;
  if (node.text == "true" || node.text == "false")
  {
    node.type    = SceneNode::Type::boolean;
    node.boolean = node.text == "true";
  }
  else if (request.variable.words.empty() && request.variable.unit.empty() && request.files.empty())
  {
    const bool whole = level == std::nearbyint(level) && std::abs(level) < 1e15;
    node.type        = whole ? SceneNode::Type::integer : SceneNode::Type::real;
    node.number      = level;
  }
  return node;
}

/// Entries of the scene with their values; those of [parameters] one by one, for the others stay.
std::vector<SceneNode::Entry> settings_of(const StudyFile &study)
{
  std::vector<SceneNode::Entry> settings;
  for (const auto &[key, value] : study.settings)
    if (key == "parameters" && value.type == SceneNode::Type::table)
      for (const auto &[name, parameter] : value.entries)
        settings.emplace_back("parameters." + name, parameter);
    else
      settings.emplace_back(key, value);
  return settings;
}

} // namespace

SceneVariants::SceneVariants(const StudyFile &study, fem::Scripts scripts)
    : study_(study), scene_(Variant::of_file(study.scene, {}, scripts))
{
  for (const auto &[key, value] : settings_of(study))
    set(key, value);
  for (const std::string &text : study.overrides)
  {
    const auto [key, value] = parsed_override(text);
    set(key, value);
  }
  for (const VariableRequest &request : study.variables)
    for (const std::string &key : request.keys)
      check_key(request, key);
  for (const RunParameter &measure : study.measures)
    check_measure(measure);
}

void SceneVariants::set(const std::string &key, const SceneNode &value)
{
  apply_override(scene_.root, key, value);
  add_change(settings_, key, value);
}

/// It has a first guess, and no variable takes its place.
void SceneVariants::check_measure(const RunParameter &measure) const
{
  const auto names = names_in(root().find("parameters"));
  if (std::find(names.begin(), names.end(), measure.parameter) == names.end())
    measure.place.fail("scene.measure." + measure.parameter + ": " + study_.scene +
                       " has no such parameter, whose value is the first guess" + suggestion(measure.parameter, names));
  for (const VariableRequest &request : study_.variables)
    for (const std::string &key : request.keys)
      if (key == "parameters." + measure.parameter)
        measure.place.fail("scene.measure." + measure.parameter + ": is varied by variable " + request.variable.name +
                           "; remove one of the two");
}

void SceneVariants::check_key(const VariableRequest &request, const std::string &key) const
{
  const auto       path = key_segments(key, {request.place, 0});
  const SceneNode *node = &root();
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const SceneNode *next = node->find(path[i]);
    const bool       leaf = i + 1 == path.size();
    if (next && leaf && next->type == SceneNode::Type::table && request.choices.empty())
      throw std::invalid_argument(request.place + ": '" + key + "' is a table of the scene (" + next->place.text() +
                                  "); name one of its keys: " + listed(names_in(next)));
    if (!next && leaf && i > 0 && path.front() != "parameters")
      return; // an entry that may be left out: its reader knows it
    if (!next)
      throw std::invalid_argument(request.place + ": " + study_.scene + " has no " +
                                  (path.front() == "parameters" && i > 0 ? "parameter '" : "key '") + path[i] + "'" +
                                  (i > 0 ? " in " + path[i - 1] : "") + suggestion(path[i], names_in(node)));
    node = next;
  }
}

void SceneVariants::set_measured(const RunParameter &measure, double value, const std::string &unit)
{
  SceneNode node;
  node.place = measure.place;
  node.type  = SceneNode::Type::text;
  node.text  = exact_text(value) + (unit.empty() ? "" : ' ' + unit);
  set("parameters." + measure.parameter, node);
}

double SceneVariants::measured(const RunParameter &measure, const Eigen::VectorXd &levels) const
{
  return parameters_at(levels).find(measure.parameter)->value;
}

Variant SceneVariants::at(const Eigen::VectorXd &levels) const
{
  Variant variant = scene_;
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
    for (const std::string &key : study_.variables[i].keys)
      apply_override(variant.root, key, value_node(study_.variables[i], levels[Eigen::Index(i)]));
  for (const auto &[key, value] : changes_at(levels))
    variant.changes.push_back(key + '=' + portable_value(value));
  return variant;
}

Parameters SceneVariants::parameters_at(const Eigen::VectorXd &levels) const
{
  return Parameters(at(levels).root.find("parameters"));
}

std::vector<SceneNode::Entry> SceneVariants::changes_at(const Eigen::VectorXd &levels) const
{
  std::vector<SceneNode::Entry> changes = settings_;
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
    for (const std::string &key : study_.variables[i].keys)
      add_change(changes, key, value_node(study_.variables[i], levels[Eigen::Index(i)]));
  return changes;
}

Eigen::VectorXd SceneVariants::middle() const
{
  Eigen::VectorXd levels(study_.variables.size());
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
  {
    const StudyVariable &variable = study_.variables[i].variable;
    levels[Eigen::Index(i)]       = variable.stepped ? variable.from : variable.centre();
  }
  return levels;
}

void SceneVariants::check_ranges(const Eigen::MatrixXd &levels) const
{
  const auto tried = [&](const Eigen::VectorXd &point, const std::string &what)
  {
    try
    {
      const Scene scene = at(point).scene();
      require_run(scene);
      check_scene(scene);
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(what + " the scene does not accept: " + error.what());
    }
  };
  tried(middle(), study_.scene_place + ": all variables in the middle of their ranges");
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
  {
    const VariableRequest &request = study_.variables[i];
    const auto             column  = levels.col(Eigen::Index(i));
    std::set<double>       some(request.variable.levels.begin(), request.variable.levels.end());
    some.insert({request.variable.from, request.variable.to, column.minCoeff(), column.maxCoeff()});
    for (const double level : some)
    {
      Eigen::VectorXd point  = middle();
      point[Eigen::Index(i)] = level;
      tried(point, request.place + ": " + request.text(level) + " of variable " + request.variable.name);
    }
  }
}

} // namespace gestell::apps
