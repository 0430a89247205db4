#pragma once

#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Writes a series of data sets for ParaView, a .pvd file and the folder of its .vtp files, if the result contains the
 * data.
 *
 * @param names  receives the names of the files relative to the folder, each before it is written
 * @throws coupling::WriteFailure, std::invalid_argument as OwnFolder::claim() does
 */
using WriteSeries = void(OwnFolder &folder, const Result &result, std::vector<std::string> &names);

/**
 * frame_modes.pvd and coupled_modes.pvd (one data set per mode shape), motion.pvd with forces.pvd and view.py (frame
 * and mechanism at every saved instant, and the forces on the bodies), stress.pvd.
 *
 * Point field: `displacement [m]`, true to scale. In frame_modes it is the mode shape, scaled so that the largest
 * displacement is a twentieth of the frame's size; the time of a data set is the number of the mode, and the field
 * `frequency [Hz]` its frequency.
 */
const std::vector<WriteSeries *> &paraview_series();

/// A warning with the library that this build lacks to write them; "" if none.
std::string lacks_for_paraview();

} // namespace gestell::apps
