#pragma once

#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Writes a series of data sets for ParaView, a .pvd file and the folder of .vtp files that it names, where the result
 * has something for it.
 *
 * @param names  gets the names of the files relative to the folder, each before it is written
 * @throws coupling::WriteFailure, std::invalid_argument as OwnFolder::claim()
 */
using WriteSeries = void(OwnFolder &folder, const Result &result, std::vector<std::string> &names);

/**
 * frame_modes.pvd and coupled_modes.pvd (one data set per mode shape), motion.pvd with forces.pvd and view.py (frame
 * and mechanism at every saved instant, and what acts on the bodies), stress.pvd.
 *
 * Point fields: `displacement [m]`, true to scale.  In frame_modes it is the mode shape scaled to a largest
 * displacement of a twentieth of the frame's size; the time of a data set is the number of the mode, whose frequency
 * is the field `frequency [Hz]`.
 */
const std::vector<WriteSeries *> &paraview_series();

/// A warning of what this build lacks to write them; "" if nothing.
std::string lacks_for_paraview();

} // namespace gestell::apps
