#pragma once

#include "fem/frame_matrices.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * What speaks against kg, m and N in matrices of another program, one text each; none if nothing does.
 *
 * - Mass over the box of all nodes, at least a twentieth as thick as it is long: a frame is no lighter than air and no
 *   heavier than the heaviest metal (22 600 kg/m^3).  Tonnes make it a thousand times too light.  Without a table of
 * nodes the box of the interfaces lies inside the frame, and only tells what is too light.
 * - Extent of the nodes: below 1 km.  Positions in millimetres make it a thousand times too large.
 * - The length sqrt(C_rr / C_uu) of an interface that turns and shifts, that of the parts that bend at it: below 100 m
 * and above 0.1 mm.  Moments in N mm beside forces in N make it a thousand times too long.
 *
 * @param translations_known  whether the frame's mass can be told.
 */
std::vector<std::string> suspect_units(const fem::FrameMatrices &frame, bool translations_known);

} // namespace gestell::apps
