#include "fem/mesh/solids/swept_solids.h"

#include "fem/geometry/gmsh_faces.h"
#include "fem/mesh/plates/extruded.h"
#include "fem/mesh/plates/swept_mesh.h"
#include "fem/mesh/watched_meshing.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace gestell::fem
{

namespace
{

/// Equal up to order and sign.
bool are_parallel(const Axes &a, const Axes &b)
{
  constexpr double parallel = 1e-5; // [rad], as of faces
  return std::all_of(
      a.begin(), a.end(),
      [&](const Vector3 &x)
      { return std::any_of(b.begin(), b.end(), [&](const Vector3 &y) { return norm(cross(x, y)) < parallel; }); });
}

class Sorting
{
public:
  Sorting(const CadModel &model, const Selection &selection, const FrameSpecification &specification,
          const MeshOptions &options)
      : model_(model), selection_(selection), specification_(specification), options_(options),
        faces_(all_faces(model)), extruded_(model.solids.size())
  {
  }

  SweptSolids sorted()
  {
    for (std::size_t i = 0; i < model_.solids.size(); ++i)
      sort(static_cast<int>(i));
    while (!sweep_all() || !order())
      walls_ = {}; // again without what was put aside
    for (const PartialMesh &mesh : meshes_)
      require_cells(mesh.extracted.mesh.n_cells(),
                    "swept solids have " + text(mesh.extracted.mesh.n_cells()) + " cells", options_);
    std::string statement = wall_statement(walls_, n_extruded(), others_.empty());
    return {std::move(meshes_), std::move(others_), std::move(statement)};
  }

private:
  void sort(int i)
  {
    auto own = extruded(model_.solids[i], faces_, model_.unit);
    if (own && carries_others(*own, contacts_with_others({i})) && extruded_tried_.insert(i).second)
      extruded_[i] = std::move(own); // lines along footprints end in its section, and do not divide other walls
    else
      sort_wall(i);
  }

  void sort_wall(int i)
  {
    walls_tried_.insert(i);
    try
    {
      const Axes axes  = plate_solids({model_.solids[i]}, faces_, model_.unit).axes;
      const auto group = std::find_if(axes_.begin(), axes_.end(), [&](const Axes &a) { return are_parallel(a, axes); });
      if (group == axes_.end())
      {
        axes_.push_back(axes);
        groups_.push_back({i});
      }
      else
        groups_[group - axes_.begin()].push_back(i);
    }
    catch (const NotSwept &reason)
    {
      put_aside(i, reason.what());
    }
  }

  /// A solid that fails is tried in the other way.
  void put_aside(int i, const std::string &reason)
  {
    const bool was_extruded = bool(extruded_[i]);
    for (std::vector<int> &group : groups_)
      group.erase(std::remove(group.begin(), group.end(), i), group.end());
    extruded_[i].reset();
    if (was_extruded && walls_tried_.count(i) == 0)
      return sort_wall(i);
    if (!was_extruded && extruded_tried_.insert(i).second)
      extruded_[i] = extruded(model_.solids[i], faces_, model_.unit);
    if (!extruded_[i])
      others_.emplace(i, reason);
  }

  int n_extruded() const
  {
    return static_cast<int>(
        std::count_if(extruded_.begin(), extruded_.end(), [](const auto &solid) { return bool(solid); }));
  }

  /// Faces that others than these solids share.
  std::set<int> contacts_with_others(const std::vector<int> &solids) const
  {
    std::set<int> faces;
    for (const MeshContact &contact : contacts_of(model_, {{{}, solids}}))
      faces.insert(contact.face);
    return faces;
  }

  /// @return whether all could be swept; else some are put aside
  bool sweep_all()
  {
    meshes_.clear();
    for (const std::vector<int> &group : groups_)
      if (!group.empty() && !sweep(group))
        return false;
    for (std::size_t i = 0; i < extruded_.size(); ++i)
      if (extruded_[i] && !sweep_along(static_cast<int>(i)))
        return false;
    return true;
  }

  bool sweep_along(int i)
  {
    try
    {
      meshes_.push_back(
          {extruded_mesh(*extruded_[i], model_.solids[i], contacts_with_others({i}), options_, head_of(specification_)),
           {i}});
      return true;
    }
    catch (const NotSwept &reason)
    {
      put_aside(i, reason.what());
      return false;
    }
  }

  bool sweep(const std::vector<int> &solids)
  {
    PlateGroup group;
    for (const int i : solids)
      group.solids.push_back(model_.solids[i]);
    group.contacts = contacts_with_others(solids);
    try
    {
      SweptMesh mesh = swept_mesh(model_, group, faces_, selection_, specification_, options_);
      walls_.add(mesh.walls);
      meshes_.push_back({std::move(mesh.extracted), solids});
      return true;
    }
    catch (const NotSwept &reason)
    {
      const std::vector<int> all = solids; // a list that changes
      for (std::size_t k = 0; k < all.size(); ++k)
        if (reason.solid < 0 || reason.solid == static_cast<int>(k))
          put_aside(all[k], reason.what());
      return false;
    }
  }

  /// Sides of cells cover the face: its cells can be tied to those on the other side.
  bool can_follow(int mesh, int face) const
  {
    const auto       found   = std::find_if(faces_.begin(), faces_.end(), [&](const Face &f) { return f.tag == face; });
    constexpr double polygon = 0.05; // by which the area may differ: polygons of 12 and of 16 sides by 3 %
    return found != faces_.end() &&
           std::abs(area_on(meshes_[mesh].extracted, face) - found->area) < polygon * found->area;
  }

  /// Leading meshes first, the larger ones if either may lead.
  /// @return whether there is such an order; else a solid is put aside
  bool order()
  {
    std::vector<double> volume;
    for (const PartialMesh &mesh : meshes_)
      volume.push_back(std::accumulate(mesh.solids.begin(), mesh.solids.end(), 0.,
                                       [&](double sum, int i) { return sum + model_.solids[i].volume; }));
    std::vector<std::set<int>> leaders(meshes_.size());
    const auto                 contacts = contacts_of(model_, meshes_);
    for (const MeshContact &contact : contacts)
    {
      const auto [a, b] = contact.mesh;
      if (a < 0 || b < 0)
        continue;
      const bool a_can = can_follow(a, contact.face), b_can = can_follow(b, contact.face);
      if (!a_can && !b_can)
        return put_smaller_aside(contact, "no sides of cells are along its contact with solid ");
      const bool a_follows = a_can && (!b_can || volume[a] < volume[b] || (volume[a] == volume[b] && a > b));
      leaders[a_follows ? a : b].insert(a_follows ? b : a);
    }
    std::vector<PartialMesh> ordered;
    std::vector<char>        done(meshes_.size(), 0);
    while (ordered.size() < meshes_.size())
    {
      const std::size_t before = ordered.size();
      for (std::size_t m = 0; m < meshes_.size(); ++m)
        if (!done[m] && std::all_of(leaders[m].begin(), leaders[m].end(), [&](int leader) { return done[leader]; }))
        {
          done[m] = 1;
          ordered.push_back(std::move(meshes_[m]));
        }
      if (ordered.size() > before)
        continue;
      for (const MeshContact &contact : contacts) // of a circle
        if (contact.mesh[0] >= 0 && contact.mesh[1] >= 0 && !done[contact.mesh[0]] && !done[contact.mesh[1]])
          return put_smaller_aside(contact, "solids lead each other in a circle at its contact with solid ");
    }
    meshes_ = std::move(ordered);
    return true;
  }

  bool put_smaller_aside(const MeshContact &contact, const std::string &reason)
  {
    auto [smaller, larger] = contact.solid;
    if (model_.solids[smaller].volume > model_.solids[larger].volume)
      std::swap(smaller, larger);
    put_aside(smaller, reason + "\"" + model_.solids[larger].name + "\"");
    return false;
  }

  const CadModel                      &model_;
  const Selection                     &selection_;
  const FrameSpecification            &specification_;
  const MeshOptions                   &options_;
  std::vector<Face>                    faces_;
  std::vector<std::optional<Extruded>> extruded_;                     // of each solid
  std::set<int>                        walls_tried_, extruded_tried_; // solids
  std::vector<Axes>                    axes_;                         // of groups
  std::vector<std::vector<int>>        groups_;                       // solids
  std::map<int, std::string>           others_;
  std::vector<PartialMesh>             meshes_;
  WallCount                            walls_;
};

} // namespace

SweptSolids sweep_solids(const CadModel &model, const Selection &selection, const FrameSpecification &specification,
                         const MeshOptions &options)
{
  return Sorting(model, selection, specification, options).sorted();
}

void state_solids(CadModel &model, const SweptSolids &swept, const MeshOptions &options)
{
  model.statements.push_back(swept.statement);
  constexpr std::size_t most = 8; // solids that are named
  std::size_t           n    = 0;
  for (const auto &[solid, reason] : swept.others)
    if (++n <= most)
      model.notes.push_back(options.place + ": solid \"" + model.solids[solid].name +
                            "\" is meshed with tetrahedra instead of swept, because " + reason);
  if (n > most)
    model.notes.push_back(options.place + ": " + std::to_string(n - most) +
                          " more solids are meshed with tetrahedra instead of swept");
}

CadModel alone_in_gmsh(const CadModel &model, const SweptSolids &swept)
{
  CadModel rest = model;
  rest.solids.clear();
  rest.notes.clear();
  rest.statements.clear();
  gmsh::vectorpair removed;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    if (swept.others.count(static_cast<int>(i)) > 0)
      rest.solids.push_back(model.solids[i]);
    else
      removed.emplace_back(3, model.solids[i].tag);
  gmsh::model::removeEntities(removed, true);
  rest.faces = outer_faces(rest.unit, rest.diagonal());
  return rest;
}

Selection among(const std::vector<Face> &faces, const Selection &selection)
{
  Selection left;
  for (const auto &[name, tags] : selection)
  {
    std::vector<int> &own = left[name];
    for (const int tag : tags)
      if (std::any_of(faces.begin(), faces.end(), [tag = tag](const Face &face) { return face.tag == tag; }))
        own.push_back(tag);
  }
  return left;
}

} // namespace gestell::fem
