#pragma once

#include "coupling/frame/reduced_frame.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Indications that matrices of another program are not in kg, m and N, one text each; none if they are plausible.
 *
 * - Mass over the box of all nodes, at least a twentieth as thick as it is long: a frame is no lighter than air and no
 *   heavier than the heaviest metal (22 600 kg/m^3).  Tonnes make it a thousand times too light.  Without a table of
 *   nodes the box of the interfaces is smaller than the frame, and only a mass that is too light is detected.
 * - Extent of the nodes: below 1 km.  Positions in millimetres make it a thousand times too large.
 * - Coordinates: some have a frequency of 0.1 Hz or more on their own; with mass and stiffness exchanged none has.
 * - Wave speed, sqrt(C_ii / M_ii) of a node's stiffest displacement times the distance to its nearest neighbour in C,
 *   the median of all nodes: below 60 km/s, ten times that in metals.  Masses in tonnes make it 32 times too fast.
 * - The length sqrt(C_rr / C_uu) of an interface with rotations and displacements, which is the length of the parts
 * that bend at it: below 100 m and above 0.1 mm.  Moments in N mm with forces in N make it a thousand times too long.
 *
 * @param nodes  all nodes with a position, and their rows.
 */
std::vector<std::string> suspect_units(const fem::FrameMatrices &frame, const std::vector<fem::Interface> &nodes);

/**
 * Why the lowest elastic frequency f of a frame given by matrices is implausible; empty if it is plausible.  For a
 * solid body of length L it is at most c / 2 L, where c = 6.5 km/s is the fastest wave speed in metals; without
 * positions the limit is that of a steel cube of 0.1 m.
 */
std::string suspect_frequency(const coupling::ReducedFrame &frame);

} // namespace gestell::apps
