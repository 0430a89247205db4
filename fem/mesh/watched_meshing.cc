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

void mesh_by_hxt()
{
  constexpr int    hxt   = 10; // number of gmsh
  const char      *which = "Mesh.Algorithm3D";
  double           before;
  gmsh::vectorpair volumes;
  gmsh::option::getNumber(which, before);
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::mesh::clear(volumes); // what the first attempt left
  gmsh::option::setNumber(which, hxt);
  gmsh::model::mesh::generate(3);
  gmsh::option::setNumber(which, before);
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
  try
  {
    session.run(
        delaunay ? delaunay : [] { gmsh::model::mesh::generate(3); }, "", "");
    return;
  }
  catch (const std::invalid_argument &failure)
  {
    model.notes.push_back(std::string("gmsh's Delaunay method cannot mesh the volume (") + failure.what() +
                          "); its method HXT succeeded, but gives a different mesh every time");
  }
  session.run(mesh_by_hxt, head_of(specification) + ": gmsh cannot mesh its volume: ", remedy);
}

} // namespace gestell::fem
