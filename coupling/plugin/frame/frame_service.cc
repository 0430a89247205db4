#include "coupling/plugin/frame_service.h"

#include "coupling/algebra/openblas.h"
#include "coupling/plugin/frame/make_mesh_report.h"
#include "coupling/plugin/mesh_report.h"
#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/mesh/measure_body.h"

namespace gestell::coupling
{

namespace
{

class PluginFrameService final : public FrameService
{
public:
  MeshReport mesh(const fem::FrameSpecification &frame, const Progress &progress) override
  {
    return mesh_report(frame, progress);
  }

  fem::CadBody measure(const fem::CadSource &part) override { return fem::measure_part(part); }

  ReducedFrame reduce(const fem::FrameMatrices &frame, const ReductionOptions &options,
                      const Progress &progress) override
  {
    use_one_blas_thread();
    return reduce_frame(frame, options, progress);
  }

  void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress,
                         const std::string &factor) override
  {
    use_one_blas_thread();
    coupling::add_modal_damping(frame, n_modes, progress, factor);
  }
};

} // namespace

} // namespace gestell::coupling

gestell::coupling::FrameService *gestell_frame_service()
{
  static gestell::coupling::PluginFrameService service;
  return &service;
}
