#pragma once

#include "coupling/plugin/team_loader.h"

#include <string>

namespace gestell::apps
{

/**
 * The processes of mpirun during its lifetime: rank 0 runs the program, the others serve it and end with it.
 *
 * Without mpirun it only reads the environment.
 */
class MpiRun
{
public:
  /// @param words  command line: all ranks must have the same
  /// @throws std::invalid_argument see coupling::team_service(), and require_same_calls()
  explicit MpiRun(const std::string &words);
  ~MpiRun();
  MpiRun(const MpiRun &)            = delete;
  MpiRun &operator=(const MpiRun &) = delete;

  /// Whether this process only serves rank 0.
  bool serves() const;
  /// Executes the commands of rank 0 until it is dismissed.
  void serve();
  /// On rank 0 at the end: prints a note if the other ranks were idle.
  void tell_idle() const;

private:
  coupling::Launch       launch_;
  coupling::TeamService *team_;
};

/// Makes this process independent of the launcher; before any MpiRun.
void leave_team();
/// Like leave_team(), for ranks that share only files, and know their rank.
/// @throws std::invalid_argument if a rank has another command line than rank 0
void part_team(const std::string &words);
/// Its rank among the ranks that share files; a single process if there are none.
coupling::Launch team_left();

/// Whether the user requests a separate case per process: the environment variable GESTELL_APART is set, and is not 0.
bool apart_by_environment();

} // namespace gestell::apps
