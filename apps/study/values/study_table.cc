#include "apps/study/values/study_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

template <typename Named>
int index_of(const std::vector<Named> &all, const std::string &name, const std::string &kind)
{
  std::string names;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all[i].name == name)
      return static_cast<int>(i);
    names += (i ? ", " : "") + all[i].name;
  }
  throw std::invalid_argument("study: there is no " + kind + " " + name + "; there are " + names);
}

} // namespace

int StudyTable::n_done() const
{
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const StudyRun &run) { return run.status == RunStatus::done; }));
}

std::vector<int> StudyTable::runs_with(int output) const
{
  std::vector<int> rows;
  for (int run = 0; run < n_runs(); ++run)
    if (runs[run].status == RunStatus::done && std::isfinite(values(run, output)))
      rows.push_back(run);
  return rows;
}

std::vector<int> StudyTable::usable_runs() const
{
  std::vector<Eigen::Index> reported;
  for (std::size_t output = 0; output < outputs.size(); ++output)
    if (!runs_with(int(output)).empty())
      reported.push_back(Eigen::Index(output));
  std::vector<int> rows;
  for (int run = 0; run < n_runs(); ++run)
    if (runs[run].status == RunStatus::done && values(run, reported).allFinite())
      rows.push_back(run);
  return rows;
}

StudyTable StudyTable::usable() const
{
  const std::vector<int> rows = usable_runs();
  StudyTable             table;
  table.variables = variables;
  table.outputs   = outputs;
  table.levels    = levels(rows, Eigen::all);
  table.values    = values(rows, Eigen::all);
  for (const int run : rows)
    table.runs.push_back(runs[run]);
  return table;
}

int StudyTable::output_index(const std::string &name) const
{
  return index_of(outputs, name, "output");
}

int StudyTable::variable_index(const std::string &name) const
{
  return index_of(variables, name, "variable");
}

StudyTable waiting_table(const Design &design, const std::vector<StudyVariable> &variables,
                         const std::vector<StudyOutput> &outputs)
{
  StudyTable table;
  table.variables = variables;
  table.outputs   = outputs;
  table.levels    = physical_points(design.points, variables);
  table.values    = Eigen::MatrixXd::Constant(design.n_runs(), static_cast<Eigen::Index>(outputs.size()),
                                              std::numeric_limits<double>::quiet_NaN());
  table.runs.resize(design.n_runs());
  return table;
}

} // namespace gestell::apps
