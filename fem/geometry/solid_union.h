#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/values/frame_specification.h"

namespace gestell::fem
{

/**
 * Joins the solids of a CAD model in gmsh: where they touch they get one common face (gmsh's fragment, OpenCASCADE's
 * general fuse), so that their meshes share nodes as if they were welded.
 *
 * Faces within mesh.gap are merged. Overlapping solids are an error with name and volume, or with mesh.overlaps = once
 * their common part is assigned to the first of them.  Solids keep their names; a solid that is cut by another one
 * becomes several of its name.  So do physical surfaces of a script.
 *
 * @throws std::invalid_argument if solids overlap, the gap is a third of the mean thickness 2 V / A of a solid or more,
 *         one of them vanishes in it, or OpenCASCADE fails.
 */
void join_solids(CadModel &model, const FrameSpecification &specification, const GmshSession &session);

/// For every solid the lowest index of the solids connected to it by common faces.
std::vector<int> bodies_of(const std::vector<Solid> &solids);

/// @throws std::invalid_argument if the number of bodies is not mesh.bodies; the message lists where they are closest.
void check_bodies(const CadModel &model, const FrameSpecification &specification);

} // namespace gestell::fem
