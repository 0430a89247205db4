#pragma once

#include "coupling/plugin/team_loader.h"

#include <string>

namespace gestell::apps
{

/**
 * The processes of mpirun for as long as it lives: rank 0 runs the program, the others serve it, and end with it.
 *
 * Nothing but a look into the environment where the program runs by itself.
 */
class MpiRun
{
public:
  /// @param words  of the command line: ranks that were called otherwise are no team
  /// @throws std::invalid_argument see coupling::team_service(), and require_same_calls()
  explicit MpiRun(const std::string &words);
  ~MpiRun();
  MpiRun(const MpiRun &)            = delete;
  MpiRun &operator=(const MpiRun &) = delete;

  /// This process is not to run the program.
  bool serves() const;
  /// Does what rank 0 orders until it is dismissed.
  void serve();
  /// Rank 0, at the end: says so where the others had nothing to do.
  void tell_idle() const;

private:
  coupling::Launch       launch_;
  coupling::TeamService *team_;
};

/// Makes this process one that no launcher started; before any MpiRun.
void leave_team();
/// As leave_team() for ranks that share nothing but files, and know of each other.
/// @throws std::invalid_argument if they were called otherwise than rank 0
void part_team(const std::string &words);
/// What it was among the ranks that share files; alone if there are none.
coupling::Launch team_left();

/// Whether the user wants a case of its own per process: the environment has GESTELL_APART, and not as 0.
bool apart_by_environment();

} // namespace gestell::apps
