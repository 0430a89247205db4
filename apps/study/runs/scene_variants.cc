#include "apps/study/runs/scene_variants.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/written_text.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace gestell::apps
{
namespace
{

std::vector<std::string> names_in(const SceneNode &table)
{
  std::vector<std::string> names;
  for (const auto &entry : table.entries)
    names.push_back(entry.first);
  return names;
}

/// The value as an entry of the scene: a number, a truth or text.
SceneNode value_node(const VariableRequest &request, double level)
{
  if (!request.choices.empty())
    return request.choices.at(std::size_t(std::lround(level)));
  SceneNode node;
  node.place.file = request.place;
  node.folder     = request.folder;
  node.text       = request.text(level);
  node.type       = SceneNode::Type::text;
  if (node.text == "true" || node.text == "false")
  {
    node.type    = SceneNode::Type::boolean;
    node.boolean = node.text == "true";
  }
  else if (request.variable.words.empty() && request.variable.unit.empty())
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

/// A text that names a file from where it is written, by its whole path: it will be read from elsewhere.
std::string with_whole_path(const SceneNode &node)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path  path = (fs::path(node.folder) / node.text).lexically_normal();
  return !node.folder.empty() && fs::is_regular_file(path, none) ? fs::absolute(path).string() : node.text;
}

/// Sets an entry in place of an earlier one, or inside of a table that was set.
void change(std::vector<SceneNode::Entry> &changes, const std::string &key, const SceneNode &value)
{
  for (auto &[earlier, node] : changes)
    if (earlier == key)
    {
      node = value;
      return;
    }
    else if (node.type == SceneNode::Type::table && key.compare(0, earlier.size() + 1, earlier + '.') == 0)
      return apply_override(node, key.substr(earlier.size() + 1), value);
  changes.emplace_back(key, value);
}

} // namespace

std::string toml_value(const SceneNode &node)
{
  switch (node.type)
  {
  case SceneNode::Type::text:
    return written_text(with_whole_path(node));
  case SceneNode::Type::boolean:
    return node.boolean ? "true" : "false";
  case SceneNode::Type::array:
  {
    std::string text;
    for (const SceneNode &element : node.elements)
      text += (text.empty() ? "" : ", ") + toml_value(element);
    return '[' + text + ']';
  }
  case SceneNode::Type::table:
  {
    std::string text;
    for (const auto &[key, value] : node.entries)
      text += (text.empty() ? "" : ", ") + written_key(key) + " = " + toml_value(value);
    return "{ " + text + " }";
  }
  default:
    return node.text;
  }
}

SceneVariants::SceneVariants(const StudyFile &study, fem::Scripts scripts) : study_(study), scripts_(scripts)
{
  root_ = read_scene_file(study.scene, {});
  for (const auto &[key, value] : settings_of(study))
    apply_override(root_, key, value);
  for (const std::string &text : study.overrides)
    apply_override(root_, text);
  for (const VariableRequest &request : study.variables)
    for (const std::string &key : request.keys)
      check_key(request, key);
  for (const RunParameter &measure : study.measures)
    check_measure(measure);
}

/// It has a first guess, and no variable takes its place.
void SceneVariants::check_measure(const RunParameter &measure) const
{
  const SceneNode *parameters = root_.find("parameters");
  const auto       names      = parameters ? names_in(*parameters) : std::vector<std::string>();
  if (std::find(names.begin(), names.end(), measure.parameter) == names.end())
    measure.place.fail("scene.measure." + measure.parameter + ": " + study_.scene +
                       " has no such parameter, whose value would be the first guess" +
                       suggestion(measure.parameter, names));
  for (const VariableRequest &request : study_.variables)
    for (const std::string &key : request.keys)
      if (key == "parameters." + measure.parameter)
        measure.place.fail("scene.measure." + measure.parameter + ": is varied by variable " + request.variable.name +
                           "; leave one of both out");
}

void SceneVariants::check_key(const VariableRequest &request, const std::string &key) const
{
  const auto       path = key_segments(key, {request.place, 0});
  const SceneNode *node = &root_;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const SceneNode *next = node->find(path[i]);
    const bool       leaf = i + 1 == path.size();
    if (next && leaf && next->type == SceneNode::Type::table && request.choices.empty())
      throw std::invalid_argument(request.place + ": '" + key + "' is a table of the scene (" + next->place.text() +
                                  "); name one of its entries: " + listed(names_in(*next)));
    if (!next && leaf && i > 0 && path.front() != "parameters")
      return; // an entry that may be left out: its reader knows it
    if (!next)
      throw std::invalid_argument(request.place + ": " + study_.scene + " has no " +
                                  (path.front() == "parameters" && i > 0 ? "parameter '" : "entry '") + path[i] + "'" +
                                  (i > 0 ? " in " + path[i - 1] : "") + suggestion(path[i], names_in(*node)));
    node = next;
  }
}

void SceneVariants::set_measured(const RunParameter &measure, double value, const std::string &unit)
{
  const std::string key = "parameters." + measure.parameter;
  SceneNode         node;
  node.place = measure.place;
  node.type  = SceneNode::Type::text;
  node.text  = exact_text(value) + (unit.empty() ? "" : ' ' + unit);
  apply_override(root_, key, node);
  change(study_.settings, key, node);
}

double SceneVariants::measured(const RunParameter &measure, const Eigen::VectorXd &levels) const
{
  return parameters_at(levels).find(measure.parameter)->value;
}

SceneNode SceneVariants::node_at(const Eigen::VectorXd &levels) const
{
  SceneNode root = root_;
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
    for (const std::string &key : study_.variables[i].keys)
      apply_override(root, key, value_node(study_.variables[i], levels[Eigen::Index(i)]));
  return root;
}

Scene SceneVariants::at(const Eigen::VectorXd &levels) const
{
  return read_scene(node_at(levels), study_.scene, scripts_);
}

Parameters SceneVariants::parameters_at(const Eigen::VectorXd &levels) const
{
  const SceneNode root = node_at(levels);
  return Parameters(root.find("parameters"));
}

std::vector<SceneNode::Entry> SceneVariants::changes_at(const Eigen::VectorXd &levels) const
{
  std::vector<SceneNode::Entry> changes;
  for (const auto &[key, value] : settings_of(study_))
    change(changes, key, value);
  for (const std::string &text : study_.overrides)
  {
    const auto [key, value] = parsed_override(text);
    change(changes, key, value);
  }
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
    for (const std::string &key : study_.variables[i].keys)
      change(changes, key, value_node(study_.variables[i], levels[Eigen::Index(i)]));
  return changes;
}

std::vector<std::string> SceneVariants::overrides_at(const Eigen::VectorXd &levels) const
{
  std::vector<std::string> overrides;
  for (const auto &[key, value] : changes_at(levels))
    overrides.push_back(key + '=' + toml_value(value));
  return overrides;
}

Eigen::VectorXd SceneVariants::middle() const
{
  Eigen::VectorXd levels(study_.variables.size());
  for (std::size_t i = 0; i < study_.variables.size(); ++i)
    levels[Eigen::Index(i)] = study_.variables[i].variable.words.empty() ? study_.variables[i].variable.centre() : 0.;
  return levels;
}

void SceneVariants::check_ranges(const Eigen::MatrixXd &levels) const
{
  const auto tried = [&](const Eigen::VectorXd &point, const std::string &what)
  {
    try
    {
      const Scene scene = at(point);
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
