#pragma once

#include "fem/values/frame_specification.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Indices of the solids whose name fits a pattern of specification.materials ('*', '?').
 *
 * @param named  the pattern with its material
 * @throws std::invalid_argument if there is none, with the place of the material and the names there are.
 */
std::vector<std::size_t> solids_of(const std::pair<std::string, Material> &named,
                                   const std::vector<std::string>         &solids);

/// That every pattern of specification.materials fits a solid.  @throws std::invalid_argument as solids_of().
void check_solids_of_materials(const FrameSpecification &specification, const std::vector<std::string> &solids);

} // namespace gestell::fem
