#include "fem/mesh/watched_meshing.h"

#include "fem/mesh/curved_walls.h"
#include "fem/mesh/gmsh_elements.h"
#include "fem/mesh/mesh_grading.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

namespace
{

const char *const remedy = "; choose another mesh.size or repair the faces in the CAD program.";

/// Triangles of gmsh's mesh of the surfaces.
std::size_t number_of_triangles()
{
  std::vector<int>                      types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2);
  std::size_t n = 0;
  for (const auto &of_type : elements)
    n += of_type.size();
  return n;
}

/// A number among the options of gmsh, until the end of the scope.
class OptionHere
{
public:
  OptionHere(std::string name, double value) : name_(std::move(name))
  {
    gmsh::option::getNumber(name_, before_);
    gmsh::option::setNumber(name_, value);
  }
  ~OptionHere() { gmsh::option::setNumber(name_, before_); }
  OptionHere(const OptionHere &)            = delete;
  OptionHere &operator=(const OptionHere &) = delete;

private:
  std::string name_;
  double      before_ = 0.;
};

/// Meshes up to this dimension.  An error does not leave gmsh by its own exception, because it does not mesh again
/// after that.
/// @throws std::invalid_argument with the first error
void mesh_to_the_end(int dimension)
{
  constexpr double         no_exception = 1.; // number of gmsh
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  const auto       n_before = static_cast<std::ptrdiff_t>(lines.size());
  const OptionHere without("General.AbortOnError", no_exception);
  gmsh::model::mesh::generate(dimension);
  gmsh::logger::get(lines);
  const auto error = std::find_if(lines.begin() + n_before, lines.end(),
                                  [](const std::string &line) { return line.rfind("Error: ", 0) == 0; });
  if (error != lines.end())
    throw std::invalid_argument(error->substr(std::string("Error: ").size()));
}

void mesh_volumes_by_hxt()
{
  constexpr double hxt = 10.; // number of gmsh
  const OptionHere method("Mesh.Algorithm3D", hxt);
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::mesh::clear(volumes); // what the attempts before left
  mesh_to_the_end(3);
}

} // namespace

std::string head_of(const FrameSpecification &specification)
{
  return specification.place + ": " + specification.cad;
}

void require_cells(double n, const std::string &what, const MeshOptions &options)
{
  if (n > options.max_cells)
    throw std::invalid_argument(
        options.place + ": " + what + ", mesh.max_cells allows " + text(options.max_cells) +
        " cells; use a larger size, remove small edges and faces (defeature), or increase max_cells.");
}

namespace
{

void require_triangles(const MeshOptions &options)
{
  const double n = static_cast<double>(number_of_triangles());
  require_cells(0.5 * n, "the surfaces alone have " + text(n) + " triangles", options); // two at most to a cell
}

} // namespace

namespace
{

/// The failure of gmsh as NotMeshed.
void run_gmsh(const GmshSession &session, const std::function<void()> &action, const std::string &head)
{
  try
  {
    session.run(action, head, remedy);
  }
  catch (const std::invalid_argument &failure)
  {
    throw NotMeshed(failure.what());
  }
}

void add_statement(CadModel &model, const FaceSizes &faces, const MeshOptions &options)
{
  if (faces.empty())
    return;
  const auto smaller     = [](const auto &a, const auto &b) { return a.second < b.second; };
  const auto [low, high] = std::minmax_element(faces.begin(), faces.end(), smaller);
  const auto mm          = [&](const auto &face) { return text(std::round(1e4 * model.unit * face->second) / 10.); };
  model.statements.push_back(std::to_string(faces.size()) + " curved faces have triangles of " + mm(low) + " to " +
                             mm(high) + " mm instead of size = " + text(1e3 * options.size) +
                             " mm, which would cut through their thin walls");
}

/// Meshes the surfaces until no triangle cuts through a wall. Sizes follow from the geometry, because triangles that do
/// are not the same each time.
FaceSizes mesh_beside_walls(const CadModel &model, const SurfaceSizes &sizes, const std::function<void()> &mesh)
{
  const double largest = sizes.options.size / model.unit;
  FaceSizes    faces, by_walls;
  if (sizes.walls == WallSizes::everywhere)
    faces = by_walls = sizes_by_walls(largest);
  constexpr int    most_rounds = 5;    // gmsh's triangles exceed their size at first
  constexpr double again       = 0.85; // of the size of a face whose triangles still cut
  for (int round = 0; round < most_rounds; ++round)
  {
    set_local_sizes(sizes.refined, faces, model.unit);
    mesh();
    const FaceSizes cutting = faces_that_cut_walls();
    if (cutting.empty())
      break;
    if (by_walls.empty())
      by_walls = sizes_by_walls(largest);
    for (const auto &[face, size] : cutting)
    {
      const auto by_wall         = by_walls.find(face);
      const auto [entry, is_new] = faces.try_emplace(face, by_wall == by_walls.end() ? size : by_wall->second);
      if (!is_new)
        entry->second *= again;
    }
  }
  return faces;
}

} // namespace

