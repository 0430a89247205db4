#include "fem/geometry/solid_union.h"

#include "fem/geometry/body_gaps.h"
#include "fem/geometry/cad_shape.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <TopTools_ListOfShape.hxx>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

constexpr std::size_t listed = 10; ///< lines of a message

std::string head_of(const FrameSpecification &specification)
{
  return specification.place + ": " + specification.cad;
}

using Parents = std::map<int, std::vector<int>>; // tag of a piece to the solids that contain it, in file order

/// Physical surface of a script, whose faces get other tags where solids are joined.
struct SurfaceGroup
{
  int              tag;
  std::string      name;
  std::vector<int> faces;
};

std::vector<SurfaceGroup> surface_groups()
{
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, 2);
  std::vector<SurfaceGroup> result;
  for (const auto &[dim, tag] : groups)
  {
    SurfaceGroup group{tag, "", {}};
    gmsh::model::getPhysicalName(dim, tag, group.name);
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.faces);
    result.push_back(std::move(group));
  }
  return result;
}

void restore(const std::vector<SurfaceGroup> &groups, std::map<int, std::vector<int>> &pieces_of_face)
{
  gmsh::vectorpair before;
  for (const SurfaceGroup &group : groups)
    before.emplace_back(2, group.tag);
  if (!before.empty()) // an empty list would mean all
    gmsh::model::removePhysicalGroups(before);
  for (const SurfaceGroup &group : groups)
  {
    std::set<int> faces;
    for (const int face : group.faces)
      faces.insert(pieces_of_face[face].begin(), pieces_of_face[face].end());
    gmsh::model::addPhysicalGroup(2, {faces.begin(), faces.end()}, group.tag);
    gmsh::model::setPhysicalName(2, group.tag, group.name);
  }
}

/// Tags of what the operation made of a shape.
std::vector<int> pieces_of(const TopoDS_Shape &shape, BRepAlgoAPI_BuilderAlgo &operation, const TaggedShapes &after)
{
  TopTools_ListOfShape pieces = operation.Modified(shape);
  if (pieces.IsEmpty() && !operation.IsDeleted(shape))
    pieces.Append(shape);
  std::vector<int> tags;
  for (const TopoDS_Shape &piece : pieces)
    if (after.tags.IsBound(piece))
      tags.push_back(after.tags.Find(piece));
  return tags;
}

/// The result of the operation; pieces have the labels of the first shape that they are part of.
std::shared_ptr<CadShape> united_shape(const CadModel &model, const TaggedShapes &before,
                                       BRepAlgoAPI_BuilderAlgo &operation)
{
  auto united = model.shape ? std::make_shared<CadShape>(*model.shape) : std::make_shared<CadShape>();
  for (const auto *shapes : {&before.solids, &before.faces})
    for (const auto &[tag, shape] : *shapes)
      if (const auto label = united->labels.find(shape.TShape()); label != united->labels.end())
        for (const TopoDS_Shape &piece : operation.Modified(shape))
          united->labels.emplace(piece.TShape(), label->second);
  united->whole = operation.Shape();
  return united;
}

/// gmsh's own operation has no history of faces.
Parents fragment(CadModel &model, const FrameSpecification &specification, const GmshSession &session)
{
  const std::vector<SurfaceGroup> groups = surface_groups();
  TaggedShapes                    before, after;
  BRepAlgoAPI_BuilderAlgo         operation;
  session.run(
      [&]
      {
        before = tagged_shapes(model);
        TopTools_ListOfShape solids;
        gmsh::vectorpair     entities;
        for (const Solid &solid : model.solids)
        {
          solids.Append(before.solids.at(solid.tag));
          entities.emplace_back(3, solid.tag);
        }
        operation.SetArguments(solids);
        if (specification.mesh.gap > 0.)
          operation.SetFuzzyValue(specification.mesh.gap / model.unit);
        operation.Build();
        if (!operation.IsDone())
          throw std::runtime_error("the Boolean operation fails");
        model.shape = united_shape(model, before, operation);
        gmsh::model::occ::remove(entities, /* recursive */ true);
        give_to_gmsh(model.shape->whole, specification.mesh.gap / model.unit);
        after = tagged_shapes(model);
      },
      head_of(specification) + ": OpenCASCADE cannot join its " + std::to_string(model.solids.size()) + " solids: ",
      "; unite them into one solid in the CAD program (boolean union).");

  Parents parents;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
  {
    const std::vector<int> pieces = pieces_of(before.solids.at(model.solids[i].tag), operation, after);
    if (pieces.empty())
      throw std::invalid_argument(specification.mesh.place + ": gap = " + text(specification.mesh.gap) +
                                  " m is larger than solid \"" + model.solids[i].name + "\" (" +
                                  text(model.solids[i].volume) + " m^3); use a smaller gap.");
    for (const int tag : pieces)
      parents[tag].push_back(static_cast<int>(i));
  }
  std::map<int, std::vector<int>> pieces_of_face;
  for (const SurfaceGroup &group : groups)
    for (const int face : group.faces)
      if (const auto shape = before.faces.find(face); shape == before.faces.end())
        pieces_of_face[face] = {face}; // of no solid
      else
        pieces_of_face[face] = pieces_of(shape->second, operation, after);
  restore(groups, pieces_of_face);
  return parents;
}

