#include "fem/geometry/read_cad.h"

#include "fem/geometry/cad_file.h"
#include "fem/geometry/cad_shape.h"
#include "fem/geometry/defeature.h"
#include "fem/geometry/gmsh_faces.h"
#include "fem/geometry/inp/inp_file.h"
#include "fem/geometry/read_shapes.h"
#include "fem/geometry/script_sandbox.h"
#include "fem/geometry/sewing.h"
#include "fem/geometry/shells.h"
#include "fem/geometry/solid_union.h"
#include "fem/values/cad_source.h"
#include "fem/values/vector3.h"

#include <Precision.hxx>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

namespace
{

/// gmsh's types of the same cells without and with middle nodes, and the nodes of the second.
struct Degrees
{
  int         linear, quadratic;
  std::size_t n_corners, n_nodes;
};
constexpr Degrees both[] = {{4, 11, 4, 10}, {5, 17, 8, 20}, {6, 18, 6, 15}};

/// gmsh finds but one of both degrees of a kind of cells in a volume: there the corners of the quadratic ones are
/// taken.
void make_degrees_equal(InpMesh &mesh)
{
  std::set<std::pair<std::string, int>> there;
  for (const auto &elements : mesh.elements)
    there.emplace(elements.solid, elements.gmsh_type);
  for (auto &elements : mesh.elements)
    for (const auto &[linear, quadratic, n_corners, n_nodes] : both)
    {
      if (elements.gmsh_type != quadratic || there.count({elements.solid, linear}) == 0)
        continue;
      elements.gmsh_type = linear;
      std::vector<std::size_t> corners;
      for (std::size_t i = 0; i < elements.nodes.size(); i += n_nodes)
        corners.insert(corners.end(), &elements.nodes[i], &elements.nodes[i] + n_corners);
      elements.nodes = std::move(corners);
      mesh.notes.push_back("the solid \"" + elements.solid +
                           "\" has cells with and without middle nodes: all get straight edges");
      break;
    }
}

/// Loads the mesh of an .inp file into gmsh, a volume for every solid.
/// @throws std::invalid_argument as read_inp()
MeshGroups load_inp(CadModel &model, const CadSource &source)
{
  InpMesh mesh = read_inp(source);
  make_degrees_equal(mesh);
  model.notes = mesh.notes;
  if (mesh.elements.empty())
    return {};
  std::map<std::string, int> volume;
  for (const auto &elements : mesh.elements)
  {
    const auto [entry, is_new] = volume.try_emplace(elements.solid, static_cast<int>(volume.size()) + 1);
    if (!is_new)
      continue;
    gmsh::model::addDiscreteEntity(3, entry->second);
    gmsh::model::setEntityName(3, entry->second, elements.solid);
    if (entry->second == 1)
      gmsh::model::mesh::addNodes(3, 1, mesh.numbers, mesh.coordinates);
  }
  for (const auto &elements : mesh.elements)
    gmsh::model::mesh::addElementsByType(volume.at(elements.solid), elements.gmsh_type, elements.numbers,
                                         elements.nodes);
  return {mesh.node_sets, mesh.faces};
}

std::string physical_name(int dim, int tag)
{
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
  std::string name;
  if (!groups.empty())
    gmsh::model::getPhysicalName(dim, groups.front(), name);
  return name;
}

std::string name_of_solid(int tag)
{
  std::string name;
  gmsh::model::getEntityName(3, tag, name);
  name = name.empty() ? physical_name(3, tag) : name_in_label(name);
  return name.empty() ? "solid " + std::to_string(tag) : name;
}

Solid solid_of(int tag, double unit, bool meshed)
{
  Solid solid;
  if (!meshed)
    solid = measured_solid(tag, unit);
  solid.tag  = tag;
  solid.name = name_of_solid(tag);
  return solid;
}

/// A script may mesh by itself ("Mesh 3;"): then it is a mesh, whatever kernel drew it.
bool has_cells()
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 3);
  return !types.empty();
}

void check_kernel(const CadSource &source)
{
  gmsh::vectorpair of_model, of_opencascade;
  gmsh::model::getEntities(of_model, 3);
  gmsh::model::occ::getEntities(of_opencascade, 3);
  if (of_model.size() != of_opencascade.size())
    throw std::invalid_argument(
        source.place + ": " + source.path +
        " uses gmsh's built-in kernel, which cannot identify planes and cylinders; begin it with "
        "SetFactory(\"OpenCASCADE\"), or end it with \"Mesh 3;\" so that it makes its mesh.");
}

