#pragma once

#include "coupling/frame/reduced_frame.h"

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
 * - Coordinates: some vibrate with 0.1 Hz and more, each by itself; with mass and stiffness exchanged none does.
 * - Speed of waves, sqrt(C_ii / M_ii) of a node's stiffest displacement times the distance of its nearest neighbour in
 *   C, the median of all nodes: below 60 km/s, ten times that in metals, as masses in tonnes make it 32 times as fast.
 * - The length sqrt(C_rr / C_uu) of an interface that turns and shifts, that of the parts that bend at it: below 100 m
 * and above 0.1 mm.  Moments in N mm beside forces in N make it a thousand times too long.
 *
 * @param nodes  all that have a place, with their rows.
 */
std::vector<std::string> suspect_units(const fem::FrameMatrices &frame, const std::vector<fem::Interface> &nodes);

/**
 * What speaks against the lowest elastic frequency f of a frame by its matrices; empty if nothing does.  Of a solid
 * body of length L it is at most c / 2 L, c = 6.5 km/s being the fastest waves in metals; without any places it is
 * below that of a steel cube of 0.1 m.
 */
std::string suspect_frequency(const coupling::ReducedFrame &frame);

} // namespace gestell::apps
