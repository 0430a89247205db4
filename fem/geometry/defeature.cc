#include "fem/geometry/defeature.h"

#include "fem/geometry/cad_shape.h"
#include "fem/geometry/gmsh_faces.h"
#include "fem/geometry/shells.h"
#include "fem/geometry/small_features.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <BRepAlgoAPI_Defeaturing.hxx>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// Removes faces by extension of their neighbours; where that is impossible, the model is left unchanged.
void remove_faces(CadModel &model, const std::vector<int> &tags)
{
  const TaggedShapes      shapes = tagged_shapes(model);
  BRepAlgoAPI_Defeaturing removal;
  removal.SetShape(whole_shape(model));
  for (const int tag : tags)
    removal.AddFaceToRemove(shapes.faces.at(tag));
  removal.Build();
  if (!removal.IsDone() || removal.HasErrors())
    return;
  auto changed   = std::make_shared<CadShape>();
  changed->whole = removal.Shape();
  model.shape    = changed;
  gmsh::clear();
  give_to_gmsh(changed->whole);
}

void remove_short_edges(double size)
{
  gmsh::vectorpair solids, healed;
  gmsh::model::getEntities(solids, 3);
  gmsh::model::occ::healShapes(healed, solids, size, /* fixDegenerated */ false, /* fixSmallEdges */ true,
                               /* fixSmallFaces */ true, /* sewFaces */ false, /* makeSolids */ false);
  gmsh::model::occ::synchronize();
}

/// Solids as they are now, with the name and the place in the list of the one they were.
std::vector<Solid> solids_now(const CadModel &before)
{
  gmsh::vectorpair   entities;
  std::vector<Solid> solids;
  gmsh::model::getEntities(entities, 3);
  for (const auto &[dim, tag] : entities)
  {
    Solid      solid  = measured_solid(tag, before.unit);
    const auto unlike = [&](const Solid &old)
    { return norm(old.min - solid.min) + norm(old.max - solid.max) + std::cbrt(std::abs(old.volume - solid.volume)); };
    solid.name = std::min_element(before.solids.begin(), before.solids.end(),
                                  [&](const Solid &a, const Solid &b) { return unlike(a) < unlike(b); })
                     ->name;
    solids.push_back(std::move(solid));
  }
  return solids;
}

/// Faces that lie on the same surface and nearly where they lay.
bool is_rest_of(const Face &now, const Face &before, double size)
{
  if (now.kind != before.kind || norm(now.direction - before.direction) > straight ||
      std::abs(now.radius - before.radius) > 1e-6)
    return false;
  const double reach = 3. * size + 1e-6;
  return norm(now.min - before.min) < reach && norm(now.max - before.max) < reach;
}

void keep_names(std::vector<Face> &now, const std::vector<Face> &before, double size)
{
  for (Face &face : now)
    for (const Face &old : before)
      if (is_rest_of(face, old, size))
      {
        face.name   = old.name;
        face.groups = old.groups;
        break;
      }
}

void require_sound(const CadModel &now, const CadModel &before, const FrameSpecification &specification)
{
  const auto refuse = [&](const std::string &why)
  {
    throw std::invalid_argument(specification.mesh.place + ": defeature = " + text(specification.mesh.defeature) +
                                " m " + why + "; use a smaller one, or simplify the model in the CAD program.");
  };
  if (now.solids.size() != before.solids.size())
    refuse("leaves " + std::to_string(now.solids.size()) + " of " + std::to_string(before.solids.size()) + " solids");
  const double     change         = now.volume() / before.volume() - 1.;
  constexpr double largest_change = 0.05; // of the volume: a larger change is not a detail
  if (!(std::abs(change) < largest_change))
    refuse("changes the volume by " + text(100. * change) + " %");
}

} // namespace

void defeature(CadModel &model, const FrameSpecification &specification, const GmshSession &session)
{
  const double size = specification.mesh.defeature;
  if (!(size > 0.))
    return;
  const CadModel         before = model;
  const std::vector<int> small  = faces_smaller_than(model, size);
  const SmallFeatures    edges  = small_features(model, size);
  if (small.empty() && edges.n_short_edges == 0)
  {
    model.notes.push_back("mesh.defeature finds nothing smaller than " + text(1e3 * size) + " mm");
    return;
  }
  std::string failure;
  session.run(
      [&]
      {
        if (!small.empty())
          remove_faces(model, small);
        model.faces = outer_faces(model.unit, model.diagonal());
        if (small_features(model, size).n_short_edges > 0)
        {
          remove_short_edges(size / model.unit);
          model.shape.reset();
        }
      },
      specification.mesh.place + ": defeature = " + text(size) + " m fails: ",
      "; use a smaller one, or simplify the model in the CAD program.");

  model.solids = solids_now(before);
  model.faces  = outer_faces(model.unit, model.diagonal());
  keep_names(model.faces, before.faces, size);
  require_sound(model, before, specification);
  check_shells(model, {specification.cad, specification.unit, specification.place});
  const std::size_t left = faces_smaller_than(model, size).size();
  model.notes.push_back("mesh.defeature removed " + std::to_string(before.faces.size() - model.faces.size()) + " of " +
                        std::to_string(before.faces.size()) + " faces; " + std::to_string(left) +
                        " small faces remain; the volume changes by " +
                        text(100. * (model.volume() / before.volume() - 1.)) + " %");
}

} // namespace gestell::fem