/// Cells of surfaces in a mesh file.
std::size_t shell_cells(const CadModel &model)
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2);
  std::size_t n = 0;
  for (const auto &of_type : elements)
    n += of_type.size();
  for (const auto &[name, faces] : model.groups.faces) // of an .inp
    n += faces.size();
  return n;
}

void check_solids(const CadModel &model, const CadSource &source, const GmshSession &session)
{
  const std::string head = source.place + ": " + source.path;
  if (model.solids.empty())
  {
    gmsh::vectorpair faces;
    gmsh::model::getEntities(faces, 2);
    const std::string said    = session.errors();
    const std::string what    = faces.empty()
                                    ? "no shape"
                                    : "no closed solid, only " + std::to_string(faces.size()) +
                                       " faces (shells or surfaces)" + (model.meshed ? "" : open_edges_of_faces(model));
    const std::size_t n_shell = model.meshed ? shell_cells(model) : 0;
    const std::string cells   = n_shell == 0 ? " holds no tetrahedra"
                                             : " holds " + std::to_string(n_shell) +
                                                 " triangles and quadrilaterals (a shell or a skin), but no tetrahedra";
    throw std::invalid_argument(
        head + (model.meshed ? cells : " holds " + what) + (said.empty() ? "" : " (gmsh: " + said + ")") +
        "; needed is at least one " +
        (model.meshed
             ? "volume meshed with tetrahedra: mesh it in 3D before saving; model a plate as a solid of its thickness."
             : "closed solid: " + way_to_close(source) + "."));
  }
  for (const Solid &solid : model.solids)
    if (!model.meshed && !(solid.volume > 0.))
      throw std::invalid_argument(head + ": solid \"" + solid.name + "\" has a volume of " + text(solid.volume) +
                                  " m^3; it is open or turned inside out: repair it in the CAD program.");
}

/// Edges that coincide within the tolerance of CAD leave faces whose area is rounding of either sign.
void check_faces(const CadModel &model, const CadSource &source)
{
  gmsh::vectorpair faces; // a script may draw others by gmsh's own kernel, which knows no areas
  gmsh::model::occ::getEntities(faces, 2);
  for (const auto &[dim, tag] : faces)
  {
    double  area = 0.;
    Vector3 min, max;
    gmsh::model::occ::getMass(dim, tag, area);
    gmsh::model::occ::getBoundingBox(dim, tag, min[0], min[1], min[2], max[0], max[1], max[2]);
    min                               = model.unit * min;
    max                               = model.unit * max;
    area                              = model.unit * model.unit * area;
    constexpr double width_of_slivers = 1e-6; // by the diagonal: CAD programs agree on points to about 1e-7 of it
    if (!std::isfinite(area) || area < -width_of_slivers * model.diagonal() * norm(max - min))
      throw std::invalid_argument(source.place + ": " + source.path + ": the face " + std::to_string(tag) + " from " +
                                  text(min) + " to " + text(max) + " has an area of " + text(area) +
                                  " m^2, so its boundary is open or turned inside out; repair it in the CAD program.");
  }
}

/// How another unit is given, if lengths are wrong by a factor of a thousand.
std::string way_to_another_unit(const CadModel &model, const CadSource &source)
{
  const double diagonal = model.diagonal(), likely = diagonal > 1. ? 1e-3 : 1e3;
  return (is_step(source.path)
              ? "export it again with the right unit, or set unit to the true length of the file's millimetre"
              : "set unit to the length of the file's unit, such as \"mm\"") +
         (" (unit = " + text(likely * (is_step(source.path) && source.unit == 0. ? 1e-3 : model.unit))) +
         " m would make it " + text(diagonal * likely) + " m)";
}

void check_size(const CadModel &model, const CadSource &source)
{
  const double     diagonal          = model.diagonal();
  constexpr double smallest_diagonal = 1e-3; // [m] a millimetre: below, units are wrong
  constexpr double largest_diagonal  = 200.; // [m] above, units are wrong
  if (diagonal < smallest_diagonal || diagonal > largest_diagonal)
    throw std::invalid_argument(
        source.place + ": " + source.path + " is " + text(diagonal) + " m across; sizes from " +
        text(smallest_diagonal) + " m to " + text(largest_diagonal) +
        " m are expected, so its unit is probably wrong: " + way_to_another_unit(model, source) + ".");
  constexpr double farthest = 1e7; // from the origin by the diagonal: nine digits are left of lengths
  if (const double distance = norm(0.5 * (model.min + model.max)); distance > farthest * diagonal)
    throw std::invalid_argument(source.place + ": " + source.path + " is " + text(diagonal) + " m across and is " +
                                text(distance) +
                                " m from the origin, where its lengths lose half of their digits; move it closer to "
                                "the origin in the CAD program.");
}

} // namespace