/// "plate" and "rib" share 0.0001 m^3
std::vector<std::string> overlaps_of(const Parents &parents, const CadModel &model)
{
  std::map<std::pair<int, int>, double> common;
  for (const auto &[tag, in] : parents)
    if (in.size() > 1)
    {
      double volume = 0.;
      gmsh::model::occ::getMass(3, tag, volume);
      common[{in[0], in[1]}] += volume * model.unit * model.unit * model.unit;
    }
  std::vector<std::string> lines;
  for (const auto &[pair, volume] : common)
    lines.push_back("\"" + model.solids[pair.first].name + "\" and \"" + model.solids[pair.second].name + "\" share " +
                    text(volume) + " m^3");
  return lines;
}

std::string joined(const std::vector<std::string> &lines, const std::string &between)
{
  std::string all;
  for (std::size_t i = 0; i < std::min(lines.size(), listed); ++i)
    all += between + lines[i];
  return all + (lines.size() > listed ? between + "and " + std::to_string(lines.size() - listed) + " more" : "");
}

int number_of_common_faces(const std::vector<Solid> &solids)
{
  std::map<int, int> owners;
  for (const Solid &solid : solids)
    for (const int face : solid.faces)
      ++owners[face];
  return static_cast<int>(
      std::count_if(owners.begin(), owners.end(), [](const auto &owner) { return owner.second > 1; }));
}

/// A gap must be smaller than this share of the thickness of a solid: OpenCASCADE takes two vertices for one where they
/// are nearer than the sum of their tolerances and the gap, and a vertex it has joined may have a tolerance of a gap.
constexpr double share_of_thickness = 1. / 3.;

/// Mean thickness 2 V / A [m]: exact for thin walls, and never more than the smallest side of the bounding box.
double thickness(const Solid &solid, double unit)
{
  double area = 0.;
  for (const int face : solid.faces)
  {
    double of_face = 0.;
    gmsh::model::occ::getMass(2, face, of_face);
    area += unit * unit * of_face;
  }
  return 2. * solid.volume / area;
}

double box_distance(const Solid &a, const Solid &b)
{
  double squares = 0.;
  for (int d = 0; d < 3; ++d)
  {
    const double apart = std::max({0., a.min[d] - b.max[d], b.min[d] - a.max[d]});
    squares += apart * apart;
  }
  return std::sqrt(squares);
}

bool some_are_near(const CadModel &model, double distance)
{
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (box_distance(model.solids[i], model.solids[j]) <= distance)
        return true;
  return false;
}

/// Requires that solids with another solid within the gap are thick enough that their own faces are not merged.
void require_small_gap(const CadModel &model, const FrameSpecification &specification)
{
  const double gap = specification.mesh.gap;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
  {
    const Solid &solid   = model.solids[i];
    bool         is_near = false;
    for (std::size_t j = 0; j < model.solids.size(); ++j)
      is_near = is_near || (j != i && box_distance(solid, model.solids[j]) <= gap);
    if (!is_near)
      continue;
    const double thick = thickness(solid, model.unit), allowed = share_of_thickness * thick;
    if (gap >= allowed)
      throw std::invalid_argument(specification.mesh.place + ": gap = " + text(gap) + " m, but solid \"" + solid.name +
                                  "\" is only " + text(thick) +
                                  " m thick on average (2 volume / surface), so that its own faces could be merged; "
                                  "the gap must be less than a third of that: set gap below " +
                                  text(allowed) +
                                  " m, or remove it and let the solids touch in the CAD program, or set mesh.bodies if "
                                  "they should be separate.");
  }
}

} // namespace

