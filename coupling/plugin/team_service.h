#pragma once

#include <functional>

namespace gestell::coupling
{

/// The processes started by mpirun, an interface that loads MPI only.
class TeamService
{
public:
  virtual ~TeamService()   = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// On ranks above 0: executes commands of rank 0, by number, until it dismisses them.
  virtual void serve(const std::function<void(int order)> &obey) = 0;
  /// On rank 0: ends the service of the others.
  virtual void dismiss() = 0;
  /// Ends all ranks at once with exit code 3.
  virtual void abort(const char *message) = 0;
};

} // namespace gestell::coupling

extern "C" __attribute__((visibility("default"))) gestell::coupling::TeamService *gestell_team_service();

/// Functions of the plugin with FrameService: announce the team to it (rank 0), execute a command in it (the others).
extern "C" __attribute__((visibility("default"))) void gestell_use_team();
extern "C" __attribute__((visibility("default"))) void gestell_obey(int order);