std::string suspect_size(const CadModel &model, const CadSource &source)
{
  const double     diagonal        = model.diagonal();
  constexpr double smallest_likely = 0.02; // [m]: beyond these few frames are
  constexpr double largest_likely  = 50.;  // [m]
  if (diagonal >= smallest_likely && diagonal <= largest_likely)
    return "";
  return source.path + " is " + text(diagonal) + " m across, unusual for a frame: are its lengths in " +
         (diagonal > 1. ? "millimetres, read as metres" : "metres, read as millimetres") + "? If so, " +
         way_to_another_unit(model, source);
}

namespace
{

/// @param opened  that gmsh opens instead of source.path
CadModel read_model(const CadSource &source, CadFile file, const std::string &opened, const GmshSession &session)
{
  CadModel model;
  model.meshed = is_mesh(file) || file == CadFile::triangles;
  model.unit   = source.unit > 0. ? source.unit : 1.;

  session.run(
      [&]
      {
        if (file == CadFile::step || file == CadFile::brep)
        {
          const auto shape = file == CadFile::step ? read_step(source) : read_brep(source);
          if (source.sew > 0.)
            model.statements.push_back(sew(*shape, source, model.unit));
          model.shape = shape;
          give_to_gmsh(shape->whole, file == CadFile::brep ? Precision::Confusion() : 0.);
        }
        else
          file == CadFile::abaqus ? void(model.groups = load_inp(model, source)) : gmsh::open(opened);
      },
      source.place + ": gmsh cannot read " + source.path + ": ",
      "; it may be damaged: export the model again, and check that gmsh opens it.");
  model.meshed = model.meshed || (file == CadFile::geo && has_cells());
  if (!model.meshed)
    check_kernel(source);

  gmsh::vectorpair solids;
  gmsh::model::getEntities(solids, 3);
  for (const auto &[dim, tag] : solids)
    model.solids.push_back(solid_of(tag, model.unit, model.meshed));
  session.run([&] { apply_labels(model); }, source.place + ": " + source.path + ": ", ".");
  if (file != CadFile::triangles)
    check_solids(model, source, session);

  auto &[x0, y0, z0] = model.min;
  auto &[x1, y1, z1] = model.max;
  gmsh::model::getBoundingBox(-1, -1, x0, y0, z0, x1, y1, z1);
  model.min = model.unit * model.min;
  model.max = model.unit * model.max;
  check_size(model, source);
  if (!model.meshed)
    check_faces(model, source);
  return model;
}

} // namespace

CadModel open_cad(const CadSource &source, const GmshSession &session)
{
  const CadFile       file = check_cad_file(source);
  const ScriptSandbox harmless(source, file);
  try
  {
    return read_model(source, file, harmless.path(), session);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(harmless.in_own_names(error.what()));
  }
}

CadSource source_of(const FrameSpecification &specification)
{
  return {specification.cad, specification.unit, specification.place, specification.scripts, specification.sew};
}

CadModel read_cad(const FrameSpecification &specification, const GmshSession &session)
{
  const CadSource source = source_of(specification);
  const CadFile   file   = check_cad_file(source);
  if (file == CadFile::triangles)
    throw std::invalid_argument(source.place + ": " + source.path +
                                " contains triangles but no volume; a frame needs a solid: export it as STEP, or give "
                                "a tetrahedral mesh as .msh.");
  if (source.sew > 0. && file != CadFile::step && file != CadFile::brep)
    throw std::invalid_argument(source.place + ": repair is for STEP and BREP files, but " + source.path +
                                " is none; remove it.");
  if (specification.mesh.size > 0.) // for scripts that mesh by themselves: they read Mesh.MeshSizeMax
    gmsh::option::setNumber("Mesh.MeshSizeMax", specification.mesh.size / (source.unit > 0. ? source.unit : 1.));
  CadModel model = open_cad(source, session);
  if (model.meshed) // its cells are checked instead
    return model;
  if (file == CadFile::geo && specification.mesh.defeature > 0.)
    throw std::invalid_argument(specification.mesh.place + ": defeature is for STEP and BREP files; " + source.path +
                                " is a script: use HealShapes in it, or remove the feature.");
  check_shells(model, source);
  join_solids(model, specification, session);
  model.faces = outer_faces(model.unit, model.diagonal());
  apply_labels(model);
  check_bodies(model, specification);
  if (file != CadFile::geo)
    defeature(model, specification, session);
  return model;
}

} // namespace gestell::fem
