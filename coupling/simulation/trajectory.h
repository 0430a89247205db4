#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <vector>

namespace gestell::coupling
{

/// State of a motion at an instant.
struct MotionNode
{
  double          t = 0.;
  Eigen::VectorXd q, v; // [n]
};

/// The smooth motion between two events: nodes at the ends of steps, and the event functions whose transitions end it,
/// in order.
struct SmoothPiece
{
  std::vector<MotionNode> nodes;
  std::vector<int>        guards;
};

/**
 * The computed motion of a run, stored for computations along it.
 *
 * Steps that are long compared with the motion have additional nodes inside, from the dense output.
 */
class Trajectory
{
public:
  /// Stores the start, after the integrator began, with the initial history of the elements.
  void begin(const Instant &at, const Eigen::VectorXd &history);
  /// Stores a step, or its part up to an event.
  /// @param spacing  [s] largest distance of nodes
  void step(const TimeIntegrator &integrator, double spacing);
  /// The transition of an event function ends the last step.
  void guard(int number);

  const std::vector<SmoothPiece> &pieces() const { return pieces_; }
  const Eigen::VectorXd          &history() const { return history_; } ///< at the start

private:
  void add(const TimeIntegrator &integrator, double t);

  std::vector<SmoothPiece> pieces_;
  Eigen::VectorXd          history_;
};

} // namespace gestell::coupling
