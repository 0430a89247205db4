#include "apps/verify/read_cases.h"

#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_table.h"

#include <algorithm>
#include <filesystem>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

std::map<std::string, std::string> cells(const SceneTable &table, const std::string &key)
{
  std::map<std::string, std::string> cells;
  if (table.has(key))
  {
    const SceneTable chosen = table.table(key);
    for (const std::string &column : chosen.keys())
      cells[column] = chosen.text(column);
  }
  return cells;
}

std::vector<std::pair<std::string, std::string>> pairs(const SceneTable &table, const std::string &key)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  if (table.has(key))
  {
    const SceneTable chosen = table.table(key);
    for (const std::string &name : chosen.keys())
      pairs.emplace_back(name, chosen.text(name));
  }
  return pairs;
}

std::map<std::string, std::map<std::string, std::string>> words(const SceneTable &table)
{
  std::map<std::string, std::map<std::string, std::string>> words;
  if (table.has("words"))
  {
    const SceneTable columns = table.table("words");
    for (const std::string &column : columns.keys())
      words[column] = cells(columns, column);
  }
  return words;
}

Expectation read_expectation(const SceneTable &check, const SceneNode &node)
{
  Expectation expected;
  if (check.is_table("expected"))
  {
    const SceneTable table = check.table("expected");
    expected.table         = {table.file("file"), cells(table, "rows")};
    expected.column        = table.text("column", "");
    return expected;
  }
  const SceneNode *value = node.find("expected");
  if (!check.has("expected") || value->text.empty())
    throw check.error("expected",
                      "is missing: a number, a formula such as \"sqrt(c/m)\", or { file = \"x.csv\", rows = "
                      "{ case = \"a\" }, column = \"x\" }");
  expected.formula = value->text;
  return expected;
}

void require_something(const SceneTable &table, const Check &check)
{
  if (check.value.empty() == check.table.empty())
    throw table.error("needs either 'value', an entry of the answer such as \"signals.F.max\", or 'table', a file of "
                      "results such as \"history.csv\" with 'columns'");
  if (!check.table.empty() && check.columns.empty())
    throw table.error(
        "columns",
        "is missing: the columns of " + check.table +
            " that are compared, and the corresponding columns of the expected table, { \"x [m]\" = \"x\" }");
  for (const auto &[column, translated] : check.words)
    if (std::none_of(check.columns.begin(), check.columns.end(), [&](const auto &own) { return own.first == column; }))
      throw table.error("words",
                        "names a column '" + column + "' that is not compared; 'columns' names those that are");
  if (check.table.empty() != (check.expected.formula.empty() == false || !check.expected.column.empty()))
    throw table.error("expected", check.table.empty() ? "needs one number: a formula, or a 'column' of a table"
                                                      : "needs rows of a table for rows of " + check.table);
  if (check.because.empty())
    throw table.error("because", "is missing: where the tolerance comes from");
  if (check.source.empty())
    throw table.error("source", "is missing: where the expected value comes from, such as \"closed form\"");
}

Bound bound_of(const SceneTable &table)
{
  const std::string word = table.choice("bound", {"none", "least", "most"}, "none");
  return word == "none" ? Bound::none : word == "least" ? Bound::least : Bound::most;
}

Check read_check(const SceneTable &table, const SceneNode &node, const Check &usual)
{
  Check check;
  check.place    = table.place();
  check.value    = table.text("value", "");
  check.table    = table.text("table", "");
  check.rows     = cells(table, "rows");
  check.columns  = pairs(table, "columns");
  check.words    = words(table);
  check.at       = pairs(table, "at");
  check.expected = read_expectation(table, node);
  check.relative = table.not_negative("relative", kind::number, 0.);
  check.absolute = table.not_negative("absolute", kind::number, 0.);
  check.each     = table.choice("relative_to", {"largest", "each"}, "largest") == "each";
  check.bound    = bound_of(table);
  check.order    = table.not_negative("order", kind::number, 0.);
  check.because  = table.text("because", usual.because);
  check.source   = table.text("source", usual.source);
  check.plus     = table.text("plus", "");
  check.name     = table.text("name", check.value.empty() ? check.table : check.value);
  require_something(table, check);
  return check;
}

