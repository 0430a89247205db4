#include "fem/geometry/cad_shape.h"

#include "fem/values/message_text.h"
#include "fem/values/temporary_directory.h"

#include <gmsh.h>

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

TopoDS_Shape exported_shape()
{
  const TemporaryDirectory folder;
  const std::string        file = folder.path() / "shapes.brep";
  gmsh::write(file);
  TopoDS_Shape shape;
  if (!BRepTools::Read(shape, file.c_str(), BRep_Builder()))
    throw std::runtime_error("exchanging shapes with OpenCASCADE failed through " + file);
  return shape;
}

[[noreturn]] void refuse_order(const std::string &what)
{
  throw std::runtime_error("this version of gmsh orders shapes unlike OpenCASCADE: " + what);
}

void require_alike(int dim, int tag, const TopoDS_Shape &shape)
{
  GProp_GProps properties;
  dim == 3 ? BRepGProp::VolumeProperties(shape, properties) : BRepGProp::SurfaceProperties(shape, properties);
  double measured = 0.;
  gmsh::model::occ::getMass(dim, tag, measured);
  constexpr double same = 1e-6; // relative: both integrate the same shape, a file has 15 digits
  if (std::abs(measured - properties.Mass()) > same * std::abs(measured))
    refuse_order(std::string(dim == 3 ? "the volume of solid " : "the area of face ") + std::to_string(tag) + " is " +
                 text(measured) + " in one and " + text(properties.Mass()) + " in the other");
}

void add(TaggedShapes &result, int dim, int tag, const TopoDS_Shape &shape)
{
  if (!(dim == 3 ? result.solids : result.faces).emplace(tag, shape).second)
    return;
  require_alike(dim, tag, shape);
  result.tags.Bind(shape, tag);
}

std::vector<TopoDS_Vertex> degenerate_vertices(const TopoDS_Shape &all)
{
  std::vector<TopoDS_Vertex> vertices;
  for (TopExp_Explorer edge(all, TopAbs_EDGE); edge.More(); edge.Next())
    if (BRep_Tool::Degenerated(TopoDS::Edge(edge.Current())))
      vertices.push_back(TopExp::FirstVertex(TopoDS::Edge(edge.Current())));
  return vertices;
}

gp_Pnt begin_of(int edge)
{
  gmsh::vectorpair points;
  gmsh::model::getBoundary({{1, edge}}, points, /* combined */ false, /* oriented */ false);
  std::vector<double> x;
  gmsh::model::getValue(0, points.at(0).second, {}, x);
  return {x.at(0), x.at(1), x.at(2)};
}

} // namespace

TopoDS_Shape whole_shape(const CadModel &model)
{
  return model.shape ? model.shape->whole : exported_shape();
}

TaggedShapes tagged_shapes(const CadModel &model)
{
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 3);
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(whole_shape(model), TopAbs_SOLID, solids);
  if (solids.Extent() != static_cast<int>(entities.size()))
    refuse_order(std::to_string(entities.size()) + " and " + std::to_string(solids.Extent()) + " solids");
  TaggedShapes result;
  for (int i = 0; i < solids.Extent(); ++i)
  {
    const int           tag   = entities[i].second;
    const TopoDS_Shape &solid = solids(i + 1);
    add(result, 3, tag, solid);
    std::vector<int> above, tags;
    gmsh::model::getAdjacencies(3, tag, above, tags);
    std::size_t k = 0;
    for (TopExp_Explorer face(solid, TopAbs_FACE); face.More(); face.Next())
      if (face.Current().Orientation() != TopAbs_INTERNAL && k++ < tags.size())
        add(result, 2, tags[k - 1], face.Current());
    if (k != tags.size())
      refuse_order(std::to_string(tags.size()) + " and " + std::to_string(k) + " faces of solid " +
                   std::to_string(tag));
  }
  return result;
}

std::set<int> degenerate_edges(const CadModel &model)
{
  gmsh::vectorpair edges;
  gmsh::model::getEntities(edges, 1);
  std::set<int> found;
  for (const auto &[dim, tag] : edges)
  {
    double length = 0.;
    gmsh::model::occ::getMass(1, tag, length);
    if (length < Precision::Confusion()) // one point to OpenCASCADE; only such edges may be degenerate
      found.insert(tag);
  }
  if (found.empty())
    return found; // a copy of a large script takes time
  const std::vector<TopoDS_Vertex> vertices = degenerate_vertices(whole_shape(model));
  for (auto edge = found.begin(); edge != found.end();)
  {
    const gp_Pnt begin        = begin_of(*edge);
    const bool   is_at_vertex = std::any_of(vertices.begin(), vertices.end(),
                                            [&](const TopoDS_Vertex &vertex)
                                            {
                                            const double reach =
                                                std::max(BRep_Tool::Tolerance(vertex), Precision::Confusion());
                                            return BRep_Tool::Pnt(vertex).Distance(begin) <= reach;
                                          });
    edge                      = is_at_vertex ? std::next(edge) : found.erase(edge);
  }
  return found;
}

void give_to_gmsh(const TopoDS_Shape &shape, double gap)
{
  if (shape.IsNull())
    return;
  BRepTools::Clean(shape);
  gmsh::vectorpair entities;
  gmsh::model::occ::importShapesNativePointer(&shape, entities, /* highestDimOnly */ false);
  gmsh::option::setNumber("Geometry.ToleranceBoolean", gap);
  gmsh::model::occ::synchronize();
  gmsh::option::setNumber("Geometry.ToleranceBoolean", 0.);
}

void apply_labels(CadModel &model)
{
  if (!model.shape || model.shape->labels.empty())
    return;
  const TaggedShapes shapes   = tagged_shapes(model);
  const auto         label_of = [&](const TopoDS_Shape &shape) -> ShapeLabel
  {
    const auto found = model.shape->labels.find(shape.TShape());
    return found == model.shape->labels.end() ? ShapeLabel{} : found->second;
  };
  for (Solid &solid : model.solids)
  {
    const ShapeLabel label = label_of(shapes.solids.at(solid.tag));
    solid.name             = label.name.empty() ? solid.name : label.name;
    solid.material         = label.material;
    solid.density          = label.density;
  }
  for (Face &face : model.faces)
  {
    const ShapeLabel label = label_of(shapes.faces.at(face.tag));
    face.name              = label.name;
    face.groups            = label.groups;
  }
}

} // namespace gestell::fem
