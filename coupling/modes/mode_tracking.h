#pragma once

#include "coupling/modes/modes.h"

#include <functional>

namespace gestell::coupling
{

/// The choice of one column per row, none twice, with the largest sum (the Hungarian method, cost a^2 b).
/// @param value  [a x b], a <= b
std::vector<int> best_assignment(const Eigen::MatrixXd &value);

/// Modes at one position, shapes normalised to v^T M v = 1, the first `lines` of which are followed.
struct TrackedModes
{
  double              x = 0.;
  std::vector<Mode>   modes;     ///< by line, then those that belong to none, ascending
  std::vector<double> assurance; ///< [lines] (v^T M v_before)^2, the least of the way from the position before
};

struct TrackingOptions
{
  int    lines = 20;
  double sure  = 0.8; ///< assurance below which a step is halved
  int    most_halving =
      10; ///< at most this often: a crossing is distinguished from a veering as narrow as 1/1000 of the step
  int most_between = 60; ///< linearisations between two positions
};

/**
 * Puts `next` in the order of the lines of `before`.
 *
 * Shapes are assigned by modal assurance, best for all lines together.  Where an assurance is low, or two lines would
 * change their order, the step is halved with modes from `at(x)`: in a veering, shapes turn continuously and the lines
 * keep apart; two that cross keep their shapes however short the step is.  Modes of one frequency may be any mixture;
 * they are turned to be nearest to the shapes before.  Signs are kept.
 *
 * Source: docs/theory/modes_along.md (4), (5).
 * @param at  modes at a position between; throws std::invalid_argument or ConvergenceFailure if there are none, and the
 * step stays as it is
 */
void track(const TrackedModes &before, TrackedModes &next, const Eigen::MatrixXd &M, const TrackingOptions &options,
           const std::function<std::vector<Mode>(double)> &at);

} // namespace gestell::coupling
