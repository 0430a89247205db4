#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/values/frame_specification.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Indices of the solids whose name matches a pattern of specification.materials ('*', '?').
 *
 * @param named  the pattern with its material
 * @throws std::invalid_argument if there is none, with the location of the material and the names of solids.
 */
std::vector<std::size_t> solids_of(const std::pair<std::string, Material> &named,
                                   const std::vector<std::string>         &solids);

/// The material of each solid: the last of specification.materials whose pattern matches its name, else
/// specification.material.  @throws as solids_of() does.
std::vector<Material> materials_of(const FrameSpecification &specification, const std::vector<std::string> &solids);

/// States whose density counts, of the file or of the specification.
/// @throws std::invalid_argument if a solid has none, or one that no material has.
void check_materials(CadModel &model, const FrameSpecification &specification);

} // namespace gestell::fem