coupling::MethodOptions read_method(const SceneTable &table)
{
  coupling::MethodOptions options;
  options.method = table.text("method");
  options.order  = table.integer("order", 2);
  for (const std::string &key : table.keys())
    if (key != "method" && key != "order")
      options.set(key, table.number(key, kind::number));
  return options;
}

void read_refinements(const SceneTable &table, ReferenceCase &one)
{
  if (!table.has("refine"))
    return;
  const SceneTable refine = table.table("refine");
  one.refined             = refine.text("key");
  one.refinements         = refine.texts("values");
  if (one.refinements.size() < 2)
    throw refine.error("values", "needs two or more values, such as [\"2 ms\", \"1 ms\"]");
}

void read_checks(const SceneTable &table, const SceneNode &node, ReferenceCase &one)
{
  Check usual;
  usual.source      = table.text("source", "");
  usual.because     = table.text("because", "");
  const auto checks = table.table_array("check");
  for (std::size_t i = 0; i < checks.size(); ++i)
  {
    one.checks.push_back(read_check(checks[i], node.find("check")->elements[i], usual));
    if (one.checks.back().order > 0. && one.refined.empty())
      throw checks[i].error(
          "order", "needs 'refine' in its case, such as { key = \"run.step\", values = [\"2 ms\", \"1 ms\"] }");
  }
  if (one.checks.empty())
    throw table.error("needs [[" + table.path() + ".check]]: the expected result");
}

ReferenceCase read_case(const SceneTable &table, const SceneNode &node)
{
  ReferenceCase one;
  one.name     = table.name();
  one.place    = table.place();
  one.states   = table.text("states");
  one.equation = table.text("equation", "");
  one.compute  = table.choice("compute", computations(), "run");
  one.is_long  = table.boolean("long", false);
  if (one.compute != "integrators")
    one.scene = table.file("scene");
  if (table.has("set"))
    one.set = table.texts("set");
  one.requested = pairs(table, "with");
  if (table.has("methods"))
    for (const SceneTable &method : table.tables("methods"))
      one.methods[method.name()] = read_method(method);
  one.methods_left_out = pairs(table, "methods_left_out");
  read_refinements(table, one);
  read_checks(table, node, one);
  return one;
}

std::vector<std::pair<std::string, std::string>> read_left_out(const SceneTable &table)
{
  return pairs(table, "not_covered");
}

} // namespace

CaseFile read_cases(const std::string &path)
{
  const SceneNode  root = read_scene_file(path, {});
  const Parameters none;
  const SceneTable table(root, none, "");
  CaseFile         file;
  file.path  = path;
  file.title = table.text("title", fs::path(path).stem().string());
  file.lead  = table.text("lead", "");
  for (const SceneTable &one : table.tables("case"))
    file.cases.push_back(read_case(one, *root.find("case")->find(one.name())));
  file.left_out = read_left_out(table);
  if (file.cases.empty())
    throw table.error("needs cases, [case.NAME] with 'states', 'scene' and [[case.NAME.check]]");
  table.finish();
  return file;
}

std::vector<std::string> case_files(const std::string &folder)
{
  std::vector<std::string> files;
  for (const auto &entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw std::invalid_argument(folder + ": contains no case file (.toml)");
  return files;
}

std::string shipped_cases()
{
  std::error_code ignored;
  const fs::path  program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path  folder  = program.parent_path().parent_path() / "share/gestell/verification";
  if (!fs::is_directory(folder, ignored))
    throw std::invalid_argument(
        folder.string() +
        ": the shipped cases are missing; repair the installation, or name a case file, gestell verify cases.toml");
  return fs::canonical(folder).string();
}

} // namespace gestell::apps
