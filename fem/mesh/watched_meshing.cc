#include "fem/mesh/watched_meshing.h"

#include "fem/mesh/mesh_grading.h"

#include <gmsh.h>

#include <stdexcept>
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

/// gmsh reports no error for some solids that it leaves without cells.
void require_cells_in_all_volumes()
{
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (const auto &[dim, tag] : volumes)
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, dim, tag);
    if (types.empty())
      throw std::runtime_error("a solid gets no cells");
  }
}

/// Meshes anew, up to this dimension, by a method of gmsh.
void mesh_by(const char *option, double method, int dimension, const gmsh::vectorpair &without)
{
  double before;
  gmsh::option::getNumber(option, before);
  gmsh::option::setNumber(option, method);
  gmsh::model::mesh::clear(without); // what the last attempt left
  gmsh::model::mesh::generate(dimension);
  gmsh::option::setNumber(option, before);
}

/// gmsh's frontal method can leave two equal triangles at the tip of a cone (4.13).
void mesh_surfaces_by_delaunay()
{
  constexpr double delaunay = 5.; // number of gmsh
  mesh_by("Mesh.Algorithm", delaunay, 2, {});
}

void mesh_volumes_by_hxt()
{
  constexpr double hxt = 10.; // number of gmsh
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  mesh_by("Mesh.Algorithm3D", hxt, 3, volumes);
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
  const double n = static_cast<double>(number_of_triangles());
  require_cells(0.5 * n, "the surfaces alone have " + text(n) + " triangles", options); // two at most to a cell
}

void mesh_volumes(CadModel &model, const FrameSpecification &specification, const GmshSession &session,
                  const VolumeMesher &delaunay)
{
  const auto mesh = [&]
  {
    delaunay ? delaunay() : gmsh::model::mesh::generate(3);
    require_cells_in_all_volumes();
  };
  std::string note;
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
    session.run(mesh_surfaces_by_delaunay, "", "");
    session.run(mesh, "", "");
    model.notes.push_back(note + "it succeeded after this method meshed the surfaces as well");
    return;
  }
  catch (const std::invalid_argument &)
  {
    model.notes.push_back(note + "its method HXT succeeded, but gives a different mesh every time");
  }
  session.run(mesh_volumes_by_hxt, head_of(specification) + ": gmsh cannot mesh its volume: ", remedy);
}

} // namespace gestell::fem
