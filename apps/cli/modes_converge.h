#pragma once

#include "apps/session/session.h"
#include "coupling/frame/mesh_convergence.h"

#include <filesystem>

namespace gestell::apps
{

/// `gestell modes SCENE --converge TOLERANCE`.
struct ConvergeOptions
{
  double      converge        = 0.;      ///< allowed relative mesh error; 0: the scene's mesh is used unchanged
  int         frequencies     = 4;       ///< number of lowest elastic frequencies of the frame that `converge` checks
  std::string watch           = "all";   ///< or "frequencies": compliances of interfaces are not checked
  int         max_coordinates = 1000000; ///< of the finest mesh
};

/// Refines the mesh of the scene's frame, see coupling::converge_mesh().
/// @throws std::invalid_argument if the frame is not made from geometry, or options are out of range.
coupling::MeshConvergence converge_frame(const Scene &scene, const ConvergeOptions &requested,
                                         const std::filesystem::path &folder, const coupling::Progress &progress);

/// Prints meshes, limits, errors and whether they are within the tolerance.
void print_convergence(const coupling::MeshConvergence &convergence, double tolerance);

/// Warnings that belong to the answer: the error of the mesh, and why it is larger than requested.
std::vector<std::string> convergence_warnings(const coupling::MeshConvergence &convergence, double tolerance);

/// mesh_convergence.csv: one row per mesh, then `limit`, `uncertainty`, `error` and `order` of each quantity.
void write_convergence(const std::filesystem::path &folder, const coupling::MeshConvergence &convergence);

} // namespace gestell::apps
