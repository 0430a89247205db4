#include "tests/fuzz/mesh/mesh_targets.h"

#include "fem/geometry/cad_file.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/measure_body.h"
#include "fem/mesh/mesher.h"
#include "fem/values/mesh_phase.h"
#include "fem/values/temporary_directory.h"

#include <gmsh.h>

#include <Interface_Static.hxx>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <regex>
#include <stdexcept>
#include <typeinfo>

namespace gestell::fuzz
{
namespace
{

namespace occ = gmsh::model::occ;
using namespace gestell::fem;

/// What `act` leaves in gmsh as a file of this extension.
std::string written(const std::string &extension, const std::function<void()> &act)
{
  const TemporaryDirectory folder;
  const GmshSession        session;
  const std::string        file = (folder.path() / ("seed" + extension)).string();
  gmsh::option::setString("Geometry.OCCTargetUnit", "");
  act();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM"); // reading left metres behind
  gmsh::write(file);
  std::ifstream           in(file, std::ios::binary);
  const std::string       text{std::istreambuf_iterator<char>(in), {}};
  static const std::regex time("'[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}'"); // of the day, in the head of a STEP file
  return extension == ".step" ? std::regex_replace(text, time, "'2000-01-01T00:00:00'") : text;
}

void box(double length)
{
  occ::addBox(0., 0., 0., length, 0.5 * length, 0.4 * length);
  occ::synchronize();
}

void pierced_box(double length)
{
  const int block = occ::addBox(0., 0., 0., length, 0.5 * length, 0.4 * length),
            bore  = occ::addCylinder(0.5 * length, 0.25 * length, 0., 0., 0., 0.4 * length, 0.1 * length);
  gmsh::vectorpair              rest;
  std::vector<gmsh::vectorpair> parents;
  occ::cut({{3, block}}, {{3, bore}}, rest, parents);
  occ::synchronize();
}

/// Of tetrahedra, or in bricks.
void mesh(double version, bool binary, bool bricks)
{
  box(1.);
  if (bricks)
  {
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const auto &curve : curves)
      gmsh::model::mesh::setTransfiniteCurve(curve.second, 3);
    gmsh::vectorpair surfaces;
    gmsh::model::getEntities(surfaces, 2);
    for (const auto &surface : surfaces)
    {
      gmsh::model::mesh::setTransfiniteSurface(surface.second);
      gmsh::model::mesh::setRecombine(2, surface.second);
    }
    gmsh::model::mesh::setTransfiniteVolume(1);
  }
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.8);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.8);
  gmsh::model::addPhysicalGroup(3, {1}, 1);
  gmsh::model::setPhysicalName(3, 1, "block");
  gmsh::model::addPhysicalGroup(2, {1, 2}, 2);
  gmsh::model::setPhysicalName(2, 2, "foot");
  gmsh::option::setNumber("Mesh.SaveAll", 1);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::model::mesh::generate(3);
}

std::vector<std::string> meshes(double version, bool binary)
{
  std::vector<std::string> files;
  for (const bool bricks : {false, true})
    files.push_back(written(".msh", [&] { mesh(version, binary, bricks); }));
  return files;
}

std::vector<std::string> surfaces()
{
  std::vector<std::string> files;
  for (const bool binary : {false, true})
    files.push_back(written(".stl",
                            [&]
                            {
                              box(1.);
                              gmsh::option::setNumber("Mesh.MeshSizeMax", 1.);
                              gmsh::option::setNumber("Mesh.Binary", binary);
                              gmsh::model::mesh::generate(2);
                            }));
  return files;
}

std::vector<std::string> geometries(const std::string &extension, double length)
{
  return {written(extension, [&] { box(length); }), written(extension, [&] { pierced_box(length); })};
}

