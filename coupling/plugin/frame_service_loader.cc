#include "coupling/plugin/frame_service_loader.h"

#include "coupling/plugin/mesh_service.h"
#include "coupling/plugin/plugin.h"
#include "coupling/plugin/team_loader.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

constexpr const char *frame_library = "libgestell_frame.so", *rank_library = "libgestell_rank.so";

void *load_library(const char *library)
{
  const auto file = find_plugin(library);
  if (file.empty())
    throw std::invalid_argument(std::string("frame_service: ") + library +
                                " not found next to the program: this build of gestell cannot mesh and reduce frames; "
                                "build it with GESTELL_FEM=ON, or set GESTELL_PLUGIN_DIR to the folder of " +
                                library + ", or run from a reduced frame in the cache");
  setenv("OPENBLAS_NUM_THREADS", "1", 0); // read when the library loads: waiting threads spin
  return load_plugin(file);
}

/// Loaded on the first call and never unloaded: PETSc and MPI end with the process.
void *loaded_plugin()
{
  static void *const handle = load_library(frame_library);
  return handle;
}

template <typename Function>
Function *function(const char *name)
{
  return reinterpret_cast<Function *>(function_of_plugin(loaded_plugin(), name, frame_library));
}

} // namespace

FrameService &frame_service()
{
  static FrameService *const loaded = []
  {
    if (team_service())
      function<void()>("gestell_use_team")();
    return function<FrameService *()>("gestell_frame_service")();
  }();
  return *loaded;
}

bool has_frame_service()
{
  return !find_plugin(frame_library).empty();
}

MeshService &mesh_service()
{
  static MeshService *const loaded = []
  {
    frame_service();
    return function<MeshService *()>("gestell_mesh_service")();
  }();
  return *loaded;
}

void obey_in_frame_service(int order)
{
  static void *const plugin = load_library(rank_library);
  static const auto  obey_in_plugin =
      reinterpret_cast<void (*)(int)>(function_of_plugin(plugin, "gestell_obey", rank_library));
  obey_in_plugin(order);
}

} // namespace gestell::coupling
