// Takes the place of paraview.cc in a build without VTK.
#include "apps/output/paraview/paraview.h"

namespace gestell::apps
{

std::vector<std::string> write_paraview(const std::filesystem::path &, const Result &, std::vector<std::string> &)
{
  return {"This build has no VTK: motion.pvd, frame_modes.pvd and stress.pvd were left out. Install libvtk9-dev and "
          "configure again "
          "to have them."};
}

} // namespace gestell::apps
