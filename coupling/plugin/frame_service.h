#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "fem/values/cad_body.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

namespace gestell::coupling
{

struct MeshReport; // coupling/plugin/mesh_report.h

/**
 * Interface of the FEM part (gmsh, deal.II, PETSc, SLEPc), a plugin loaded only to make a frame.  Throws
 * std::invalid_argument for wrong input, ConvergenceFailure for failed methods.
 */
class FrameService
{
public:
  virtual ~FrameService()                                                                 = default;
  virtual MeshReport mesh(const fem::FrameSpecification &frame, const Progress &progress) = 0;
  /// Volume, centre and inertia of a part of the mechanism.
  virtual fem::CadBody measure(const fem::CadSource &part) = 0;
  /// Craig-Bampton (5.5.3/14-23), modal damping included.
  virtual ReducedFrame reduce(const fem::FrameMatrices &frame, const ReductionOptions &options,
                              const Progress &progress) = 0;
  /// Fills frame.modal_damping with the lowest n_modes modes of the supported frame with free interface.
  virtual void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress,
                                 const std::string &factor) = 0;
};

} // namespace gestell::coupling

/// The one symbol of the plugin.
extern "C" __attribute__((visibility("default"))) gestell::coupling::FrameService *gestell_frame_service();
