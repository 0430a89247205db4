#pragma once

#include "coupling/integration/system/local_forces.h"

#include <string>

namespace gestell::coupling
{

enum class GuardCrossing
{
  rising,
  falling
};

/// A switching function that is active now: whose it is, and which transition its zero means.
struct ActiveGuard
{
  std::string name; ///< of the element in the scene
  std::string kind; ///< of the transition
};

/// Branches of the laws: the history that names them, and the zeros of switching functions at which they change.  This
/// one has none.
class EventSystem
{
public:
  virtual ~EventSystem() = default;

  /// True: laws follow the branch their history names, smoothly continued beyond its switching point, as is right where
  /// events are located.  False: by the motion itself.
  virtual void follow_history(bool) {}

  // the history changes on start(), accept(), transition() and restore_history() only
  virtual Eigen::VectorXd save_history() const { return {}; }
  virtual void            restore_history(const Eigen::VectorXd &) {}
  virtual void            start(const LocalState &) {}
  virtual void            accept(const LocalState &) {}

  virtual int           n_guards() const { return 0; }
  virtual void          guard_values(const LocalState &, Eigen::VectorXd &) const {}
  virtual GuardCrossing crossing(int) const { return GuardCrossing::rising; }
  virtual ActiveGuard   guard(int) const { return {}; }
  virtual void          transition(int, const LocalState &) {}
};

} // namespace gestell::coupling
