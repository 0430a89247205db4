#include "apps/study/runs/study_answer.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace gestell::apps
{
namespace
{

/// The row of a run in the table.
void enter(const RunRow &row, StudyTable &table)
{
  const Eigen::Index at  = row.run - 1;
  StudyRun          &run = table.runs[std::size_t(at)];
  run.status             = row.status;
  run.message            = row.message;
  run.cpu_s              = row.cpu_s;
  for (std::size_t i = 0; i < row.values.size(); ++i)
    table.values(at, Eigen::Index(i)) = row.values[i];
  for (std::size_t i = 0; i < row.units.size(); ++i)
    table.outputs[i].unit = row.units[i];
}

StudyTable empty_table(const StudyFile &study, const StudyPoints &points)
{
  std::vector<StudyOutput> outputs;
  for (const OutputRequest &output : study.outputs)
    outputs.push_back({output.name, ""});
  StudyTable table = waiting_table(points.design, study.values(), outputs);
  table.levels     = points.levels;
  return table;
}

/// Until the other shares have all their rows.
void wait_for(const StudyFolder &folder, int n_runs, const std::atomic<bool> &stop)
{
  while (!stop && int(folder.rows().size()) < n_runs)
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
}

} // namespace

int StudyAnswer::n_failed() const
{
  return int(std::count_if(table.runs.begin(), table.runs.end(),
                           [](const StudyRun &run) { return run.status == RunStatus::failed; }));
}

bool StudyAnswer::complete() const
{
  return std::all_of(table.runs.begin(), table.runs.end(),
                     [](const StudyRun &run) { return run.status != RunStatus::waiting; });
}

StudyAnswer make_study(const StudyFile &study, const StudyPoints &points, StudyRunner &runner, const StudyCall &call)
{
  StudyAnswer               answer{empty_table(study, points), points.design, 0, false};
  StudyTable               &table = answer.table;
  const RowsText            text(study);
  const StudyRecord         record = record_of(study, runner.variants(), table.n_runs());
  StudyFolder               folder(call.folder, record, text, table.levels);
  const std::vector<RunRow> there = folder.open(call.begin, call.share);
  for (const RunRow &row : there)
    enter(row, table);
  for (std::size_t i = 0; i < folder.units().size(); ++i)
    table.outputs.at(i).unit = folder.units()[i];
  if (call.learned && !folder.units().empty())
    call.learned(table.outputs);
  std::vector<RunOrder> orders;
  for (int run = 1; run <= table.n_runs(); ++run)
    if (call.share.has(run) && table.runs[std::size_t(run) - 1].status == RunStatus::waiting)
      orders.push_back({run, table.levels.row(run - 1).transpose()});
  {
    RowsFile   rows(folder.rows_file(call.share));
    const auto take = [&](const RunRow &row)
    {
      rows.append(text.head(folder.units().empty() ? row.units : folder.units()),
                  text.line(row, table.levels.row(row.run - 1).transpose()));
      enter(row, table);
      if (folder.units().empty() && !row.units.empty())
      {
        folder.keep_units(row.units);
        if (call.learned)
          call.learned(table.outputs);
      }
      ++answer.n_made;
      if (call.progress)
        call.progress(answer.n_made, int(orders.size()));
    };
    const FirstRun first = table.n_done() > 0 ? FirstRun::is_one_of_many : FirstRun::decides;
    try
    {
      make_runs(runner, text, orders, call.jobs, first, *call.stop, take);
    }
    catch (const std::invalid_argument &) // the study itself is wrong
    {
      if (there.empty() && table.n_done() == 0)
        std::filesystem::remove(folder.rows_file(call.share));
      throw;
    }
  }
  if (call.waits_for_shares)
    wait_for(folder, table.n_runs(), *call.stop);
  answer.interrupted = *call.stop;
  if (call.share.is_whole() || (call.waits_for_shares && !answer.interrupted))
  {
    const std::vector<RunRow> rows = folder.rows();
    folder.merge(rows);
    for (const RunRow &row : rows)
      enter(row, table);
  }
  return answer;
}

} // namespace gestell::apps
