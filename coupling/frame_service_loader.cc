#include "coupling/frame_service_loader.h"

#include "coupling/mesh_service.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

namespace fs = std::filesystem;

constexpr const char *library = "libgestell_frame.so";

fs::path plugin()
{
  std::error_code ignored;
  fs::path        beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / library;
  if (fs::exists(beside, ignored))
    return beside;
  const char *folder = std::getenv("GESTELL_PLUGIN_DIR");
  if (folder && fs::exists(fs::path(folder) / library, ignored))
    return fs::path(folder) / library;
  throw std::invalid_argument(
      "frame_service: " + beside.string() +
      " not found: this build of gestell cannot mesh and "
      "reduce frames; build it with GESTELL_FEM=ON, or set GESTELL_PLUGIN_DIR to the folder of " +
      library + ", or run from a reduced frame in the cache");
}

void *load()
{
  const fs::path path = plugin();
  setenv("OPENBLAS_NUM_THREADS", "1", 0); // read when the library loads: waiting threads spin
  void *handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw std::invalid_argument("frame_service: " + path.string() + " cannot be loaded: " + dlerror() +
                                "; install the libraries it names");
  return handle;
}

/// Loaded on the first call and never unloaded: PETSc and MPI end with the process.
void *loaded_plugin()
{
  static void *const handle = load();
  return handle;
}

/// What the function of the plugin returns.
template <typename Service>
Service *service(const char *function)
{
  const auto entry = reinterpret_cast<Service *(*)()>(dlsym(loaded_plugin(), function));
  if (!entry)
    throw std::invalid_argument("frame_service: " + plugin().string() + " is not a plugin of Gestell: " + dlerror() +
                                "; rebuild it together with the program");
  return entry();
}

} // namespace

FrameService &frame_service()
{
  static FrameService *const loaded = service<FrameService>("gestell_frame_service");
  return *loaded;
}

MeshService &mesh_service()
{
  static MeshService *const loaded = service<MeshService>("gestell_mesh_service");
  return *loaded;
}

} // namespace gestell::coupling
