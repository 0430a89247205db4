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

/// A switching (event) function that is active now: its owner, and the transition at its zero.
struct ActiveGuard
{
  std::string name; ///< of the element in the scene
  std::string kind; ///< of the transition
};

/// Branches of the laws: the history that selects them, and the zeros of event functions at which they change.  By
/// default there are none.
class EventSystem
{
public:
  virtual ~EventSystem() = default;

  /// True: laws follow the branch of their history, smoothly continued beyond its switching point, as required if
  /// events are located.  False: branches follow the motion.
  virtual void follow_history(bool) {}

  // the history changes only in start(), accept(), transition() and restore_history()
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
