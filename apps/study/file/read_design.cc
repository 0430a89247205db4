#include "apps/study/file/read_design.h"

#include "apps/scene/file/scene_table.h"
#include "apps/study/file/study_keys.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace gestell::apps
{
namespace
{

int whole_or(const SceneTable &table, const std::string &key, int otherwise)
{
  return table.has(key) ? table.whole(key) : otherwise;
}

/// Number of each column among the variables.
std::vector<int> columns_of(const StudyFile &study, const SceneTable &table)
{
  std::vector<std::string> names;
  for (const VariableRequest &request : study.variables)
    names.push_back(request.variable.name);
  std::vector<int> columns;
  for (const std::string &name : table.has("columns") ? table.texts("columns") : names)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw table.error("columns", "there is no variable '" + name + "'" + suggestion(name, names));
    if (std::find(columns.begin(), columns.end(), int(found - names.begin())) != columns.end())
      throw table.error("columns", "'" + name + "' is a duplicate");
    columns.push_back(int(found - names.begin()));
  }
  return columns;
}

using Row = std::vector<double>;

/// The rows as they stand, in the variables that are columns.
std::vector<Row> given_rows(const StudyFile &study, const SceneTable &table, const SceneNode &node,
                            const std::vector<int> &columns)
{
  const SceneNode *rows = table.has("rows") ? node.find("rows") : nullptr;
  if (!rows || rows->type != SceneNode::Type::array || rows->elements.empty())
    throw table.error("rows", "needs an array of rows, one a run, with a value of each column in it");
  std::vector<Row> list;
  for (const SceneNode &given : rows->elements)
  {
    if (given.type != SceneNode::Type::array || given.elements.size() != columns.size())
      given.place.fail(
          "design.rows: row " + std::to_string(list.size() + 1) + " needs " + std::to_string(columns.size()) +
          " values, one of each column, got " +
          (given.type == SceneNode::Type::array ? std::to_string(given.elements.size()) : described(given)));
    Row row(study.variables.size(), 0.);
    for (std::size_t j = 0; j < columns.size(); ++j)
      row[columns[j]] = study.variables[columns[j]].level(given.elements[j]);
    list.push_back(row);
  }
  return list;
}

/// Each row for each level of the variable, the level fastest.
std::vector<Row> crossed(const std::vector<Row> &rows, std::size_t variable, const Row &levels)
{
  std::vector<Row> all;
  for (Row row : rows)
    for (const double level : levels)
    {
      row[variable] = level;
      all.push_back(row);
    }
  return all;
}

Eigen::MatrixXd read_list(const StudyFile &study, const SceneTable &table, const SceneNode &node)
{
  const std::vector<int> columns = columns_of(study, table);
  std::vector<Row>       rows    = given_rows(study, table, node, columns);
  for (std::size_t i = 0; i < study.variables.size(); ++i)
  {
    if (std::find(columns.begin(), columns.end(), int(i)) != columns.end())
      continue;
    const StudyVariable &variable = study.variables[i].variable;
    if (variable.levels.empty())
      throw table.error("columns", "lacks variable " + variable.name +
                                       ", which has no levels; add it, with its "
                                       "value in each row, or give it levels for which the rows are repeated");
    if (const double runs = double(rows.size()) * double(variable.levels.size()); runs > most_runs)
      throw table.error("rows", "makes more than a million runs, crossed with the levels of " + variable.name +
                                    " and those before it; use fewer rows or levels");
    rows = crossed(rows, i, variable.levels);
  }
  Eigen::MatrixXd list(rows.size(), study.variables.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    list.row(i) = Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), list.cols());
  return list;
}

void refuse_steps(const StudyFile &study, const SceneTable &table, const std::string &type)
{
  for (const VariableRequest &request : study.variables)
    if (request.variable.stepped && type != "list" && type != "full factorial")
      throw table.error("type", "\"" + type + "\" takes values between the levels of a variable, but those of " +
                                    request.variable.name + " are " + (request.files.empty() ? "words" : "files") +
                                    "; use \"full factorial\" or \"list\"");
}

/// Keys that only some types take.
void refuse_others(const SceneTable &table, const std::string &type)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> owners = {
      {"runs", {"Latin hypercube", "Sobol"}},
      {"seed", {"Latin hypercube", "Sobol"}},
      {"levels", {"full factorial"}},
      {"star", {"central composite"}},
      {"alpha", {"central composite"}},
      {"centre_points", {"central composite", "Box-Behnken"}},
      {"columns", {"list"}},
      {"rows", {"list"}}};
  for (const auto &[key, types] : owners)
    if (table.has(key) && std::find(types.begin(), types.end(), type) == types.end())
      throw table.error(key, "is a key of " + listed(types) + ", but the type is '" + type + "'; remove it");
}

/// Coded values and back leave an error in the last digits of the larger end of a range: 0.1 of -1 to 1 has 14
/// decimals.
double rounded_level(double level, const StudyVariable &variable)
{
  constexpr int digits   = 14; // of 16, so that sums of steps are written as they are meant
  const double  largest  = std::max(std::abs(variable.from), std::abs(variable.to));
  const int     decimals = digits - int(std::ceil(std::log10(largest)));
  if (decimals < 0 || decimals > 300)
    return level;
  char text[700];
  std::snprintf(text, sizeof text, "%.*f", decimals, level);
  return std::strtod(text, nullptr) + 0.; // no -0
}

Eigen::MatrixXd rounded_levels(const Eigen::MatrixXd &points, const std::vector<StudyVariable> &variables)
{
  Eigen::MatrixXd levels = physical_points(points, variables);
  for (Eigen::Index j = 0; j < levels.cols(); ++j)
    levels.col(j) = levels.col(j).unaryExpr([&](double x) { return rounded_level(x, variables[std::size_t(j)]); });
  return levels;
}

} // namespace

StudyPoints read_design(const StudyFile &study)
{
  const SceneNode *node = study.root.find("design");
  if (!node)
    study.root.place.fail("needs a table [design] with 'type', one of " + listed(design_types()));
  const Parameters none;
  const SceneTable table = SceneTable(*node, none, "design").declared(study_design_keys());
  DesignRequest    request;
  request.type = table.choice("type");
  refuse_others(table, request.type);
  refuse_steps(study, table, request.type);
  request.runs          = whole_or(table, "runs", 0);
  request.levels        = whole_or(table, "levels", 0);
  request.centre_points = whole_or(table, "centre_points", 0);
  if (table.has("star"))
    request.star = table.choice("star");
  if (table.has("alpha"))
    request.alpha = table.value("alpha");
  request.seed = std::uint64_t(std::max(0, whole_or(table, "seed", 0)));
  if (request.type == "list")
    request.list = read_list(study, table, *node);
  table.finish();
  try
  {
    const auto variables = study.values();
    Design     design    = make_design(request, variables);
    if (design.n_runs() > most_runs)
      throw table.error("asks for " + std::to_string(design.n_runs()) + " runs; the limit is a million");
    const Eigen::MatrixXd levels = request.list.size() > 0 ? request.list : rounded_levels(design.points, variables);
    return {design, levels};
  }
  catch (const std::invalid_argument &error)
  {
    throw table.error(error.what());
  }
}

} // namespace gestell::apps
