#pragma once

#include "apps/analysis/life/damage/damage.h"
#include "apps/analysis/life/damage/stress_measure.h"
#include "apps/scene/values/life_request.h"

namespace gestell::apps
{

/// The rule of [life] with one of its curves.
/// @throws std::invalid_argument with the place of the curve: no such class or material, a missing strength
DamageRule damage_rule(const LifeRequest &life, const CurveRequest &curve, StressKind kind);

/// Of places without a direction.
StressMeasure measure_of(const LifeRequest &life);
Residue       residue_of(const LifeRequest &life);

} // namespace gestell::apps