const std::vector<std::string> scripts = {
    "SetFactory(\"OpenCASCADE\");\nDefineConstant[ h = {0.4, Min 0.1, Name \"height\"} ];\nBox(1) = {0, 0, 0, 1, 0.5, "
    "h};\n"
    "Cylinder(2) = {0.5, 0.25, 0, 0, 0, h, 0.1};\nBooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
    "Physical Surface(\"foot\") = {1};\n",
    "// by gmsh's own kernel\nlc = 0.5;\nPoint(1) = {0, 0, 0, lc};\nPoint(2) = {1, 0, 0, lc};\nPoint(3) = {1, 1, 0, "
    "lc};\n"
    "Point(4) = {0, 1, 0, lc};\nLine(1) = {1, 2};\nLine(2) = {2, 3};\nLine(3) = {3, 4};\nLine(4) = {4, 1};\n"
    "Curve Loop(1) = {1, 2, 3, 4};\nPlane Surface(1) = {1};\nTransfinite Surface {1};\nRecombine Surface {1};\n"
    "out() = Extrude {0, 0, 0.5} { Surface{1}; Layers{2}; Recombine; };\nMesh 3;\n",
    "SetFactory(\"OpenCASCADE\");\nMacro Plate\n  v = newv; Box(v) = {x, 0, 0, 0.2, 1, 1};\nReturn\n"
    "For i In {0:2}\n  x = 0.2 * i;\n  If (i > 0)\n    Call Plate;\n  Else\n    Box(100) = {0, 0, 0, 0.2, 1, 1};\n  "
    "EndIf\nEndFor\n"
    "Field[1] = Box; Field[1].VIn = 0.2; Field[1].XMax = 1;\nBackground Field = 1;\nMesh.MeshSizeMax = 0.5;\n"
    "Printf(\"%g plates\", i);\n"};

std::vector<std::string> input_files()
{
  const std::string nodes =
      "*HEADING\n cube\n*NODE, NSET=ALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 1., 1., 0.\n"
      "5, 0., 0., 1.\n6, 1., 0., 1.\n7, 0., 1., 1.\n8, 1.D0, 1., 1.\n";
  return {nodes + "*ELEMENT, TYPE=C3D4, ELSET=Block\n1, 1, 2, 4, 8\n2, 1, 2, 6, 8\n3, 1, 3, 4, 8\n4, 1, 3, 7, 8\n"
                  "5, 1, 5, 6, 8\n6, 1, 5, 7, 8\n*NSET, NSET=FOOT\n1, 2,\n3, 4\n*NSET, NSET=TWO\nFOOT, 5\n"
                  "*ELSET, ELSET=LOW, GENERATE\n1, 3, 2\n*SURFACE, NAME=bottom, TYPE=ELEMENT\nLOW, S1\n"
                  "*SOLID SECTION, ELSET=BLOCK, MATERIAL=steel\n*MATERIAL, NAME=steel\n*ELASTIC\n210000, 0.3\n",
          nodes + "*ELEMENT, TYPE=C3D8R, ELSET=BRICK\n1, 1, 2, 4, 3,\n5, 6, 8, 7\n*ELEMENT, TYPE=S4, ELSET=TOP\n"
                  "2, 5, 6, 8, 7\n*SURFACE, NAME=side\n1, S3\n",
          nodes + "9, .5, 0, 0\n10, .5, .5, 0\n11, 0, .5, 0\n12, 0, 0, .5\n13, .5, 0, .5\n14, 0, .5, .5\n"
                  "*ELEMENT, TYPE=C3D10, ELSET=TET\n1, 1, 2, 3, 5, 9, 10, 11, 12, 13, 14\n"
                  "*ELEMENT, TYPE=C3D6\n2, 2, 4, 3, 6, 8, 7\n"};
}

std::string name_of(const std::string &path)
{
  return path.substr(path.rfind('/') + 1);
}

void require(bool holds, const std::string &what)
{
  if (!holds)
    throw std::logic_error(what);
}

void require_sound(const Mesh &mesh)
{
  for (const Point3 &point : mesh.points)
    for (const double x : point)
      require(std::isfinite(x), "a point is not finite");
  require(mesh.n_cells() > 0 && !mesh.skin.empty(), "a mesh without cells or skin");
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int n = cell_shape(mesh.kind(cell)).n_corners;
    for (int k = 0; k < n; ++k)
      require(mesh.corners(cell)[k] >= 0 && mesh.corners(cell)[k] < static_cast<int>(mesh.points.size()),
              "a corner is no point");
    require(cell_quality(mesh, cell) > 0., "a cell without volume");
  }
  for (const auto &triangle : mesh.skin)
    for (const int corner : triangle)
      require(corner >= 0 && corner < static_cast<int>(mesh.points.size()), "a corner of the skin is no point");
}

