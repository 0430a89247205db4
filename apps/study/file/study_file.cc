#include "apps/study/file/study_file.h"

#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_table.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/tokens.h"
#include "apps/study/file/study_keys.h"
#include "apps/study/file/variable_request.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

void read_range(const SceneNode &node, const SceneTable &table, StudyVariable &variable)
{
  if (!table.has("from") || !table.has("to"))
    throw table.error("needs 'from' and 'to', the ends of its range, or 'levels'");
  variable.from = in_unit(*node.find("from"), variable, "from");
  variable.to   = in_unit(*node.find("to"), variable, "to");
  if (!(variable.from < variable.to))
    throw table.error("to", "needs a value above 'from' = " + short_text(variable.from) + ", got " +
                                short_text(variable.to) + "; exchange them, or give 'levels'");
}

/// Words in the order in which they stand.
void read_words(const SceneNode &levels, VariableRequest &request)
{
  for (const SceneNode &level : levels.elements)
  {
    const std::string word = level.type == Type::boolean ? (level.boolean ? "true" : "false") : level.text;
    if (level.type != Type::boolean && level.type != Type::text)
      level.place.fail("variables." + request.variable.name + ".levels: mixes words and numbers; use either");
    if (std::find(request.variable.words.begin(), request.variable.words.end(), word) != request.variable.words.end())
      level.place.fail("variables." + request.variable.name + ".levels: '" + word + "' is a duplicate");
    request.variable.words.push_back(word);
    request.variable.levels.push_back(double(request.variable.words.size()) - 1.);
  }
  request.folder           = levels.folder;
  request.variable.stepped = true;
  request.variable.from    = 0.;
  request.variable.to      = double(request.variable.words.size()) - 1.;
}

/// { file = "walls_15.step", value = "15 mm" }, ...: values of which each is a file to the scene.
std::vector<double> read_files(const SceneNode &levels, VariableRequest &request)
{
  const std::string   place = "variables." + request.variable.name + ".levels: ";
  std::vector<double> values;
  for (const SceneNode &level : levels.elements)
  {
    const SceneNode *file = level.find("file"), *value = level.find("value");
    if (!file || file->type != Type::text || !value || level.entries.size() != 2)
      level.place.fail(place +
                       "needs a file with its value in each, { file = \"walls_15.step\", value = \"15 mm\" }, "
                       "got " +
                       described(level));
    values.push_back(in_unit(*value, request.variable, "levels"));
    for (const auto &[other, name] : request.files)
      if (other == values.back())
        value->place.fail(place + "'" + name + "' and '" + file->text + "' have the same value; give each its own");
    request.files.emplace_back(values.back(), file->text);
  }
  request.folder           = levels.folder;
  request.variable.stepped = true;
  return values;
}

void read_levels(const SceneNode &node, const SceneTable &table, VariableRequest &request)
{
  const SceneNode &levels = *node.find("levels");
  if (table.has("from") || table.has("to"))
    throw table.error("levels", "means the same as 'from' and 'to'; give only one of them");
  if (levels.type != Type::array || levels.elements.size() < 2)
    throw table.error("levels", "needs an array of two values or more, such as [\"800 kN/mm\", \"900 kN/mm\"], got " +
                                    described(levels));
  const bool files = levels.elements.front().type == Type::table;
  if (!files && !starts_with_number(levels.elements.front()))
    return read_words(levels, request);
  StudyVariable      &variable = request.variable;
  std::vector<double> values;
  if (files)
    values = read_files(levels, request);
  else
    for (const SceneNode &level : levels.elements)
      values.push_back(in_unit(level, variable, "levels"));
  try
  {
    variable = variable_of_levels(variable, values);
  }
  catch (const std::invalid_argument &error)
  {
    throw table.error("levels", error.what());
  }
}

