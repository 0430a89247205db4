#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

namespace gestell::fem
{

/**
 * Removes from gmsh's model what is smaller than mesh.defeature: bores and pins of a smaller diameter, fillets,
 * chamfers and grooves that are narrower, where the faces around them can be carried on to close the place
 * (OpenCASCADE's BRepAlgoAPI_Defeaturing); then shorter edges, which are taken into their neighbours.  Names of solids
 * and faces are kept.  A note tells how many faces went, how many could not, and what that did to the volume.
 *
 * @throws std::invalid_argument if a solid is lost, opened, or changes its volume by more than 5 %.
 */
void defeature(CadModel &model, const FrameSpecification &specification, const GmshSession &session);

} // namespace gestell::fem
