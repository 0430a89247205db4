#include "fem/geometry/degenerate_edges.h"

#include "fem/geometry/occ_snapshot.h"
#include "fem/values/frame_specification.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <vector>

namespace gestell::fem
{

namespace
{

struct Place
{
  Vector3 at;
  double  tolerance; ///< of the vertex, in the model's unit
};

std::vector<Place> places_of_degenerate_edges()
{
  const TopoDS_Shape all = occ_snapshot();
  std::vector<Place> places;
  for (TopExp_Explorer edge(all, TopAbs_EDGE); edge.More(); edge.Next())
    if (BRep_Tool::Degenerated(TopoDS::Edge(edge.Current())))
    {
      const TopoDS_Vertex vertex = TopExp::FirstVertex(TopoDS::Edge(edge.Current()));
      const gp_Pnt        at     = BRep_Tool::Pnt(vertex);
      places.push_back({{at.X(), at.Y(), at.Z()}, std::max(BRep_Tool::Tolerance(vertex), Precision::Confusion())});
    }
  return places;
}

/// Whether an edge of gmsh is shorter than what OpenCASCADE takes for one point; only those may be degenerate.
bool may_be_point(int edge)
{
  double length = 0.;
  gmsh::model::occ::getMass(1, edge, length);
  return length < Precision::Confusion();
}

Vector3 begin_of(int edge)
{
  gmsh::vectorpair points;
  gmsh::model::getBoundary({{1, edge}}, points, /* combined */ false, /* oriented */ false);
  std::vector<double> x;
  gmsh::model::getValue(0, points.at(0).second, {}, x);
  return {x.at(0), x.at(1), x.at(2)};
}

} // namespace

std::set<int> degenerate_edges()
{
  gmsh::vectorpair edges;
  gmsh::model::getEntities(edges, 1);
  std::vector<int> candidates;
  for (const auto &[dim, tag] : edges)
    if (may_be_point(tag))
      candidates.push_back(tag);
  if (candidates.empty())
    return {}; // a snapshot of a large model takes time

  const std::vector<Place> places = places_of_degenerate_edges();
  std::set<int>            found;
  for (const int edge : candidates)
  {
    const Vector3 begin = begin_of(edge);
    if (std::any_of(places.begin(), places.end(),
                    [&](const Place &place) { return norm(place.at - begin) <= place.tolerance; }))
      found.insert(edge);
  }
  return found;
}

} // namespace gestell::fem
