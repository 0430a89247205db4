#pragma once

#include "coupling/plugin/team_loader.h"

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
  /// @throws std::invalid_argument see coupling::team_service().
  MpiRun();
  ~MpiRun();
  MpiRun(const MpiRun &)            = delete;
  MpiRun &operator=(const MpiRun &) = delete;

  /// This process is not to run the program.
  bool serves() const;
  /// Does what rank 0 orders until it is dismissed.
  void serve();

private:
  coupling::Launch       launch_;
  coupling::TeamService *team_;
};

/// Makes this process one that no launcher started, for ranks that share nothing but files; before any MpiRun.
void leave_team();
/// What it was among those that the launcher started; alone if it did not leave any.
coupling::Launch team_left();

} // namespace gestell::apps