void require_sound(const GeometryReport &report)
{
  require(std::isfinite(report.volume) && report.volume > 0., "a frame without volume");
  require(!report.solids.empty(), "a frame without solids");
  for (const Face &face : report.faces)
    require(std::isfinite(face.area) && face.area >= 0., "a face without an area");
}

void require_sound(const CadBody &body)
{
  require(std::isfinite(body.volume) && body.volume > 0., "a part without volume");
  require(body.centre.allFinite() && body.inertia.allFinite(), "a part whose integrals are not finite");
  require(body.inertia.diagonal().minCoeff() >= 0., "a part with a negative moment of inertia");
}

/// Thrown out of meshing, which may take as long as it likes.
struct Stopped
{
};

class Stopwatch
{
public:
  void operator()(const std::string &phase, double) const
  {
    constexpr std::chrono::seconds patience{2};
    if (phase != mesh_phase::reading && std::chrono::steady_clock::now() - begin_ > patience)
      throw Stopped();
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void read(const std::string &path, std::uint64_t number)
{
  const auto kind = kind_of_file(path);
  if (kind == CadFile::triangles)
    return require_sound(measure_part({path, 1., "fuzz"}));
  FrameSpecification frame;
  frame.cad            = path;
  frame.place          = "fuzz";
  frame.mesh.place     = "fuzz.mesh";
  frame.mesh.size      = 0.5;
  frame.mesh.max_cells = 20000;
  frame.material       = {2.1e11, 0.3, 7850., "fuzz"};
  frame.mesh.bodies    = number % 2 == 0 ? 1 : 2;
  if (kind == CadFile::mesh || kind == CadFile::abaqus)
  {
    require_sound(make_mesh(frame));
    if (number % 4 == 0)
      require_sound(inspect_geometry(frame));
    if (number % 4 == 1)
      require_sound(measure_part({path, 0., "fuzz"}));
    if (number % 4 == 2)
      require_sound(report_geometry(frame));
  }
  else if (number % 8 == 0)
    require_sound(make_mesh(frame, Stopwatch()));
  else if (number % 8 == 1)
    require_sound(measure_part({path, 0., "fuzz"}));
  else if (number % 8 == 2)
    require_sound(report_geometry(frame, Stopwatch()));
  else
    require_sound(inspect_geometry(frame));
}

} // namespace

const std::vector<MeshTarget> &mesh_targets()
{
  static const std::vector<MeshTarget> targets = {{"msh2", ".msh", meshes(2.2, false)},
                                                  {"msh2_binary", ".msh", meshes(2.2, true)},
                                                  {"msh4", ".msh", meshes(4.1, false)},
                                                  {"msh4_binary", ".msh", meshes(4.1, true)},
                                                  {"geo", ".geo", scripts},
                                                  {"step", ".step", geometries(".step", 1000.)},
                                                  {"brep", ".brep", geometries(".brep", 1.)},
                                                  {"stl", ".stl", surfaces()},
                                                  {"inp", ".inp", input_files()}};
  return targets;
}

const MeshTarget &mesh_target(const std::string &name)
{
  std::string names;
  for (const MeshTarget &target : mesh_targets())
    if (target.name == name)
      return target;
    else
      names += (names.empty() ? "" : ", ") + target.name;
  throw std::invalid_argument("there is no target " + name + "; there are " + names);
}

std::vector<std::string> mesh_target_names()
{
  return {"msh2", "msh2_binary", "msh4", "msh4_binary", "geo", "step", "brep", "stl", "inp"};
}

Judgement judge(const std::string &path, std::uint64_t number)
{
  try
  {
    read(path, number);
    return {Outcome::taken, ""};
  }
  catch (const std::invalid_argument &refused)
  {
    const std::string words = refused.what();
    return {words.find(name_of(path)) == std::string::npos && words.rfind("fuzz", 0) != 0 ? Outcome::finding
                                                                                          : Outcome::refused,
            words};
  }
  catch (const std::bad_alloc &)
  {
    return {Outcome::memory, "out of memory"};
  }
  catch (const Stopped &)
  {
    return {Outcome::long_, "meshing"};
  }
  catch (const std::exception &broken)
  {
    return {Outcome::finding, std::string(typeid(broken).name()) + ": " + broken.what()};
  }
  catch (...)
  {
    return {Outcome::finding, "an exception without words"};
  }
}

} // namespace gestell::fuzz
