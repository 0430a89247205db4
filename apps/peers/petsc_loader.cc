// Finds the plugin that holds PETSc: loading it takes half a second, which only those pay who ask for it.

#include "apps/peers/stepper.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace gestell::peers
{
namespace
{

namespace fs = std::filesystem;

constexpr const char *library = "libgestell_petsc_peers.so";

using Entry = Stepper *(*)(Callbacks *, const PeerProblem *, const PeerOptions *);

fs::path plugin()
{
  std::error_code ignored;
  const fs::path  beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / library;
  if (fs::exists(beside, ignored))
    return beside;
  const char *folder = std::getenv("GESTELL_PLUGIN_DIR");
  return folder && fs::exists(fs::path(folder) / library, ignored) ? fs::path(folder) / library : fs::path();
}

Entry load()
{
  const fs::path path = plugin();
  if (path.empty())
    throw std::invalid_argument(std::string("peers: ") + library +
                                " not found: this build has no PETSc; build it with " + "GESTELL_FEM=ON.");
  setenv("OPENBLAS_NUM_THREADS", "1", 0); // read when the library loads: waiting threads spin
  void *handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw std::invalid_argument("peers: " + path.string() + " cannot be loaded: " + dlerror());
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, "gestell_petsc_stepper"));
  if (!entry)
    throw std::invalid_argument("peers: " + path.string() + " is not a plugin of Gestell: " + dlerror());
  return entry;
}

} // namespace

bool petsc_available()
{
  return !plugin().empty();
}

std::unique_ptr<Stepper> make_petsc(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  static const Entry entry = load(); // never unloaded: PETSc and MPI end with the process
  return std::unique_ptr<Stepper>(entry(&callbacks, &problem, &options));
}

} // namespace gestell::peers
