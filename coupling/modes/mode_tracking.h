#pragma once

#include "coupling/modes/modes.h"

#include <functional>

namespace gestell::coupling
{

/// The choice of one column per row, none twice, with the largest sum (the Hungarian method, cost a^2 b).
/// @param value  [a x b], a <= b
std::vector<int> best_assignment(const Eigen::MatrixXd &value);

/// Modes at one position, shapes normalised to v^T M v = 1; the first `lines` are tracked.
struct TrackedModes
{
  double              x = 0.;
  std::vector<Mode>   modes;     ///< by line, then those without a line, ascending
  std::vector<double> assurance; ///< [lines] (v^T M v_before)^2, the smallest value since the previous position
};

struct TrackingOptions
{
  int    lines = 20;
  double sure  = 0.8; ///< assurance below which a step is halved
  int    most_halving =
      10; ///< largest number of halvings: a crossing is distinguished from a veering as narrow as 1/1000 of the step
  int most_between = 60; ///< linearisations between two positions
};

/**
 * Sorts `next` in the order of the lines of `before`.
 *
 * Shapes are assigned by modal assurance, optimal for all lines together.  If an assurance is low, or two lines would
 * exchange their order, the step is halved with modes from `at(x)`: in a veering shapes rotate continuously and the
 * lines remain apart; crossing lines keep their shapes for any step.  Modes of one frequency are an arbitrary
 * combination; they are rotated to match the previous shapes.  Signs are kept.
 *
 * Source: docs/theory/modes_along.md (4), (5).
 * @param at  modes at an intermediate position; throws std::invalid_argument or ConvergenceFailure if there are none,
 * and the step is not divided
 */
void track(const TrackedModes &before, TrackedModes &next, const Eigen::MatrixXd &M, const TrackingOptions &options,
           const std::function<std::vector<Mode>(double)> &at);

} // namespace gestell::coupling
