#pragma once

#include "apps/cli/modes_options.h"
#include "apps/cli/prepared_machine.h"
#include "coupling/frame/mesh_convergence.h"

#include <filesystem>

namespace gestell::apps
{

/// `gestell modes SCENE --converge TOLERANCE`: refines the mesh of the scene's frame, see coupling::converge_mesh().
/// @throws std::invalid_argument if the frame is not made from geometry, or options are out of range.
coupling::MeshConvergence converge_frame(const Scene &scene, const ModesCommandOptions &modes,
                                         const std::filesystem::path &folder, ProgressLine &progress);

/// Prints meshes, limits, errors and whether they are within the tolerance.
void print_convergence(const coupling::MeshConvergence &convergence, double tolerance);

/// What the answer must not be taken without: the error of the mesh, and why it is larger than asked for.
std::vector<std::string> convergence_warnings(const coupling::MeshConvergence &convergence, double tolerance);

/// mesh_convergence.csv: one row per mesh, then `limit`, `uncertainty`, `error` and `order` of each quantity.
void write_convergence(const std::filesystem::path &folder, const coupling::MeshConvergence &convergence);

} // namespace gestell::apps
