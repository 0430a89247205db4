#pragma once

#include "fem/mesh/geometry_report.h"
#include "fem/mesh/size_field.h"
#include "fem/process/child.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <vector>

namespace gestell::fem
{

/// Called with the name of the phase that begins and the completed share, 0..1 (negative: unknown).
using MeshProgress = ChildProgress;

/**
 * Mesh of the frame with its named surfaces.
 *
 * STEP, BREP and .geo are meshed with linear tetrahedra of specification.mesh.size, smaller on surfaces with their own
 * size.  The mesh of a .msh or .inp file is used unchanged: mesh.size has no effect, and selectors act on its surfaces
 * (of the mesh, with their groups) by their triangles, see divide_skin().  Equal input gives an equal mesh; no file is
 * written.
 *
 * gmsh runs in a child process, see in_child(): a crash or an endless loop of gmsh or OpenCASCADE becomes an error
 * message.
 *
 * @param refined  sizes at points, which replace mesh.size where they are smaller; see refine().
 * @throws std::invalid_argument for bad input, see read_cad, select_faces, set_mesh_sizes, extract_mesh; if the child
 *         dies; for numbers that are not finite.
 */
Mesh make_mesh(const FrameSpecification &specification, const MeshProgress &progress = {},
               const std::vector<SizePoint> &refined = {});

/// Meshes and reports; if specification.mesh.size is 0, with a size for about 25000 cells.
GeometryReport report_geometry(const FrameSpecification &specification, const MeshProgress &progress = {});

/**
 * Reads the file and finds the surfaces as for a mesh, and estimates sizes and memory, without meshing (except scripts
 * that mesh): counts and qualities of cells stay 0.
 *
 * @throws std::invalid_argument as make_mesh() does before meshing, and as check_solids_of_materials() does.
 */
GeometryReport inspect_geometry(const FrameSpecification &specification);

} // namespace gestell::fem
