#include "fem/geometry/shells.h"

#include "fem/geometry/cad_shape.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <set>
#include <stdexcept>
#include <vector>

namespace gestell::fem
{

namespace
{

/// Edges of these faces that only one of them has, but those which are a point (`degenerate`).
std::vector<int> open_edges(const std::vector<int> &faces, const std::set<int> &degenerate)
{
  gmsh::vectorpair entities, edges;
  for (const int face : faces)
    entities.emplace_back(2, face);
  gmsh::model::getBoundary(entities, edges, /* combined */ true, /* oriented */ false, /* recursive */ false);
  std::vector<int> open;
  for (const auto &[dim, tag] : edges)
    if (degenerate.count(tag) == 0)
      open.push_back(tag);
  return open;
}

std::string reported(const std::vector<int> &edges, double unit)
{
  Vector3 low, high;
  gmsh::model::getBoundingBox(1, edges.front(), low[0], low[1], low[2], high[0], high[1], high[2]);
  return "open at " + std::to_string(edges.size()) + (edges.size() == 1 ? " edge, " : " edges, one of them ") +
         "from " + text(unit * low) + " to " + text(unit * high);
}

/// Faces that belong to no solid.
std::vector<int> loose_faces()
{
  gmsh::vectorpair faces;
  gmsh::model::getEntities(faces, 2);
  std::vector<int> loose;
  for (const auto &[dim, tag] : faces)
  {
    std::vector<int> solids, edges;
    gmsh::model::getAdjacencies(2, tag, solids, edges);
    if (solids.empty())
      loose.push_back(tag);
  }
  return loose;
}

} // namespace

std::string way_to_close(const CadSource &source)
{
  return (source.sew > 0. ? "repair has sewn within " + text(1e3 * source.sew) + " mm: give a larger distance"
                          : std::string("sew the faces by repair = \"sew\" where gaps are small")) +
         ", or close it in the CAD program (sew or heal) and export it again";
}

std::string open_edges_of_faces(const CadModel &model)
{
  const std::vector<int> loose = loose_faces();
  const std::vector<int> open  = loose.empty() ? loose : open_edges(loose, degenerate_edges(model));
  return open.empty() ? "" : " (" + reported(open, model.unit) + ")";
}

void check_shells(CadModel &model, const CadSource &source)
{
  const std::string   head       = source.place + ": " + source.path;
  const std::set<int> degenerate = degenerate_edges(model);
  for (const Solid &solid : model.solids)
    if (const std::vector<int> open = open_edges(solid.faces, degenerate); !open.empty())
      throw std::invalid_argument(head + ": the shell of solid \"" + solid.name + "\" is " +
                                  reported(open, model.unit) + ", lengths in m; " + way_to_close(source) + ".");
  const std::vector<int> loose = loose_faces();
  if (loose.empty())
    return;
  const std::string left =
      std::to_string(loose.size()) + (loose.size() == 1 ? " face that bounds" : " faces that bound") + " no solid";
  if (model.shape)
    if (const int described = model.shape->n_described; described > static_cast<int>(model.solids.size()))
      throw std::invalid_argument(head + " contains " + std::to_string(described) + " solids, but only " +
                                  std::to_string(model.solids.size()) + " are closed; there are " + left +
                                  open_edges_of_faces(model) + ": " + way_to_close(source) + ".");
  model.notes.push_back(left + open_edges_of_faces(model) + ": they are ignored, because only solids have mass");
}

} // namespace gestell::fem
