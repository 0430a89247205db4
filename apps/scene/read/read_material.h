#pragma once

#include "apps/scene/file/scene_table.h"
#include "fem/values/frame_specification.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// A material of a frame or a body under `key`: a table { E, nu, rho }, the name of a [material.NAME] of the scene, or
/// of a built-in one; `fallback` (empty: none) if it is missing.
///
/// A modulus or density outside the range of solids is rejected if it is a plain number, with the unit that was
/// probably intended; if it is written with a unit, only a warning is added.
fem::Material read_material(const SceneTable &table, const SceneTable &scene, const std::string &key = "material",
                            const std::string &fallback = "steel");

/// The same with a density, which only a frame may take from its STEP file.
fem::Material read_weighed_material(const SceneTable &table, const SceneTable &scene);

/// Keys of [material.NAME] and of a table in its place; `material` of a frame or a body.
const std::vector<Key> &material_keys();
Key                     material_key();

/// Reads `density` of a body, with the checks of a material.
double read_plausible_density(const SceneTable &table);

/// Why a density [kg/m^3] is implausible, with the unit that was probably intended; empty in the range of solids.
std::string suspect_density(double density);

/// Warns if a measured mass and a volume [m^3] give a density outside the range of solids: a unit is wrong.
void warn_of_density(const SceneTable &table, double mass, double volume);

/// Reads `materials` of a frame, by name of the solid.
std::vector<std::pair<std::string, fem::Material>> read_solid_materials(const SceneTable &frame,
                                                                        const SceneTable &scene);

} // namespace gestell::apps
