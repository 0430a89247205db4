#pragma once

#include "apps/analysis/life/damage/worst_points.h"

namespace gestell::apps
{

/**
 * The plane of the largest damage of `critical_plane` at a point, between those of measure_rows(): golden sections of
 * the angle from the plane of `at`, across a known surface in one direction, otherwise in two in turn. Other measures
 * remain as they are.
 *
 * The damage does not depend on where the planes of measure_rows() begin, nor on the orientation of the frame.
 *
 * @param at  worst of the planes of measure_rows(), as from worst_points() or point_damage()
 */
PointDamage on_worst_plane(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states,
                           const LoadSequence &load, const DamageRule &rule, const DamageSearch &search,
                           const PointDamage &at);

} // namespace gestell::apps
