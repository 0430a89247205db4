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
 * Finds the events between two accepted instants and takes their transitions, without restarting the integration.
 *
 * The measures follow the cubic through u, u' at both ends; every guard that is active is watched for a zero in its
 * direction, the earliest one is located to 1e-12 of the step, its transition taken, and the search goes on with the
 * guards of the new branch.  Accuracy of the times is that of the integration.
 */
class EventDetection
{
public:
  explicit EventDetection(SecondOrderSystem &system);

  void begin(const LocalState &state);
  /// Events in (from, to], appended to `events`.
  void step(const LocalState &from, const LocalState &to, std::vector<Event> &events);
  /// Steps in which more transitions than allowed were asked for (chatter); the rest was dropped.
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
