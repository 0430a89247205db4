#pragma once

#include "fem/geometry/face.h"
#include "fem/values/frame_specification.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Two names may select the same face, but not for two interfaces, attached masses or clamped supports, each of which
 * prescribes its motion. Reported before meshing, with the face.
 *
 * @param selection  tags of the faces of each named surface
 * @throws std::invalid_argument naming the face, both surfaces and both owners
 */
void require_faces_of_one_owner(const std::map<std::string, std::vector<int>> &selection,
                                const std::vector<Face> &faces, const FrameSpecification &specification);

} // namespace gestell::fem
