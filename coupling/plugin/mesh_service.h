#pragma once

#include "coupling/frame/mesh_convergence.h"
#include "coupling/plugin/frame_service.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Frames with an estimate of their mesh error: the second interface of the plugin of FrameService.
class MeshService
{
public:
  virtual ~MeshService() = default;

  /// Reads the geometry and finds its surfaces without a mesh, see fem::inspect_geometry(); returns a description.
  struct Inspection
  {
    std::string              found; ///< "2 solids, 0.00088 m^3; surfaces: base 1 face, bore 2 faces"
    std::vector<std::string> notes, statements;
    /// [m] of the surfaces of each interface, from the CAD file, without the rounding of a mesh.
    std::map<std::string, fem::Vector3> centroids;
    /// [m] Low and high corner of the box around them.
    std::map<std::string, std::array<fem::Vector3, 2>> boxes;
    double                                             diagonal = 0.; ///< of the box around the solids [m]
    bool curved = false; ///< some outer face is not plane; for a mesh, judged by its facets
  };
  virtual Inspection inspect(const fem::FrameSpecification &frame) = 0;

  /// Meshes, assembles and reduces; a statement or a note of the frame gives the error of its mesh.
  virtual ReducedFrame reduce(const fem::FrameSpecification &frame, const ReductionOptions &options,
                              const Progress &progress) = 0;

  /// Meshes and assembles for a frame that is not reduced; the reduced frame reports the error of its mesh.
  struct Unreduced
  {
    fem::FrameMatrices matrices;
    ReducedFrame       reduced;
  };
  virtual Unreduced assemble(const fem::FrameSpecification &frame, const ReductionOptions &options,
                             const Progress &progress) = 0;

  /// The same frame in elements of degree three on the same mesh (fem::raised_matrices()), a reference for degree two;
  /// without forces through cuts and on clamped supports.
  virtual ReducedFrame reduce_raised(const fem::FrameSpecification &frame, const ReductionOptions &options,
                                     const Progress &progress) = 0;

  /// Refines the mesh until frequencies and compliances are within a tolerance, see converge_mesh().
  virtual MeshConvergence converge(const fem::FrameSpecification &frame, const ReductionOptions &reduction,
                                   const ConvergenceOptions &options, const Progress &progress) = 0;
};

/// Loaded in the same way as frame_service().
MeshService &mesh_service();

} // namespace gestell::coupling

extern "C" __attribute__((visibility("default"))) gestell::coupling::MeshService *gestell_mesh_service();
