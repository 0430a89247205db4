#pragma once

#include "apps/output/values/result.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/modes.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// Extremes of the main signal, then of all other forces and torques, around which a run keeps its states: as many as
/// memory allows for a machine of n coordinates.
std::vector<coupling::SignalExtreme> swing_extremes(const std::vector<coupling::Signal> &signals, int n);

/// The state at that instant, or the nearest one within `reach` [s]; null: none.
const coupling::KeptState *state_near(const std::vector<coupling::KeptState> &states, double t, double reach);

/// The states from one turning point to the other, in that order, at most about thirty; empty if some were not kept.
std::vector<const coupling::KeptState *> states_of_swing(const std::vector<coupling::KeptState> &states, double from,
                                                         double to, double reach);

/**
 * Contribution of each mode to the change of a force along a path q_0, ..., q_n, from its motion between the states,
 *
 *     c_j = sum_k F(q_m + eta v_j/2) - F(q_m - eta v_j/2),   eta = v_j^T M (q_{k+1} - q_k),   q_m = (q_k + q_{k+1})/2,
 *
 * with its sign [unit of F].  If the modes span the motion, the sum is F(q_n) - F(q_0), except for the effects of
 * velocities, time and multipliers of joints.
 */
Eigen::VectorXd swing_changes(const coupling::Signal &signal, const coupling::Machine &machine,
                              const std::vector<coupling::Mode>              &modes,
                              const std::vector<const coupling::KeptState *> &path);

} // namespace gestell::apps
