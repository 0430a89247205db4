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
  /// Ranks above 0: does what rank 0 orders, by its number, until it dismisses them.
  virtual void serve(const std::function<void(int order)> &obey) = 0;
  /// Rank 0: the others end.
  virtual void dismiss() = 0;
  /// Ends all ranks at once with exit code 3.
  virtual void abort(const char *message) = 0;
};

} // namespace gestell::coupling

extern "C" __attribute__((visibility("default"))) gestell::coupling::TeamService *gestell_team_service();

/// Of the plugin behind FrameService: tells it that the team is there (rank 0), has it do an order (the others).
extern "C" __attribute__((visibility("default"))) void gestell_use_team();
extern "C" __attribute__((visibility("default"))) void gestell_obey(int order);
