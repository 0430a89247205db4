#pragma once

#include "apps/output/values/result.h"
#include "coupling/machine/machine.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// Extremes of the main signal, then of all other forces and torques, around which a run keeps its states: as many as
/// memory allows for a machine of n coordinates.
std::vector<coupling::SignalExtreme> swing_extremes(const std::vector<coupling::Signal> &signals, int n);

/// The state of that instant, or the nearest one within `reach` [s]; null: none.
const coupling::KeptState *state_near(const std::vector<coupling::KeptState> &states, double t, double reach);

/**
 * What each mode of result.coupled_modes makes of half a swing of a force, between the turning points q_0 and q_1: by
 * eta = V^T M (q_1 - q_0) and the derivative of the force at q_1,
 *
 *     c_j = eta_j dF/dq . v_j,     share_j = |c_j| / sum |c_k|,
 *
 * of forces that positions do not tell, as those of ideal joints, by strain energy, c_j = (omega_j eta_j)^2.  Modes
 * without frequency make none.
 *
 * @param of_force  becomes whether they are those of the force
 */
Eigen::VectorXd swing_shares(const coupling::Signal &signal, const coupling::Machine &machine, const Result &result,
                             const coupling::KeptState &q_0, const coupling::KeptState &q_1, bool &of_force);

} // namespace gestell::apps
