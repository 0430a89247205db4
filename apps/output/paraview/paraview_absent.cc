// Replaces paraview.cc in a build without VTK.
#include "apps/output/paraview/face_surface.h"
#include "apps/output/paraview/paraview.h"

namespace gestell::apps
{

std::string lacks_for_paraview()
{
  return "This build has no VTK: motion.pvd, frame_modes.pvd and stress.pvd were not written. To get them, install "
         "libvtk9-dev and configure again.";
}

const std::vector<WriteSeries *> &paraview_series()
{
  static const std::vector<WriteSeries *> none;
  return none;
}

std::string write_face_surface(const std::filesystem::path &, const coupling::MeshReport &)
{
  return "This build has no VTK: faces.vtp was not written. To get it, install libvtk9-dev and configure again.";
}

} // namespace gestell::apps