void join_solids(CadModel &model, const FrameSpecification &specification, const GmshSession &session)
{
  const double reach = std::max(specification.mesh.gap, 1e-6 * model.diagonal());
  if (model.solids.size() < 2 || !some_are_near(model, reach))
    return;
  require_small_gap(model, specification);
  const Parents                  parents  = fragment(model, specification, session);
  const std::vector<std::string> overlaps = overlaps_of(parents, model);
  if (!overlaps.empty() && specification.mesh.overlaps == Overlaps::refused)
    throw std::invalid_argument(
        head_of(specification) +
        ": its solids overlap, so that the mass of the common part would count twice; unite or cut them in the CAD "
        "program, or set mesh.overlaps = \"once\" to assign it to the solid that is first in the file:" +
        joined(overlaps, "\n  "));

  std::vector<Solid> pieces;
  for (const auto &[tag, in] : parents)
  {
    pieces.push_back(measured_solid(tag, model.unit));
    pieces.back().name = model.solids[in.front()].name;
  }
  if (!overlaps.empty())
    model.notes.push_back("the common part of solids that overlap counts once: " + joined(overlaps, "; ").substr(2));
  if (const int common = number_of_common_faces(pieces); common > 0)
    model.statements.push_back("its " + std::to_string(model.solids.size()) + " solids are joined at " +
                               std::to_string(common) + (common == 1 ? " common face" : " common faces") +
                               ", as if welded");
  model.solids = std::move(pieces);
}

std::vector<int> bodies_of(const std::vector<Solid> &solids)
{
  std::vector<int> body(solids.size());
  std::iota(body.begin(), body.end(), 0);
  std::map<int, int> first_owner; // face tag to index of solid
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (const int face : solids[i].faces)
    {
      const auto [owner, is_new] = first_owner.try_emplace(face, static_cast<int>(i));
      const int a = std::min(body[owner->second], body[i]), b = std::max(body[owner->second], body[i]);
      if (!is_new)
        std::replace(body.begin(), body.end(), b, a);
    }
  return body;
}

void check_bodies(const CadModel &model, const FrameSpecification &specification)
{
  const std::vector<int> body = bodies_of(model.solids);
  const std::set<int>    bodies(body.begin(), body.end());
  const int              found = static_cast<int>(bodies.size()), wanted = specification.mesh.bodies;
  if (found == wanted)
    return;
  if (found < wanted)
    throw std::invalid_argument(specification.mesh.place + ": bodies = " + std::to_string(wanted) + ", but " +
                                specification.cad + " holds " + std::to_string(found) +
                                (found == 1 ? " body connected" : " bodies connected") +
                                " by common faces; set bodies to that number, or use a smaller gap.");

  std::string list;
  for (std::size_t i = 0; i < std::min(model.solids.size(), 2 * listed); ++i)
  {
    const Solid &solid = model.solids[i];
    list += "\n  body " + std::to_string(std::distance(bodies.begin(), bodies.find(body[i])) + 1) + ": \"" +
            solid.name + "\", " + text(solid.volume) + " m^3, from " + text(solid.min) + " to " + text(solid.max);
  }
  if (model.solids.size() > 2 * listed)
    list += "\n  and " + std::to_string(model.solids.size() - 2 * listed) + " solids more";

  std::string where;
  double      widest = 0., thinnest = std::numeric_limits<double>::max();
  for (const BodyGap &gap : nearest_gaps(model, body))
  {
    widest = std::max(widest, gap.distance);
    for (const int solid : {gap.solid_a, gap.solid_b})
      thinnest = std::min(thinnest, thickness(model.solids[solid], model.unit));
    where += "\n  \"" + model.solids[gap.solid_a].name + "\" and \"" + model.solids[gap.solid_b].name + "\" are " +
             text(1e3 * gap.distance) + " mm apart at " + text(gap.at) + ", between " + gap.face_a + " and " +
             gap.face_b;
  }
  const double      closing = 1.01 * widest, allowed = share_of_thickness * thinnest;
  const std::string number = std::to_string(found);
  const std::string way_out =
      widest > 0. && closing < allowed
          ? ". If a gap is a drawing error, set mesh.gap = \"" + text(1e3 * closing) +
                " mm\" to close it; if they should be separate, set mesh.bodies = " + number + "."
      : widest > 0.
          ? ". They are too far apart for mesh.gap, which must be less than a third of the thickness of solids, here " +
                text(1e3 * allowed) + " mm: let them touch in the CAD program, or set mesh.bodies = " + number +
                " if they should be separate."
          : ". They meet in a line or a point only, which does not connect them: let them overlap or share a face, or "
            "set "
            "mesh.bodies = " +
                number + " if they should be separate.";
  throw std::invalid_argument(specification.place + ": " + specification.cad + " holds " + std::to_string(found) +
                              " bodies without common faces, but mesh.bodies = " + std::to_string(wanted) + way_out +
                              " Lengths in m:" + list + where);
}

} // namespace gestell::fem
