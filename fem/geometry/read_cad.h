#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

#include <string>

namespace gestell::fem
{

/**
 * Reads a file of any kind into gmsh, for its solids; faces and connections are not examined.  A
 * .stl has triangles and no solids.
 *
 * A STEP file contains its unit. source.unit > 0 overrides it: the true length [m] of the file's millimetre (unit = 1
 * for a model drawn in metres and written as millimetres). For the other formats it is the length of their unit,
 * default one metre.
 *
 * @throws std::invalid_argument if the file is missing, empty, of another kind, truncated or unreadable, contains no
 * closed solid, or is smaller than 1 mm or larger than 200 m.
 */
CadModel open_cad(const CadSource &source, const GmshSession &session);

/// The file of a frame.
CadSource source_of(const FrameSpecification &specification);

/// Warning of a suspicious unit, for a frame of less than 2 cm or more than 50 m: a sentence with value and remedy, or
/// nothing.
std::string suspect_size(const CadModel &model, const CadSource &source);

/**
 * Reads the .step, .stp, .brep, .geo (OpenCASCADE kernel), .msh or .inp file of a frame into gmsh, as open_cad() does,
 * with its outer faces.  Solids of STEP and BREP files are joined where they touch, see join_solids().
 *
 * @throws std::invalid_argument as open_cad(), check_shells(), join_solids() and check_bodies() do.
 */
CadModel read_cad(const FrameSpecification &specification, const GmshSession &session);

} // namespace gestell::fem
