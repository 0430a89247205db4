#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

struct Event
{
  double      t;
  std::string name, kind;
};

/**
 * Finds the events between two accepted instants and executes their transitions, without restarting the integration.
 *
 * The measures are interpolated by the cubic through u, u' at both ends.  Every active event function is searched for a
 * zero in its direction; the earliest zero is located to 1e-12 of the step, its transition is executed, and the search
 * continues with the event functions of the new branch.  The times have the accuracy of the integration.
 */
class EventDetection
{
public:
  explicit EventDetection(SecondOrderSystem &system);

  void begin(const LocalState &state);
  /// Events in (from, to], appended to `events`.
  void step(const LocalState &from, const LocalState &to, std::vector<Event> &events);
  /// Number of steps with more transitions than allowed (chatter); further transitions are dropped.
  long chattering_steps() const { return chattering_; }

private:
  void   make_room();
  bool   earliest(const LocalState &from, const LocalState &to, double since, int &guard, double &share);
  void   at(const LocalState &from, const LocalState &to, double share, LocalState &state) const;
  double value(int guard, const LocalState &from, const LocalState &to, double share);

  static constexpr int max_per_step = 20;

  SecondOrderSystem &system_;
  LocalState         between_;
  Eigen::VectorXd    g_from_, g_to_, g_;
  long               chattering_ = 0;
};

} // namespace gestell::coupling
