#pragma once

#include "fem/parallel/ranks.h"

namespace gestell::coupling
{

/// Commands of rank 0, see fem::Ranks; 0 dismisses.
enum class RankTask
{
  prepare = 1,
  divide,
  forget_factor,
  factorise,
  release_factor,
  solve_divided,
  inertia,
  search,
  find,
  found,
  end_search
};

/**
 * The ranks of this run, controlled by rank 0.
 *
 * A task is a class with `static constexpr RankTask order` and a collective `void run(const fem::Ranks &)`.  Rank 0
 * creates one with its input and calls together(); obey() creates an empty one on every other rank and runs it there.
 */
class Team
{
public:
  /// nullptr in a run of one process.
  static const Team *of_this_run();
  /// Makes of_this_run() return the team, if there are other ranks; they must be in obey(), or enter it later.
  static void use();

  const fem::Ranks &ranks() const { return ranks_; }
  /// Number for the next object that all ranks store; starts at 1.
  static int next_number();

  /// @returns the task with its results.
  /// @throws std::invalid_argument, ConvergenceFailure: failures on which all ranks agree.  Others end the program.
  template <typename Task>
  Task together(Task task) const
  {
    ranks_.order(int(Task::order));
    try
    {
      carry_out(task, ranks_);
    }
    catch (const fem::AgreedFailure &failure)
    {
      report(failure);
    }
    return task;
  }

  /// Runs this rank's part of a collective task; a failure on which the ranks do not agree ends all ranks.
  template <typename Task>
  static void carry_out(Task &task, const fem::Ranks &ranks)
  {
    try
    {
      task.run(ranks);
    }
    catch (const fem::AgreedFailure &)
    {
      throw;
    }
    catch (const std::exception &error)
    {
      ranks.abort(error.what());
    }
  }

private:
  [[noreturn]] static void report(const fem::AgreedFailure &failure);

  fem::Ranks ranks_;
};

} // namespace gestell::coupling
