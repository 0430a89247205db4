#pragma once

#include "apps/analysis/life/damage/damage.h"
#include "apps/analysis/life/damage/stress_measure.h"
#include "coupling/frame/reduced_stress.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

struct WorstPoints
{
  std::vector<PointDamage> worst; ///< by descending damage, then ascending point; fewer than asked if there are no more
  int                      looked_at = 0; ///< points whose cycles were counted
};

/**
 * The points of the largest damage, exact, without counting the cycles of all points.
 *
 * Bounds of the damage come from coarse loads, few samples of few principal components of the states with a known error
 * (docs/theory/life.md (5) to (9)).  The point with the largest bound gets that of the next closer load, at last its
 * cycles are counted, until the next bound is at most the damage of the last of the worst found.  Greedy with a
 * distance: the worst, then the worst at least `distance` from those chosen, and so on.
 *
 * @param states  (p; g) [n1 + m + 3 x samples of `load`], finite
 * @throws std::invalid_argument: sizes, directions missing
 */
WorstPoints worst_points(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search);

/// Damage of one point by counting all its cycles; the measure of reference for worst_points.
PointDamage point_damage(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search, int point);

/// History of the measure at a point [samples]; of `critical_plane` on the plane of `at.row`.
Eigen::VectorXd stress_history(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states,
                               const DamageSearch &search, const PointDamage &at);

/// The states in other coordinates, states = T z; empty: the same.
struct OtherCoordinates
{
  Eigen::MatrixXd T, z;
};

/**
 * Part of each coordinate z of the states in the damage at a point [n1 + m + 3]: its part in the range of each cycle,
 * weighted by the cycle's damage,
 *
 *     s_j = sum_k (D_k / D) a_j (z_j(end_k) - z_j(begin_k)) / (x(end_k) - x(begin_k)),   sum_j s_j = 1.
 *
 * A negative part relieves.  For a single slope without mean effect d ln D / d ln a_j = m s_j.  Zero without damage.
 */
Eigen::VectorXd damage_shares(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states,
                              const LoadSequence &load, const DamageRule &rule, const DamageSearch &search,
                              const PointDamage &at, const OtherCoordinates &z = {});

} // namespace gestell::apps
