#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

namespace gestell::fem
{

/**
 * Removes features smaller than mesh.defeature from gmsh's model: bores and pins by diameter, fillets, chamfers and
 * grooves by width, if the surrounding faces can be extended to close the gap (OpenCASCADE's BRepAlgoAPI_Defeaturing);
 * then shorter edges, which are merged into their neighbours.  Names of solids and faces are kept.  A note gives the
 * number of removed and remaining faces and the change of volume.
 *
 * @throws std::invalid_argument if a solid is lost, opened, or changes its volume by more than 5 %.
 */
void defeature(CadModel &model, const FrameSpecification &specification, const GmshSession &session);

} // namespace gestell::fem