void read_choices(const SceneNode &node, const SceneTable &table, VariableRequest &request)
{
  const SceneNode &choices = *node.find("choices");
  if (table.has("levels") || table.has("from") || table.has("to"))
    throw table.error("choices", "replace 'levels' or 'from' and 'to'; give only one of them");
  if (choices.type != Type::table || choices.entries.size() < 2)
    throw table.error("choices", "needs a table of two named values or more, got " + described(choices));
  for (const auto &[word, value] : choices.entries)
  {
    request.variable.words.push_back(word);
    request.choices.push_back(value);
    request.variable.levels.push_back(double(request.variable.words.size()) - 1.);
  }
  request.variable.stepped = true;
  request.variable.from    = 0.;
  request.variable.to      = double(request.variable.words.size()) - 1.;
}

void read_scatter(const SceneNode &node, const SceneTable &table, StudyVariable &variable)
{
  const std::string scatter = table.choice("scatter");
  variable.scatter = scatter == "none" ? Scatter::none : scatter == "uniform" ? Scatter::uniform : Scatter::normal;
  if (!table.has("width") && variable.scatter == Scatter::none)
    return;
  if (!table.has("width"))
    throw table.error("scatter", "needs 'width', the half width of a uniform scatter or the standard deviation of a "
                                 "normal one");
  if (variable.scatter == Scatter::none)
    throw table.error("width", "needs scatter = \"uniform\" or \"normal\"; add it, or remove this key");
  variable.width = in_unit(*node.find("width"), variable, "width");
  if (!(variable.width > 0.))
    throw table.error("width", "needs a number above 0, got " + short_text(variable.width));
}

/// [variables.NAME]
VariableRequest read_variable(const SceneNode &node, const SceneTable &given)
{
  const SceneTable table = given.declared(study_variable_keys());
  VariableRequest  request;
  StudyVariable   &variable = request.variable;
  variable.name             = given.name();
  request.keys = table.has("key") ? table.texts("key") : std::vector<std::string>{"parameters." + variable.name};
  variable.key = request.keys.front();
  variable.more_keys.assign(request.keys.begin() + 1, request.keys.end());
  variable.unit = table.text("unit", "");
  request.place = table.has("key") ? table.place("key") : table.place();
  if (table.has("choices"))
    read_choices(node, table, request);
  else if (table.has("levels"))
    read_levels(node, table, request);
  else
    read_range(node, table, variable);
  read_scatter(node, table, variable);
  return request;
}

using Type = SceneNode::Type;

/// Overrides whose key begins with a table that only studies have.
bool is_of_study(const std::string &override_text)
{
  const std::string                     table = override_text.substr(0, override_text.find_first_of(".= "));
  static const std::vector<std::string> tables{"variables", "outputs", "design", "surface",
                                               "optimise",  "choose",  "scene",  "keep"};
  return std::find(tables.begin(), tables.end(), table) != tables.end();
}

/// A name that heads a column and stands in formulas.
void check_name(const std::string &name, const SceneTable &table, std::vector<std::string> &names)
{
  static const std::vector<std::string> columns{"run", "status", "cpu_s"};
  if (!is_identifier(name) || is_reserved_name(name))
    throw table.error("'" + name +
                      "' is not a valid name for a column: it consists of letters, digits and underscores, does not "
                      "begin with a digit and is not a function of formulas; choose another name");
  if (std::find(columns.begin(), columns.end(), name) != columns.end())
    throw table.error("'" + name + "' is a column of runs.csv already; choose another name");
  if (std::find(names.begin(), names.end(), name) != names.end())
    throw table.error("'" + name + "' is the name of a variable and of an output; choose another one for one of them");
  names.push_back(name);
}

void read_measures(const SceneTable &table, const SceneNode &measures, StudyFile &study)
{
  if (measures.type != Type::table)
    throw table.error("measure",
                      "needs a table of parameters, { t_0 = \"events.limiter.first\" }, got " + described(measures));
  for (const auto &[parameter, entry] : measures.entries)
  {
    if (entry.type != Type::text)
      entry.place.fail("scene.measure." + parameter +
                       ": needs a result of a run, such as \"events.limiter.first\", got " + described(entry));
    study.measures.push_back({parameter, entry.text, entry.place});
  }
}

