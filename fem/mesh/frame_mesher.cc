#include "fem/mesh/frame_mesher.h"

#include "fem/geometry/gmsh_faces.h"
#include "fem/geometry/gmsh_session.h"
#include "fem/geometry/read_cad.h"
#include "fem/geometry/shared_faces.h"
#include "fem/geometry/small_features.h"
#include "fem/geometry/solid_materials.h"
#include "fem/geometry/surface_selection.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/curved_sides.h"
#include "fem/mesh/flat_cells.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesh_extraction.h"
#include "fem/mesh/mesh_grading.h"
#include "fem/mesh/mesh_groups.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/point_freedom.h"
#include "fem/mesh/solid_volumes.h"
#include "fem/mesh/solids/swept_solids.h"
#include "fem/mesh/watched_meshing.h"
#include "fem/values/mesh_phase.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace gestell::fem
{

namespace
{

constexpr double cells_by_default = 25000.; ///< as mesher.h promises

enum class MissingSize
{
  refused,
  chosen
};

struct MeshedModel
{
  CadModel      model;
  Selection     selection;
  ExtractedMesh extracted;
  double        size           = 0.; ///< [m]
  double        expected_cells = 0.;
  std::string   smallest; ///< edges and faces
};

Selection select_all(CadModel &model, const FrameSpecification &specification)
{
  Selection selection;
  for (const auto &[name, selector] : specification.surfaces)
  {
    selection[name] = select_faces(model.faces, selector, model.diagonal());
    if (const std::string words = coaxial_faces(model.faces, selector, selection[name], model.diagonal());
        !words.empty())
      model.statements.push_back("surface \"" + name + "\": " + words);
  }
  require_faces_of_one_owner(selection, model.faces, specification);
  return selection;
}

/// Sides of hexahedra and prisms are straight.
void require_straight(const ExtractedMesh &extracted, const FrameSpecification &specification)
{
  const MeshOptions &options = specification.mesh;
  if (options.curved && !extracted.mesh.only_tetrahedra())
    throw std::invalid_argument(
        options.place + ": curved = true, but the cells of " + specification.cad +
        std::string(extracted.mesh.hexahedra.empty() ? " are prisms" : " are hexahedra") +
        " with straight sides; remove curved and make cells smaller along curved faces, or mesh with tetrahedra.");
}

/// Whether a face of gmsh belongs to a surface; false if there is no such surface.
bool is_on(const Selection &selection, const std::string &name, int face)
{
  const auto found = selection.find(name);
  return found != selection.end() && std::binary_search(found->second.begin(), found->second.end(), face);
}

/// Surfaces that interfaces and attached masses average.
std::vector<std::string> averaged_surfaces(const FrameSpecification &specification)
{
  std::vector<std::string> names;
  const auto               add = [&](const auto &coupled)
  {
    for (const auto &one : coupled)
      if (one.coupling == InterfaceCoupling::average)
        names.insert(names.end(), one.surfaces.begin(), one.surfaces.end());
  };
  add(specification.interfaces);
  add(specification.masses);
  return names;
}

/// Nodes to be expected on surfaces that are averaged.
double expected_averaged(const MeshedModel &result, const FrameSpecification &specification,
                         const std::map<std::string, double> &sizes, double size_elsewhere)
{
  double n = 0.;
  for (const std::string &name : averaged_surfaces(specification))
    for (const Face &face : result.model.faces)
    {
      const auto size = sizes.find(name);
      if (is_on(result.selection, name, face.tag))
        n += nodes_on(face.area, size != sizes.end() ? size->second : size_elsewhere);
    }
  return n;
}

/// Of its reduction.
double memory_of(const FrameSpecification &specification, double n, double kappa, double n_averaged)
{
  return reduction_memory(n, kappa, n_averaged) + (specification.prestress ? prestress_memory(n) : 0.);
}

/// Refuses a mesh whose frame would not fit into the memory, before it is made.
void judge_memory(MeshedModel &result, const FrameSpecification &specification, const MeshOptions &options)
{
  const auto sizes      = resolve_surface_sizes(options, result.selection);
  result.expected_cells = expected_cells(result.model, options.size, sizes, result.selection);
  if (specification.parts != 1)
    return; // the parts are judged when the mesh is cut
  const double available = available_memory();
  const double kappa     = compactness(result.model.volume(), skin_area(result.model.faces));
  const double averaged  = expected_averaged(result, specification, sizes, options.size);
  const auto   memory    = [&](double cells) // nodes of a surface grow like cells^(2/3)
  {
    return memory_of(specification, coordinates_of(cells), kappa,
                     averaged * std::pow(cells / result.expected_cells, 2. / 3.));
  };
  double fitting = result.expected_cells;
  while (fitting > 1000. && memory(fitting) > available)
    fitting *= 0.9;
  require_memory("about " + text(result.expected_cells) + " tetrahedra with " +
                     text(coordinates_of(result.expected_cells)) + " DOFs are expected",
                 memory(result.expected_cells), available, options.place,
                 "Use size = " + text(size_for_cells(result.model, fitting)) +
                     " m or more, larger sizes on surfaces, or a computer with more memory.");
}

/// The same of a mesh that is read.
void judge_memory(const MeshedModel &result, const FrameSpecification &specification)
{
  if (specification.parts != 1)
    return;
  const Mesh  &mesh     = result.extracted.mesh;
  const double n        = 3. * number_of_nodes(mesh);
  double       averaged = 0.;
  for (const std::string &name : averaged_surfaces(specification))
    for (const int surface : result.extracted.skin_surface)
      if (is_on(result.selection, name, surface))
        averaged += 2.; // nodes to a triangle
  require_memory(
      specification.cad + " has " + text(n) + " DOFs",
      memory_of(specification, n, compactness(result.model.volume(), skin_area(result.model.faces)), averaged),
      available_memory(), specification.mesh.place, "Give a coarser mesh, or a computer with more memory.");
}

/// Notes what forces elements far smaller than the size.
void judge_features(MeshedModel &result, const MeshOptions &options)
{
  // than the size: edges and faces worth a note, as they rule cells around them
  constexpr double    much_smaller = 0.02;
  const double        limit        = much_smaller * options.size;
  const SmallFeatures features     = small_features(result.model, limit);
  result.smallest                  = describe(features);
  if (features.n_short_edges + features.n_narrow_faces > 0)
    result.model.notes.push_back(
        std::to_string(features.n_short_edges) + " edges and " + std::to_string(features.n_narrow_faces) +
        " faces are much smaller than elements (below " + text(1e3 * limit) + " mm; " + result.smallest +
        "), so the elements there are small: mesh.defeature removes features below a size where possible");
}

/// Cell size from the mean thickness 2 V / A.
double size_for_walls(const CadModel &model)
{
  constexpr double swept_by_default = 20.; // size over the mean thickness of walls
  const double     size             = swept_by_default * 2. * model.volume() / skin_area(model.faces);
  const double     largest =
      std::max({model.max[0] - model.min[0], model.max[1] - model.min[1], model.max[2] - model.min[2]});
  return std::min(size, largest);
}

/// All checks before meshing.
/// @return the options with their size.
MeshOptions prepare_geometry(MeshedModel &result, const FrameSpecification &specification, MissingSize missing)
{
  MeshOptions options = specification.mesh;
  if (options.size == 0. && missing == MissingSize::chosen)
    options.size =
        options.plates == Plates::swept ? size_for_walls(result.model) : size_for_cells(result.model, cells_by_default);
  result.size = options.size;
  check_materials(result.model, specification);
  result.selection = select_all(result.model, specification);
  set_mesh_sizes(result.model, options, result.selection);
  judge_memory(result, specification, options);
  if (options.plates != Plates::swept) // small features do not reduce their cell size
    judge_features(result, options);
  return options;
}

/// Meshes the solids in gmsh, without judging memory.
void mesh_by_gmsh(MeshedModel &result, const MeshAttempt &attempt, const GmshSession &session,
                  const SurfaceSizes &sizes, const ChildProgress &progress)
{
  const FrameSpecification &specification = attempt.specification;
  const auto                report        = [&](const char *phase) { progress ? progress(phase, -1.) : void(); };
  gmsh::option::setNumber("Mesh.MeshSizeMax", sizes.options.size / result.model.unit);
  report(mesh_phase::surfaces);
  mesh_surfaces(result.model, result.selection, specification, session, sizes);
  report(mesh_phase::volumes);
  mesh_volumes(result.model, specification, session);
  result.extracted = extract_mesh(result.model, head_of(specification), {sizes.options.bodies, 0.});
  require_straight(result.extracted, specification);
  require_cells(result.extracted.mesh.n_cells(),
                "the mesh has " + std::to_string(result.extracted.mesh.n_cells()) + " cells", sizes.options);
}

void improve(MeshedModel &result, const MeshOptions &options)
{
  if (!result.extracted.mesh.only_tetrahedra())
    return;
  improve_quality(result.extracted.mesh, point_freedom(result.model, result.extracted.node));
  if (options.curved)
    follow_geometry(result.extracted, result.model);
}

/// The swept solids, and the others in tetrahedra.
void join_swept(MeshedModel &result, SweptSolids swept, const MeshAttempt &attempt, const GmshSession &session,
                SurfaceSizes sizes, const ChildProgress &progress)
{
  const FrameSpecification &specification = attempt.specification;
  const int                 bodies        = std::exchange(sizes.options.bodies, 0);
  state_solids(result.model, swept, sizes.options);
  if (!swept.others.empty())
  {
    MeshedModel rest;
    rest.model     = alone_in_gmsh(result.model, swept);
    rest.selection = among(rest.model.faces, result.selection);
    if (specification.mesh.size == 0.)
      sizes.options.size = size_for_cells(rest.model, cells_by_default);
    if (!sizes.script_has_sizes) // fields refer to faces that are gone
    {
      remove_size_fields();
      set_smallest_as_background(surface_size_fields(rest.model, sizes.options, rest.selection));
    }
    judge_features(rest, sizes.options);
    mesh_by_gmsh(rest, attempt, session, sizes, progress);
    improve(rest, sizes.options);
    PartialMesh last{std::move(rest.extracted), {}};
    for (const auto &other : swept.others)
      last.solids.push_back(other.first);
    swept.meshes.push_back(std::move(last));
    for (std::string &note : rest.model.notes)
      result.model.notes.push_back(std::move(note));
    for (std::string &statement : rest.model.statements)
      result.model.statements.push_back(std::move(statement));
  }
  result.extracted                     = joined(result.model, swept.meshes, bodies, head_of(specification));
  result.extracted.mesh.takes_one_size = true;
  result.expected_cells                = 0.; // an estimate for tetrahedra
  note_volumes(result.extracted.mesh, result.model.solids, sizes.options);
  judge_memory(result, specification);
}

void mesh_geometry(MeshedModel &result, const MeshAttempt &attempt, const GmshSession &session, MissingSize missing,
                   const ChildProgress &progress, const std::vector<SizePoint> &refined)
{
  const FrameSpecification &specification    = attempt.specification;
  const bool                script_has_sizes = has_size_fields();
  MeshOptions               options          = prepare_geometry(result, specification, missing);
  if (options.plates == Plates::swept)
  {
    progress ? progress(mesh_phase::plates, -1.) : void();
    SweptSolids swept = sweep_solids(result.model, result.selection, specification, options);
    if (!swept.meshes.empty())
      return join_swept(result, std::move(swept), attempt, session,
                        {options, std::nullopt, script_has_sizes, attempt.walls}, progress);
    result.model.notes.push_back(options.place + ": plates are meshed with tetrahedra instead of swept, because " +
                                 swept.others.begin()->second);
    judge_features(result, options);
    if (specification.mesh.size == 0.) // chosen for what is not swept
      options.size = result.size = size_for_cells(result.model, cells_by_default);
  }
  const auto field = refined.empty() ? std::nullopt : std::optional(SizeField(refined, options.size));
  mesh_by_gmsh(result, attempt, session, {options, field, script_has_sizes, attempt.walls}, progress);
  if (refined.empty()) // who refines judges beforehand
    judge_memory(result, specification);
  improve(result, options);
  note_volumes(result.extracted.mesh, result.model.solids, options);
}

void read_mesh(MeshedModel &result, const FrameSpecification &specification)
{
  const MeshOptions &options = specification.mesh;
  if (options.defeature > 0.)
    throw std::invalid_argument(options.place + ": defeature = " + text(options.defeature) + " m, but " +
                                specification.cad + " is a mesh already; remove it, or give the geometry.");
  if (!options.surface_size.empty())
    throw std::invalid_argument(options.place + ": \"" + options.surface_size.begin()->first + "\" has a size, but " +
                                specification.cad + " is a mesh already; remove the size, or give the geometry.");
  result.extracted = extract_mesh(result.model, head_of(specification), {options.bodies, options.gap});
  result.extracted.mesh.takes_one_size = true;
  require_straight(result.extracted, specification);
  const Mesh &mesh = result.extracted.mesh;
  if (mesh.n_cells() > options.max_cells)
    throw std::invalid_argument(options.place + ": " + specification.cad + " has " + std::to_string(mesh.n_cells()) +
                                " cells, mesh.max_cells allows " + text(options.max_cells) +
                                "; increase max_cells or give a coarser mesh.");
  check_materials(result.model, specification);
  unfold(result.extracted.mesh);
  measure_solids(result.model, mesh);
  const auto divided = divide_skin(result.extracted, result.model.groups);
  result.model.faces = faces_of_skin(mesh, result.extracted.skin_surface, divided);
  result.selection   = select_all(result.model, specification);
  judge_memory(result, specification);
}

void name_surfaces(MeshedModel &result, const FrameSpecification &specification)
{
  Mesh &mesh = result.extracted.mesh;
  for (const auto &[name, tags] : result.selection)
  {
    std::vector<int> &triangles = mesh.surfaces[name];
    for (std::size_t t = 0; t < mesh.skin.size(); ++t)
      if (std::binary_search(tags.begin(), tags.end(), result.extracted.skin_surface[t]))
        triangles.push_back(static_cast<int>(t));
    if (triangles.empty())
      throw std::invalid_argument(
          specification.surfaces.at(name).place +
          ": no triangle of the mesh lies on the faces of this surface; choose another mesh.size.");
  }
}

/// The model, with a note if its size is unlikely.
CadModel read_model(const FrameSpecification &specification, const GmshSession &session)
{
  CadModel model = read_cad(specification, session);
  if (const std::string note = suspect_size(model, source_of(specification)); !note.empty())
    model.notes.push_back(note);
  return model;
}

MeshedModel mesh_model(const MeshAttempt &attempt, MissingSize missing, const ChildProgress &progress,
                       const std::vector<SizePoint> &refined = {})
{
  const FrameSpecification &specification = attempt.specification;
  const GmshSession         session;
  MeshedModel               result;
  if (progress)
    progress(mesh_phase::reading, -1.);
  const auto work = [&]
  {
    result.model = read_model(specification, session);
    if (result.model.meshed)
      read_mesh(result, specification);
    else
      mesh_geometry(result, attempt, session, missing, progress, refined);
    require_thick_cells(result.extracted.mesh, result.model.meshed, head_of(specification));
    name_surfaces(result, specification);
    Mesh &mesh = result.extracted.mesh;
    for (const Solid &solid : result.model.solids)
      mesh.densities.push_back(solid.density);
    mesh.notes.insert(mesh.notes.begin(), result.model.notes.begin(), result.model.notes.end());
    mesh.statements.insert(mesh.statements.begin(), result.model.statements.begin(), result.model.statements.end());
  };
  session.run(work, head_of(specification) + ": gmsh fails on this model: ", "; repair it, or export it another way.");
  return result;
}

/// Report of the geometry, before meshing.
GeometryReport report_of(const MeshedModel &meshed)
{
  GeometryReport report;
  report.solids         = meshed.model.solids;
  report.faces          = meshed.model.faces;
  report.surfaces       = meshed.selection;
  report.min            = meshed.model.min;
  report.max            = meshed.model.max;
  report.size           = meshed.size;
  report.expected_cells = meshed.expected_cells;
  return report;
}

} // namespace

Mesh mesh_of_frame(const MeshAttempt &attempt, const ChildProgress &progress, const std::vector<SizePoint> &refined)
{
  return mesh_model(attempt, MissingSize::refused, progress, refined).extracted.mesh;
}

GeometryReport inspection_of_frame(const FrameSpecification &specification)
{
  const GmshSession session;
  MeshedModel       result;
  const auto        work = [&]
  {
    result.model = read_model(specification, session);
    if (result.model.meshed)
    {
      read_mesh(result, specification);
      require_thick_cells(result.extracted.mesh, result.model.meshed, head_of(specification));
    }
    else
      prepare_geometry(result, specification, MissingSize::refused);
  };
  session.run(work, head_of(specification) + ": gmsh fails on this model: ", "; repair it, or export it another way.");
  GeometryReport report = report_of(result);
  report.volume         = result.model.volume();
  report.notes          = result.model.notes;
  report.statements     = result.model.statements;
  return report;
}

GeometryReport report_of_frame(const MeshAttempt &attempt, const ChildProgress &progress)
{
  MeshedModel    meshed = mesh_model(attempt, MissingSize::chosen, progress);
  const Mesh    &mesh   = meshed.extracted.mesh;
  GeometryReport report = report_of(meshed);
  report.notes          = mesh.notes;
  report.statements     = mesh.statements;
  report.smallest       = meshed.smallest;
  report.walls          = wall_thickness(mesh);
  report.n_of_kind      = {mesh.cells.size(), mesh.hexahedra.size(), mesh.prisms.size()};
  report.n_points       = static_cast<int>(mesh.points.size());
  report.n_cells        = mesh.n_cells();
  report.n_coordinates  = 3 * number_of_nodes(mesh);
  report.worst_quality  = 1.;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const double q       = cell_quality(mesh, cell);
    report.worst_quality = std::min(report.worst_quality, q);
    report.mean_quality += q / report.n_cells;
  }
  report.volume    = curved_volume(mesh);
  report.extracted = std::move(meshed.extracted);
  return report;
}

} // namespace gestell::fem
