#include "apps/study/file/read_variable.h"

#include "apps/study/file/study_keys.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

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
      level.place.fail("variables." + request.variable.name + ".levels: mixes words and numbers; give one of both");
    if (std::find(request.variable.words.begin(), request.variable.words.end(), word) != request.variable.words.end())
      level.place.fail("variables." + request.variable.name + ".levels: '" + word + "' stands there twice");
    request.variable.words.push_back(word);
    request.variable.levels.push_back(double(request.variable.words.size()) - 1.);
  }
  request.folder        = levels.folder;
  request.variable.from = 0.;
  request.variable.to   = double(request.variable.words.size()) - 1.;
}

void read_levels(const SceneNode &node, const SceneTable &table, VariableRequest &request)
{
  const SceneNode &levels = *node.find("levels");
  if (table.has("from") || table.has("to"))
    throw table.error("levels", "says the same as 'from' and 'to'; give one of them");
  if (levels.type != Type::array || levels.elements.size() < 2)
    throw table.error("levels", "needs an array of two values or more, such as [\"800 kN/mm\", \"900 kN/mm\"], got " +
                                    described(levels));
  if (!starts_with_number(levels.elements.front()))
    return read_words(levels, request);
  StudyVariable      &variable = request.variable;
  std::vector<double> values;
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
    throw table.error("choices", "stand in place of 'levels' or 'from' and 'to'; give one of them");
  if (choices.type != Type::table || choices.entries.size() < 2)
    throw table.error("choices", "needs a table of two named values or more, got " + described(choices));
  for (const auto &[word, value] : choices.entries)
  {
    request.variable.words.push_back(word);
    request.choices.push_back(value);
    request.variable.levels.push_back(double(request.variable.words.size()) - 1.);
  }
  request.variable.from = 0.;
  request.variable.to   = double(request.variable.words.size()) - 1.;
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
    throw table.error("width", "goes with scatter = \"uniform\" or \"normal\"; give one of them, or leave it out");
  variable.width = in_unit(*node.find("width"), variable, "width");
  if (!(variable.width > 0.))
    throw table.error("width", "needs a number above 0, got " + short_text(variable.width));
}

} // namespace

VariableRequest read_variable(const SceneNode &node, const SceneTable &given)
{
  const SceneTable table = given.declared(study_variable_keys());
  VariableRequest  request;
  StudyVariable   &variable = request.variable;
  variable.name             = given.name();
  request.keys  = table.has("key") ? table.texts("key") : std::vector<std::string>{"parameters." + variable.name};
  variable.key  = request.keys.front();
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

} // namespace gestell::apps