void read_scene_table(const SceneTable &root, const SceneNode &node, StudyFile &study)
{
  if (!root.has("scene"))
    throw root.error("needs a table [scene] with 'file', the scene that is varied");
  const SceneTable table = root.table("scene").declared(study_scene_keys());
  study.scene            = table.file("file");
  study.scene_place      = table.place("file");
  if (table.has("measure"))
    read_measures(table, *node.find("scene")->find("measure"), study);
  if (!table.has("set"))
    return;
  const SceneNode &set = *node.find("scene")->find("set");
  if (set.type != Type::table)
    throw table.error("set", "needs a table of scene keys, { \"run.step\" = \"5 us\" }, got " + described(set));
  study.settings = set.entries;
}

void read_variables(const SceneTable &root, const SceneNode &node, StudyFile &study, std::vector<std::string> &names)
{
  const auto tables = root.tables("variables");
  if (tables.empty())
    throw root.error("needs variables, such as [variables.c_P] with from = \"720 kN/mm\" and to = \"1080 kN/mm\"");
  for (const SceneTable &table : tables)
  {
    check_name(table.name(), table, names);
    study.variables.push_back(read_variable(*node.find("variables")->find(table.name()), table));
  }
  std::map<std::string, std::string> takers;
  for (const VariableRequest &request : study.variables)
    for (const std::string &key : request.keys)
      if (const auto [taker, is_new] = takers.emplace(key, request.variable.name); !is_new)
        throw std::invalid_argument(request.place + ": '" + key + "' takes the value of variable " + taker->second +
                                    " already; remove it in one of them");
  for (const auto &[inner, of_inner] : takers)
    for (const auto &[whole, of_whole] : takers)
      if (inner.compare(0, whole.size() + 1, whole + ".") == 0)
        throw root.error("'" + inner + "' of variable " + of_inner + " is a part of '" + whole + "' of variable " +
                         of_whole + ", which replaces it; let only one variable change it");
}

void read_outputs(const SceneTable &root, const SceneNode &node, StudyFile &study, std::vector<std::string> &names)
{
  if (!root.has("outputs"))
    throw root.error("needs a table [outputs], such as F = \"signals.F.max\"");
  const SceneTable table = root.table("outputs");
  for (const std::string &name : table.keys())
  {
    check_name(name, table, names);
    study.outputs.push_back({name, table.text(name), node.find("outputs")->find(name)->place});
  }
  if (study.outputs.empty())
    throw table.error("needs an output, such as F = \"signals.F.max\"");
}

} // namespace

std::vector<StudyVariable> StudyFile::values() const
{
  std::vector<StudyVariable> values;
  for (const VariableRequest &request : variables)
    values.push_back(request.variable);
  return values;
}

StudyFile read_study(const std::string &path, const std::vector<std::string> &overrides)
{
  std::vector<std::string> own;
  StudyFile                study;
  for (const std::string &text : overrides)
    (is_of_study(text) ? own : study.overrides).push_back(text);
  study.root = read_scene_file(path, own);
  study.path = path;
  const Parameters none;
  const SceneTable table = SceneTable(study.root, none, "").declared(study_keys());
  table.has("extends");
  for (const char *read_later : {"design", "surface", "optimise", "choose"})
    table.has(read_later);
  study.name        = table.text("name", std::filesystem::path(path).stem().string());
  study.description = table.text("description", "");
  study.keep        = table.truth("keep");
  if (study.name.find('/') != std::string::npos || study.name == "." || study.name == "..")
    throw table.error("name", "must not contain '/': it names the folder of the results");
  std::vector<std::string> names;
  read_scene_table(table, study.root, study);
  read_variables(table, study.root, study, names);
  read_outputs(table, study.root, study, names);
  table.finish();
  return study;
}

} // namespace gestell::apps
