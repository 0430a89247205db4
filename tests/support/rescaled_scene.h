#pragma once

#include "tests/support/restated_scene.h"

#include <array>

namespace gestell::tests
{

/// Powers of two by which units of length, mass and time shrink, so that the numbers of a scene grow by 2^k exactly.
/// Even ones keep square roots exact as well.
using UnitPowers = std::array<int, 3>;

/// 2^(sum of power times exponent) of a unit such as "N m".
double growth(const UnitPowers &powers, const std::string &unit);

/**
 * A scene in other units of length, mass and time: each value with a dimension is multiplied by a power of two, also
 * those that are plain numbers in SI and the defaults of keys.
 *
 * The machine described is another one, larger, heavier or slower by the same factors everywhere.  Its equations are
 * the same in dimensionless form, its answers those of the original times powers of two; whatever differs by more than
 * rounding is a threshold in SI units within the program.
 *
 * Plain numbers of [parameters] count as without dimension, coordinates of modes as lengths.
 *
 * @throws std::invalid_argument for matrices from files
 */
Restated rescaled(const apps::SceneNode &scene, const UnitPowers &powers);

} // namespace gestell::tests