void mesh_surfaces(CadModel &model, const Selection &selection, const FrameSpecification &specification,
                   const GmshSession &session, const SurfaceSizes &sizes)
{
  const auto &[options, refined, script_has_sizes, walls] = sizes;
  bool       again                                        = false;
  const auto mesh                                         = [&]
  {
    if (std::exchange(again, true))
      gmsh::model::mesh::clear();
    run_gmsh(
        session, [] { gmsh::model::mesh::generate(2); }, head_of(specification) + ": gmsh cannot mesh its surfaces: ");
  };
  const FaceSizes  faces = mesh_beside_walls(model, sizes, mesh);
  const WantedSize wanted(model, options, selection, refined, faces);
  const double     excess  = excess_of_triangles(wanted, model.unit);
  constexpr double runaway = 3.; // times the triangles wanted: short edges of the model govern the mesh
  const ShortEdges edges =
      excess > runaway && !script_has_sizes ? grade_from_short_edges(wanted, model, options, selection) : ShortEdges{};
  if (edges.n > 0)
  {
    mesh();
    model.notes.push_back(std::to_string(edges.n) + " edges are meshed with sides of less than half of the size, " +
                          text(1e3 * edges.shortest) + " mm at least; extended over the faces they would give " +
                          text(excess) +
                          " times the intended number of triangles, so elements grow from them to the size");
  }
  add_statement(model, faces, options);
  require_triangles(options);
}

namespace
{

/// gmsh's frontal method can leave two equal triangles at the tip of a cone (4.13).
void mesh_surfaces_by_delaunay(const MeshOptions &options)
{
  constexpr double delaunay = 5.; // number of gmsh
  const OptionHere method("Mesh.Algorithm", delaunay);
  gmsh::model::mesh::clear();
  mesh_to_the_end(2);
  require_triangles(options);
}

std::vector<std::string> solids_without_cells(const CadModel &model)
{
  std::vector<std::string> names;
  for (const Solid &solid : model.solids)
    if (elements_of(3, solid.tag).empty())
      names.push_back("solid \"" + solid.name + "\"");
  return names;
}

void require_all_solids(const CadModel &model)
{
  const std::vector<std::string> empty = solids_without_cells(model);
  if (!empty.empty())
    throw std::invalid_argument(
        empty.front() + (empty.size() > 1 ? " and " + std::to_string(empty.size() - 1) + " more stay" : " stays") +
        " without cells");
}

/// Names of the solids that gmsh cannot mesh even by themselves.
std::vector<std::string> solids_that_fail(const CadModel &model, const GmshSession &session)
{
  const OptionHere         one_by_one("Mesh.MeshOnlyVisible", 1.);
  std::vector<std::string> names;
  gmsh::vectorpair         all;
  gmsh::model::getEntities(all, 3);
  for (const Solid &solid : model.solids)
    try
    {
      gmsh::model::mesh::clear(all);
      gmsh::model::setVisibility(all, 0);
      gmsh::model::setVisibility({{3, solid.tag}}, 1);
      session.run([] { mesh_to_the_end(3); }, "", "");
      if (elements_of(3, solid.tag).empty())
        names.push_back(solid.name);
    }
    catch (const std::invalid_argument &)
    {
      names.push_back(solid.name);
    }
  gmsh::model::setVisibility(all, 1);
  return names;
}

/// "its volume", or the solids that fail.
std::string what_fails(const CadModel &model, const GmshSession &session)
{
  constexpr std::size_t          most  = 5; // names in a message
  const std::vector<std::string> names = solids_that_fail(model, session);
  std::string                    text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  if (names.size() > most)
    text += " and " + std::to_string(names.size() - most) + " more";
  return names.empty() || model.solids.size() < 2 ? "its volume"
                                                  : (names.size() > 1 ? "its solids " : "its solid ") + text;
}

} // namespace

void mesh_volumes(CadModel &model, const FrameSpecification &specification, const GmshSession &session,
                  const VolumeMesher &delaunay)
{
  const VolumeMesher given = delaunay ? delaunay : [] { mesh_to_the_end(3); };
  const auto         whole = [&](const VolumeMesher &method) { return [&] { method(), require_all_solids(model); }; };
  std::string        failure;
  try
  {
    session.run(whole(given), "", "");
    return;
  }
  catch (const std::invalid_argument &error)
  {
    failure = error.what();
  }
  const std::string note = "gmsh's Delaunay method cannot mesh the volume (" + failure + "); ";
  try
  {
    session.run([&] { mesh_surfaces_by_delaunay(specification.mesh); }, "", "");
    session.run(whole(given), "", "");
    model.notes.push_back(note + "it succeeded after this method meshed the surfaces as well");
    return;
  }
  catch (const std::invalid_argument &) // by HXT then
  {
  }
  try
  {
    session.run(whole(mesh_volumes_by_hxt), "", "");
    model.notes.push_back(note + "its method HXT succeeded, but gives a different mesh every time");
  }
  catch (const std::invalid_argument &)
  {
    throw NotMeshed(head_of(specification) + ": gmsh cannot mesh " + what_fails(model, session) + ": " + failure +
                    remedy);
  }
}

} // namespace gestell::fem
