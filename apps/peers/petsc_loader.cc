// Finds the plugin with PETSc. Loading takes half a second, and is needed only for these methods.

#include "apps/peers/stepper.h"
#include "coupling/plugin/plugin.h"

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

namespace gestell::peers
{
namespace
{

constexpr const char *library = "libgestell_petsc_peers.so";

using Entry = Stepper *(*)(Callbacks *, const PeerProblem *, const PeerOptions *);

Entry load()
{
  const auto file = coupling::find_plugin(library);
  if (file.empty())
    throw std::invalid_argument(std::string("peers: ") + library +
                                " not found: this build has no PETSc; build it with " + "GESTELL_FEM=ON.");
  setenv("OPENBLAS_NUM_THREADS", "1", 0); // read when the library loads: waiting threads spin
  return reinterpret_cast<Entry>(
      coupling::function_of_plugin(coupling::load_plugin(file), "gestell_petsc_stepper", library));
}

} // namespace

bool petsc_available()
{
  return !coupling::find_plugin(library).empty();
}

std::unique_ptr<Stepper> make_petsc(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  static const Entry entry = load(); // never unloaded: PETSc and MPI end with the process
  return std::unique_ptr<Stepper>(entry(&callbacks, &problem, &options));
}

} // namespace gestell::peers
