#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <vector>

namespace gestell::coupling
{

/// A motion at an instant.
struct MotionNode
{
  double          t = 0.;
  Eigen::VectorXd q, v; // [n]
};

/// The motion between two events, smooth: nodes at the ends of steps, and the guards whose transitions end it, in
/// order.
struct SmoothPiece
{
  std::vector<MotionNode> nodes;
  std::vector<int>        guards;
};

/**
 * The motion of a run as it was made, kept for what is computed along it afterwards.
 *
 * Steps that are long against what moves in them are kept by nodes inside, from the dense output.
 */
class Trajectory
{
public:
  /// The start, after the integrator began; history of the elements as it was set there.
  void begin(const Instant &at, const Eigen::VectorXd &history);
  /// A step was made, or the part of it up to an event.
  /// @param spacing  [s] largest distance of nodes
  void step(const TimeIntegrator &integrator, double spacing);
  /// The transition of a guard ends the step that was made last.
  void guard(int number);

  const std::vector<SmoothPiece> &pieces() const { return pieces_; }
  const Eigen::VectorXd          &history() const { return history_; } ///< at the start

private:
  void add(const TimeIntegrator &integrator, double t);

  std::vector<SmoothPiece> pieces_;
  Eigen::VectorXd          history_;
};

} // namespace gestell::coupling
