#include "apps/commands/commands.h"
#include "apps/commands/progress.h"
#include "apps/scene/quantity.h"
#include "coupling/frame_service_loader.h"

#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>

namespace gestell::apps
{

namespace
{
/// A length given on the command line [m]; 0 if it is not given.
double length_option(const std::string &option, const std::string &text)
{
  if (text.empty())
    return 0.;
  const auto no_parameter = [](const std::string &) { return std::optional<Quantity>(); };
  char      *end          = nullptr;
  double     length       = std::strtod(text.c_str(), &end); // a plain number is in metres
  try
  {
    if (*end != '\0')
      length = value_as(parse_quantity(text, no_parameter), kind::length, text);
    if (length > 0.)
      return length;
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
  throw std::invalid_argument(option + ": needs a length above zero such as \"80 mm\", got " + text);
}

void print_triple(const char *name, const std::array<double, 3> &x)
{
  std::cout << "  " << name << " [" << x[0] << ", " << x[1] << ", " << x[2] << "]";
}
} // namespace

int mesh_command(const CommonOptions &options, const MeshCommandOptions &mesh)
{
  fem::FrameSpecification frame;
  frame.cad            = std::filesystem::absolute(options.input).string();
  frame.unit           = length_option("--unit", mesh.unit);
  frame.mesh.size      = length_option("--size", mesh.size);
  frame.mesh.max_cells = mesh.max_cells;
  frame.mesh.place     = "--size";
  frame.material       = {210e9, 0.3, 7850., "steel"};
  frame.place          = options.input;

  ProgressLine progress(options.quiet);
  const auto   report = coupling::frame_service().mesh(frame, [&](const std::string &phase, double share)
                                                       { progress.show(phase, share); });
  progress.done();

  std::cout << std::setprecision(6) << options.input << ": " << report.solids.size() << " solid(s), volume "
            << report.volume << " m^3, " << report.mass << " kg in steel\n";
  for (const std::string &solid : report.solids)
    std::cout << "  solid \"" << solid << "\"\n";
  std::cout << "mesh: " << report.n_points << " points, " << report.n_cells << " tetrahedra, about "
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
