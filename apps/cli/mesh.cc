#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/command_answers.h"
#include "apps/cli/json_answer.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/faces/faces_page.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/paraview/face_surface.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/quantity.h"
#include "apps/scene/read/read_material.h"
#include "apps/version.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_report.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

namespace gestell::apps
{

namespace
{

struct MeshCommandOptions
{
  std::string size; ///< a length such as "80 mm", plain numbers in m; empty: chosen for some 25 000 cells
  std::string unit; ///< length of what the file calls 1, such as "1 mm"; empty: the file knows
  double      max_cells = 2e6;
  std::string gap;                      ///< a length: solids at most that far apart are joined
  std::string density;                  ///< of all solids; by default of the file, else of steel
  std::string sew;                      ///< a length: edges at most that far apart are joined
  std::string defeature;                ///< a length: smaller faces and edges are removed
  std::string overlaps  = "refused";    ///< or "once"
  std::string plates    = "tetrahedra"; ///< or "swept"
  int         bodies    = 1;            ///< expected
  bool        selectors = false;        ///< surfaces as scene keys
  std::string folder;                   ///< for the page of the faces; empty: none
};

/// A quantity given on the command line, in SI units; 0 if it is not given.
double option_of(const std::string &option, const std::string &text, const Kind &kind, const std::string &example)
{
  if (text.empty())
    return 0.;
  const auto no_parameter = [](const std::string &) { return std::optional<Quantity>(); };
  char      *end          = nullptr;
  double     value        = std::strtod(text.c_str(), &end); // a plain number is in SI units
  try
  {
    if (*end != '\0')
      value = value_as(parse_quantity(text, no_parameter, {}, &kind), kind, text);
    if (value > 0. && std::isfinite(value))
      return value;
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(option + ": " + error.what());
  }
  throw std::invalid_argument(option + ": needs a " + kind.name + " above zero such as \"" + example + "\", got " +
                              text);
}

double length_option(const std::string &option, const std::string &text)
{
  return option_of(option, text, kind::length, "80 mm");
}

/// "in steel", "at 2700 kg/m^3 (EN AW-6060)"
std::string weighed(double density, const std::string &material = "")
{
  constexpr double steel = 7850.; // [kg/m^3] as the report takes without other knowledge
  return std::abs(density / steel - 1.) < 1e-9 && material.empty() // 1e-9: rounding
             ? "in steel"
             : "at " + short_text(density) + " kg/m^3" + (material.empty() ? "" : " (" + material + ")");
}

void print_triple(const char *name, const std::array<double, 3> &x)
{
  std::cout << name << " [";
  for (int d = 0; d < 3; ++d)
    std::cout << (d > 0 ? ", " : "") << std::round(x[d] * 1e6) * 1e-6 + 0.; // OpenCASCADE widens boxes by 1e-7
  std::cout << "]";
}

std::string gibibytes(double bytes)
{
  std::ostringstream text;
  text << std::setprecision(3) << bytes / (1024. * 1024. * 1024.) << " GiB";
  return text.str();
}

fem::FrameSpecification frame_of(const CommonOptions &options, const MeshCommandOptions &mesh)
{
  fem::FrameSpecification frame;
  frame.cad            = std::filesystem::absolute(options.input).string();
  frame.unit           = length_option("--unit", mesh.unit);
  frame.mesh.size      = length_option("--size", mesh.size);
  frame.mesh.gap       = length_option("--gap", mesh.gap);
  frame.mesh.defeature = length_option("--defeature", mesh.defeature);
  frame.sew            = length_option("--sew", mesh.sew);
  frame.mesh.bodies    = mesh.bodies;
  frame.mesh.overlaps  = mesh.overlaps == "once" ? fem::Overlaps::once : fem::Overlaps::refused;
  frame.mesh.plates    = mesh.plates == "swept" ? fem::Plates::swept : fem::Plates::tetrahedra;
  frame.mesh.max_cells = mesh.max_cells;
  frame.mesh.place     = "gestell mesh";
  frame.material.rho   = option_of("--density", mesh.density, kind::density, "2700 kg/m^3");
  frame.place          = "gestell mesh";
  frame.scripts        = options.scripts;
  return frame;
}

void print_solids(const coupling::MeshReport &report)
{
  for (const coupling::SolidReport &solid : report.solids)
  {
    std::cout << "  solid \"" << solid.name << "\": " << solid.volume << " m^3, " << solid.mass << " kg "
              << weighed(solid.density, solid.material);
    print_triple(", from", solid.min);
    print_triple(" to", solid.max);
    std::cout << '\n';
  }
}

void print_mesh(const coupling::MeshReport &report)
{
  std::cout << "mesh: ";
  if (report.size > 0.)
    std::cout << "size " << report.size << " m, ";
  std::cout << report.n_points << " points, " << report.n_cells << ' ' << report.cells;
  if (report.expected_cells > 0.)
    std::cout << " (about " << std::setprecision(2) << report.expected_cells << " expected)" << std::setprecision(6);
  std::cout << ", about " << report.n_coordinates << " DOFs, element quality " << report.worst_quality << " (worst), "
            << report.mean_quality << " (mean); 1 is regular\n"
            << "memory: a reduction takes about " << gibibytes(report.memory) << ", available are "
            << gibibytes(report.available_memory) << '\n';
  for (const std::string &feature : report.features)
    std::cout << "features: " << feature << '\n';
}

void print_surfaces(const coupling::MeshReport &report)
{
  std::cout << "surfaces:\n";
  for (const coupling::SurfaceReport &surface : report.surfaces)
  {
    std::cout << "  " << std::setw(4) << surface.tag << "  " << std::left << std::setw(10) << surface.type
              << std::right;
    if (!surface.name.empty())
      std::cout << " \"" << surface.name << '"';
    std::cout << "  area " << surface.area << " m^2";
    print_triple("  from", surface.min);
    print_triple("  to", surface.max);
    std::cout << '\n';
  }
}

/// Prints selectors in a form that can be pasted into a scene.
void print_selectors(const coupling::MeshReport &report)
{
  for (const coupling::SurfaceReport &surface : report.surfaces)
  {
    std::string entry = face_entry(surface);
    entry.insert(entry.find('\n'), " # " + surface.type + ", area " + rounded(surface.area, 6) + " m^2" +
                                       (surface.name.empty() ? "" : ", \"" + surface.name + "\""));
    std::cout << '\n' << entry;
  }
}

/// faces.html and faces.vtp.
void write_faces(const std::filesystem::path &folder, const coupling::MeshReport &report, const std::string &file)
{
  OwnFolder own(folder);
  own.write("faces.html", faces_page(report, file, version));
  const std::string warning = write_face_surface(own.claim("faces.vtp"), report);
  if (!warning.empty())
    std::cerr << "gestell: warning: " << warning << '\n';
  std::cout << "interactive 3-D view of the faces: " << (folder / "faces.html").string()
            << (warning.empty() ? ", for ParaView: " + (folder / "faces.vtp").string() : "") << '\n';
}

int make_mesh(const CommonOptions &options, const MeshCommandOptions &mesh)
{
  const fem::FrameSpecification frame = frame_of(options, mesh);
  if (const std::string suspicion = suspect_density(frame.material.rho); frame.material.rho > 0. && !suspicion.empty())
    std::cerr << "gestell: warning: --density " << suspicion << '\n';
  std::optional<ResultsLock> held;
  if (!mesh.folder.empty())
  {
    held.emplace(mesh.folder);
    OwnFolder(mesh.folder).require_free({"faces.html", "faces.vtp"}, {options.input});
  }
  ProgressLine progress(options.quiet);
  const auto   report = coupling::frame_service().mesh(frame, [&](const std::string &phase, double share)
                                                       { progress.show(phase, share); });
  progress.done();
  if (answers_in_json())
    answer_with(mesh_answer(report));

  std::cout << std::setprecision(6) << options.input << ": " << report.solids.size() << " solid(s), volume "
            << report.volume << " m^3, " << report.mass << " kg " << weighed(report.mass / report.volume) << '\n';
  print_solids(report);
  for (const std::string &statement : report.statements)
    std::cout << statement << '\n';
  for (const std::string &note : report.notes)
    std::cout << "note: " << note << '\n';
  print_mesh(report);
  if (mesh.selectors)
    print_selectors(report);
  else
    print_surfaces(report);
  if (!mesh.folder.empty())
    write_faces(mesh.folder, report, options.input);
  return exit_done;
}

} // namespace

Command mesh_command()
{
  const auto own = std::make_shared<MeshCommandOptions>();
  return {
      "mesh",
      "mesh a CAD file; list quality, surfaces and solids",
      {"gestell mesh meshes/press_frame.step --size '80 mm'", "gestell mesh meshes/press_frame.step -o results/faces"},
      CommandInput::cad,
      {{"-o,--output", &own->folder, "folder for faces.html, an interactive 3-D view of all faces, and faces.vtp"},
       {"--size", &own->size, "element size, such as \"80 mm\""},
       {"--unit", &own->unit, "length unit of a file without one, such as \"1 mm\""},
       CommandOption{"--max-cells", &own->max_cells, "largest number of elements"}.above_zero(),
       {"--gap", &own->gap, "join solids that are at most this far apart, such as \"0.1 mm\""},
       CommandOption{"--bodies", &own->bodies, "expected number of separate bodies"}.above_zero(),
       CommandOption{"--overlaps", &own->overlaps,
                     "overlapping solids: refused (default), or once: the common volume is assigned to the first solid"}
           .one_of({"refused", "once"}),
       CommandOption{"--plates", &own->plates, "tetrahedra, or swept: hexahedra through the thickness of walls"}.one_of(
           {"tetrahedra", "swept"}),
       {"--density", &own->density,
        "density of all solids, such as \"2700 kg/m^3\" (default: that of the STEP file, else steel)"},
       {"--sew", &own->sew, "join edges of open shells that are at most this far apart, such as \"0.05 mm\""},
       {"--defeature", &own->defeature, "remove faces and edges smaller than this, such as \"2 mm\""},
       {"--selectors", &own->selectors, "print surfaces as tables [frame.surface.NAME] of a scene"}},
      [own](const CommonOptions &options) { return make_mesh(options, *own); }};
}

} // namespace gestell::apps
