#pragma once

#include "apps/study/runs/rows_file.h"
#include "apps/study/runs/study_runner.h"

#include <functional>

namespace gestell::apps
{

/// What a run without an output that the study names says of the study.
enum class FirstRun
{
  decides, ///< at the first order: that no run has it
  is_one_of_many
};

/// A run that is to be made.
struct RunOrder
{
  int             number = 0; ///< from 1
  Eigen::VectorXd levels{};
};

/// Takes a row as its run ends, in any order.
using TakeRow = std::function<void(const RunRow &row)>;

/**
 * Makes runs side by side, by so many processes; one makes them in this process.
 *
 * Each process takes the next run that no other has taken.  One that ends by a signal costs the row of its run, which
 * is marked as failed, and another takes its place.
 *
 * @param stop  ends all, what has not ended yet has no row
 * @throws std::invalid_argument where the first run decides and lacks an output
 */
void make_runs(StudyRunner &runner, const RowsText &text, const std::vector<RunOrder> &orders, int jobs, FirstRun first,
               const std::atomic<bool> &stop, const TakeRow &take);

} // namespace gestell::apps
