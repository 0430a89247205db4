#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

#include <string>

namespace gestell::fem
{

/**
 * Reads a file of any kind into gmsh, for its solids; their faces are not looked at, nor whether they hang together.  A
 * .stl has triangles and no solids.
 *
 * A STEP file knows its unit.  source.unit > 0 overrides it: it is the true length [m] of what the file says to be a
 * millimetre (unit = 1 for a model drawn in metres that was written as millimetres).  For the other formats it is the
 * length of their unit, metre if not given.
 *
 * @throws std::invalid_argument if the file is missing, empty, of another kind, cut off or unreadable, holds no closed
 *         solid, or is smaller than 1 mm or larger than 200 m.
 */
CadModel open_cad(const CadSource &source, const GmshSession &session);

/// The file of a frame.
CadSource source_of(const FrameSpecification &specification);

/// What speaks for another unit of a frame that may be computed all the same, across less than 2 cm or more than 50 m:
/// a sentence with the value and the way out, or nothing.
std::string suspect_size(const CadModel &model, const CadSource &source);

/// Whether to read colours and layers of faces, which reads a STEP file a second time.
enum class FaceAttributes
{
  read,
  left
};

/**
 * Reads the .step, .stp, .brep, .geo (OpenCASCADE kernel), .msh or .inp file of a frame into gmsh, as open_cad() does,
 * with its outer faces.  Solids of STEP and BREP files are joined where they touch, see join_solids().
 *
 * @throws std::invalid_argument as open_cad(), check_shells(), join_solids() and check_bodies().
 */
CadModel read_cad(const FrameSpecification &specification, const GmshSession &session,
                  FaceAttributes attributes = FaceAttributes::left);

} // namespace gestell::fem
