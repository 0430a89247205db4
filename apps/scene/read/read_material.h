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
/// A modulus or density no solid has is refused as a plain number, with the unit that was probably meant; written with
/// its unit it is only warned of.
fem::Material read_material(const SceneTable &table, const SceneTable &scene, const std::string &key = "material",
                            const std::string &fallback = "steel");

/// Of [material.NAME] and of a table in its place; `material` of a frame or a body.
const std::vector<Key> &material_keys();
Key                     material_key();

/// `density` of a body, judged as that of a material.
double read_plausible_density(const SceneTable &table);

/// What speaks against a density [kg/m^3], with the unit that was probably meant; empty for those that solids have.
std::string suspect_density(double density);

/// Warns if a weighed mass and a volume [m^3] make a density that no solid has: the unit of one of them is wrong.
void warn_of_density(const SceneTable &table, double mass, double volume);

/// `materials` of a frame, by name of the solid.
std::vector<std::pair<std::string, fem::Material>> read_solid_materials(const SceneTable &frame,
                                                                        const SceneTable &scene);

} // namespace gestell::apps
