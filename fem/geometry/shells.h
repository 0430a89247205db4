#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/values/cad_source.h"

namespace gestell::fem
{

/**
 * Whether the shells of a model are closed: gmsh reads open ones without an error, as faces without a solid, or as a
 * solid with a meaningless volume.
 *
 * @throws std::invalid_argument if a solid of the file was lost (fewer solids than the STEP file describes, and faces
 *         left over), or if an edge of a solid has a face on one side only; the message gives number and location of
 * open edges. Other unused faces become a note of the model.
 */
void check_shells(CadModel &model, const CadSource &source);

/// The way to close an open shell.
std::string way_to_close(const CadSource &source);

/// " (its shell is open at 4 edges, one of them from (...) to (...))" for faces without a solid; "" if none is open.
std::string open_edges_of_faces(const CadModel &model);

} // namespace gestell::fem
