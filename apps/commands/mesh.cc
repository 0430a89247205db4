#include "apps/commands/commands.h"
#include "apps/commands/progress.h"
#include "coupling/frame_service_loader.h"

#include <filesystem>
#include <iomanip>
#include <iostream>

namespace gestell::apps
{

namespace
{
void print_triple(const char *name, const std::array<double, 3> &x)
{
  std::cout << "  " << name << " [" << x[0] << ", " << x[1] << ", " << x[2] << "]";
}
} // namespace

int mesh_command(const CommonOptions &options, const MeshCommandOptions &mesh)
{
  fem::FrameSpecification frame;
  frame.cad            = std::filesystem::absolute(options.input).string();
  frame.unit           = mesh.unit;
  frame.mesh.size      = mesh.size;
  frame.mesh.max_cells = mesh.max_cells;
  frame.mesh.place     = "--size";
  frame.material       = {210e9, 0.3, 7850., "steel"};
  frame.place          = options.input;

  ProgressLine progress(options.quiet);
  const auto   report = coupling::frame_service().mesh(frame, [&](const std::string &phase, double share)
                                                       { progress.show(phase, share); });
  progress.done();

  std::cout << std::setprecision(6) << options.input << ": " << report.solids.size() << " solid(s), volume "
            << report.volume << " m^3, " << report.mass << " kg in steel\n"
            << "mesh: " << report.n_points << " points, " << report.n_cells << " tetrahedra, about "
            << report.n_coordinates << " coordinates, worst quality " << report.worst_quality << "\nsurfaces:\n";
  for (const coupling::SurfaceReport &surface : report.surfaces)
  {
    std::cout << "  " << std::setw(4) << surface.tag << "  " << std::left << std::setw(10) << surface.type
              << std::right;
    if (!surface.name.empty())
      std::cout << " \"" << surface.name << '"';
    std::cout << "  area " << surface.area << " m^2";
    print_triple("from", surface.min);
    print_triple("to", surface.max);
    std::cout << '\n';
  }
  return exit_done;
}

} // namespace gestell::apps
