#include "fem/mesh/watched_meshing.h"

#include "fem/mesh/mesh_grading.h"

#include <gmsh.h>

#include <algorithm>
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

/// Meshes up to this dimension.  An error does not leave gmsh by its own exception, since version 4.13 does not mesh
/// again after it.
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
  gmsh::model::mesh::generate(3);
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

void mesh_surfaces(CadModel &model, const Selection &selection, const FrameSpecification &specification,
                   const GmshSession &session, const SurfaceSizes &sizes)
{
  const auto &[options, refined, script_has_sizes] = sizes;
  const std::string head                           = head_of(specification) + ": gmsh cannot mesh its surfaces: ";
  session.run([] { gmsh::model::mesh::generate(2); }, head, remedy);
  const WantedSize wanted(model, options, selection, refined);
  const double     excess  = excess_of_triangles(wanted, model.unit);
  constexpr double runaway = 3.; // times the triangles wanted: short edges of the model govern the mesh
  const ShortEdges edges =
      excess > runaway && !script_has_sizes ? grade_from_short_edges(wanted, model, options, selection) : ShortEdges{};
  if (edges.n > 0)
  {
    session.run(
        []
        {
          gmsh::model::mesh::clear();
          gmsh::model::mesh::generate(2);
        },
        head, remedy);
    model.notes.push_back(std::to_string(edges.n) + " edges are meshed with sides of less than half of the size, " +
                          text(1e3 * edges.shortest) + " mm at least; extended over the faces they would give " +
                          text(excess) +
                          " times the intended number of triangles, so elements grow from them to the size");
  }
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

} // namespace

void mesh_volumes(CadModel &model, const FrameSpecification &specification, const GmshSession &session,
                  const VolumeMesher &delaunay)
{
  const VolumeMesher mesh = delaunay ? delaunay : [] { mesh_to_the_end(3); };
  std::string        note;
  try
  {
    session.run(mesh, "", "");
    return;
  }
  catch (const std::invalid_argument &failure)
  {
    note = std::string("gmsh's Delaunay method cannot mesh the volume (") + failure.what() + "); ";
  }
  try
  {
    session.run([&] { mesh_surfaces_by_delaunay(specification.mesh); }, "", "");
    session.run(mesh, "", "");
    model.notes.push_back(note + "it succeeded after this method meshed the surfaces as well");
    return;
  }
  catch (const std::invalid_argument &) // by HXT then
  {
  }
  session.run(mesh_volumes_by_hxt, head_of(specification) + ": gmsh cannot mesh its volume: ", remedy);
  model.notes.push_back(note + "its method HXT succeeded, but gives a different mesh every time");
}

} // namespace gestell::fem
