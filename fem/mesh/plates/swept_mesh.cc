#include "fem/mesh/plates/swept_mesh.h"

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mixed_extraction.h"
#include "fem/mesh/plates/cell_widths.h"
#include "fem/mesh/plates/footprints.h"
#include "fem/mesh/plates/section_mesh.h"
#include "fem/mesh/plates/swept_regions.h"
#include "fem/mesh/watched_meshing.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Limits = std::array<std::vector<std::vector<double>>, 3>; // of each sheet

class Sweeping
{
public:
  Sweeping(const CadModel &model, const PlateGroup &group, PlateSolids solids, const Selection &selection,
           const FrameSpecification &specification, const MeshOptions &options)
      : group_(group), specification_(specification), options_(options), solids_(std::move(solids)),
        lattice_(lattice_with_regions(solids_, model.diagonal())), sheets_(sheets_of(lattice_))
  {
    sort_faces();
    divide_sheets(resolve_surface_sizes(options, selection), selection);
    judge_cells();
  }

  SweptMesh mesh()
  {
    Mesh &mesh = result_.mesh;
    for (const Solid &solid : group_.solids)
      mesh.solids.push_back(solid.name);
    std::set<std::array<int, 3>> done;
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      if (lattice_.solid[brick] >= 0 && lattice_.region[brick] < 0)
        if (const auto [sheet, is_new] = done.insert(sheets_at(brick)); is_new)
          add_block(*sheet, lattice_.solid[brick]);
    for (const SweptRegion &region : lattice_.regions)
      add_region(region);
    constexpr double worst_corner = 0.02; // corner_quality() of cells around holes
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
      if (corner_quality(mesh, cell) < worst_corner)
        throw NotSwept("cells around the hole near " + text(mesh.points[mesh.corners(cell)[0]]) + " m would fold",
                       mesh.cell_solid[cell]);
    check_volumes();
    add_skin(result_, head_of(specification_), 0, // bodies: any number
             [&](const std::vector<int> &corners) { return surface_of(corners); });
    return {std::move(result_), count_walls(lattice_, sheets_)};
  }

private:
  std::array<int, 3> sheets_at(std::size_t brick) const
  {
    return {sheets_.of_brick[0][brick], sheets_.of_brick[1][brick], sheets_.of_brick[2][brick]};
  }

  /// @param sizes  of named surfaces [m]
  void divide_sheets(const std::map<std::string, double> &sizes, const Selection &selection)
  {
    const std::set<std::pair<int, int>> even = sheets_beside_regions();
    std::array<std::vector<double>, 3>  largest; // cell of each sheet
    for (int d = 0; d < 3; ++d)
      largest[d].assign(sheets_.across[d].size(), options_.size);
    for (const auto &[name, size] : sizes)
      for (const PlateFace &face : solids_.faces)
        if (const auto &tags = selection.at(name); std::count(tags.begin(), tags.end(), face.tag) > 0)
          for (const std::size_t brick : bricks_at(face))
            for (const int along : {(face.direction + 1) % 3, (face.direction + 2) % 3})
              if (const int sheet = sheets_.of_brick[along][brick]; sheet >= 0)
                largest[along][sheet] = std::min(largest[along][sheet], size);
    for (int d = 0; d < 3; ++d)
      for (std::size_t s = 0; s < largest[d].size(); ++s)
        limits_[d].push_back(
            cell_limits(sheets_.across[d][s], largest[d][s], options_.layers, even.count({d, int(s)}) > 0));
  }

  /// Direction and number of the sheets that end at an outline: every side of an outline has an even number of cells,
  /// as quadrilaterals require.
  std::set<std::pair<int, int>> sheets_beside_regions() const
  {
    std::set<std::pair<int, int>> nearby;
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      if (const int r = lattice_.region[brick]; r >= 0)
      {
        const int d = lattice_.regions[r].direction;
        for (const auto &[across, along] : {std::pair((d + 1) % 3, (d + 2) % 3), std::pair((d + 2) % 3, (d + 1) % 3)})
          for (const int step : {-1, 1})
          {
            Index3 other = lattice_.place(brick);
            other[across] += step;
            if (lattice_.at(other) >= 0)
              if (const int sheet = sheets_.of_brick[along][lattice_.index(other)]; sheet >= 0)
                nearby.insert({along, sheet});
          }
      }
    return nearby;
  }

  /// Filled bricks with a side on the face.
  std::vector<std::size_t> bricks_at(const PlateFace &face) const
  {
    const int                d = face.direction, a = (d + 1) % 3, b = (d + 2) % 3;
    const int                plane = lattice_.plane_at(d, face.level);
    std::vector<std::size_t> bricks;
    const auto               middle = [&](int along, int i)
    { return 0.5 * (lattice_.planes[along][i] + lattice_.planes[along][i + 1]); };
    for (int i = 0; i < lattice_.n(a); ++i)
      for (int j = 0; j < lattice_.n(b); ++j)
        for (const int k : {plane - 1, plane})
        {
          Index3 at;
          at[d] = k;
          at[a] = i;
          at[b] = j;
          if (lattice_.at(at) >= 0 && PlateSolids::contains(face, {middle(a, i), middle(b, j)}))
            bricks.push_back(lattice_.index(at));
        }
    return bricks;
  }

  /// Requires that no material is lost in a filled hole or outside the lattice.
  void check_volumes() const
  {
    const Mesh         &mesh = result_.mesh;
    std::vector<double> volumes(group_.solids.size(), 0.);
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
      for (const auto &piece : cell_shape(mesh.kind(cell)).pieces)
      {
        const auto at = [&](int k) -> const Vector3 & { return mesh.points[mesh.corners(cell)[piece[k]]]; };
        volumes[mesh.cell_solid[cell]] += dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0))) / 6.;
      }
    // of a solid: the polygon of a hole that takes half of a plate leaves 0.026 to it
    constexpr double lost_volume = 0.03;
    for (std::size_t i = 0; i < volumes.size(); ++i)
      if (const Solid &solid = group_.solids[i]; std::abs(volumes[i] - solid.volume) > lost_volume * solid.volume)
        throw NotSwept("sweeping makes " + text(volumes[i]) + " m^3 of its " + text(solid.volume) + " m^3",
                       static_cast<int>(i));
  }

  /// Before they are made.
  void judge_cells() const
  {
    std::set<std::array<int, 3>> counted;
    double                       n = 0.;
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      if (lattice_.solid[brick] >= 0 && lattice_.region[brick] < 0)
        if (const auto [sheet, is_new] = counted.insert(sheets_at(brick)); is_new)
        {
          double of_block = 1.;
          for (int d = 0; d < 3; ++d)
            of_block *= double(limits_[d][(*sheet)[d]].size() - 1);
          n += of_block;
        }
    require_cells(n, "swept plates have " + text(n) + " cells", options_);
  }

  /// The point at these coordinates in the solids' axes; blocks that share a face name the same numbers.
  int point(const Vector3 &own)
  {
    const auto [entry, is_new] = point_at_.try_emplace(own, static_cast<int>(result_.mesh.points.size()));
    if (is_new)
    {
      own_.push_back(own);
      result_.mesh.points.push_back(own[0] * solids_.axes[0] + own[1] * solids_.axes[1] + own[2] * solids_.axes[2]);
    }
    return entry->second;
  }

  void add_block(const std::array<int, 3> &sheet, int solid)
  {
    const auto &x = limits_[0][sheet[0]], &y = limits_[1][sheet[1]], &z = limits_[2][sheet[2]];
    for (std::size_t k = 0; k + 1 < z.size(); ++k)
      for (std::size_t j = 0; j + 1 < y.size(); ++j)
        for (std::size_t i = 0; i + 1 < x.size(); ++i)
        {
          std::array<int, 8> cell;
          for (std::size_t c = 0; c < 8; ++c) // around the lower face, then around the upper one
            cell[c] = point({x[i + ((c + 1) / 2 % 2)], y[j + (c / 2 % 2)], z[k + c / 4]});
          result_.mesh.hexahedra.push_back(cell);
          result_.mesh.cell_solid.push_back(solid);
        }
  }

  /// Levels at which the cells next to a region meet one of its sides; all of its layers must agree.
  std::vector<double> levels_beside(const SweptRegion &region, int across, bool at_end, int along) const
  {
    const int        d = region.direction;
    std::set<double> found;
    bool             any = false;
    for (int k = region.from[d]; k < region.to[d]; ++k)
    {
      std::set<double> in_layer;
      for (int i = region.from[along]; i < region.to[along]; ++i)
      {
        Index3 nearby;
        nearby[d]      = k;
        nearby[along]  = i;
        nearby[across] = at_end ? region.to[across] : region.from[across] - 1;
        if (lattice_.at(nearby) < 0)
          continue;
        const int sheet = sheets_.of_brick[along][lattice_.index(nearby)];
        if (sheet < 0)
          throw NotSwept("crossing holes are too close to each other");
        for (const double level : limits_[along][sheet])
          if (level >= lattice_.planes[along][region.from[along]] && level <= lattice_.planes[along][region.to[along]])
            in_layer.insert(level);
      }
      if (!in_layer.empty() && any && in_layer != found)
        throw NotSwept("walls next to a hole are divided in two ways");
      if (!in_layer.empty())
        found = in_layer, any = true;
    }
    found.insert(lattice_.planes[along][region.from[along]]);
    found.insert(lattice_.planes[along][region.to[along]]);
    std::vector<double> levels(found.begin(), found.end());
    return any ? levels : divided(levels.front(), levels.back());
  }

  /// Levels on a side without adjacent cells.
  std::vector<double> divided(double from, double to) const
  {
    const int           n = 2 * std::max(1, static_cast<int>(std::ceil(0.5 * (to - from) / options_.size)));
    std::vector<double> levels;
    for (int i = 0; i < n; ++i)
      levels.push_back(from + (to - from) * i / n);
    levels.push_back(to);
    return levels;
  }

  std::vector<Point2> outline(const SweptRegion &region) const
  {
    const int    d = region.direction, a = (d + 1) % 3, b = (d + 2) % 3;
    const double a0 = lattice_.planes[a][region.from[a]], a1 = lattice_.planes[a][region.to[a]],
                 b0 = lattice_.planes[b][region.from[b]], b1 = lattice_.planes[b][region.to[b]];
    std::vector<Point2> points;
    const auto          below = levels_beside(region, b, false, a), above = levels_beside(region, b, true, a),
               left = levels_beside(region, a, false, b), right = levels_beside(region, a, true, b);
    for (std::size_t i = 0; i + 1 < below.size(); ++i)
      points.push_back({below[i], b0});
    for (std::size_t i = 0; i + 1 < right.size(); ++i)
      points.push_back({a1, right[i]});
    for (std::size_t i = above.size() - 1; i > 0; --i)
      points.push_back({above[i], b1});
    for (std::size_t i = left.size() - 1; i > 0; --i)
      points.push_back({a0, left[i]});
    return points;
  }

  /// Sections of the holes of a region, and outlines of footprints: coincident holes through several solids count as
  /// one.
  std::vector<InnerLine> sections(const SweptRegion &region) const
  {
    const int              d     = region.direction;
    const double           whole = lattice_.planes[d][region.to[d]] - lattice_.planes[d][region.from[d]];
    std::vector<InnerLine> found;
    std::vector<double>    length;
    std::vector<Point2>    middle;
    for (const int h : region.holes)
    {
      const PlateHole &hole = solids_.holes[h];
      const Point2     at   = {0.5 * (hole.min[0] + hole.max[0]), 0.5 * (hole.min[1] + hole.max[1])};
      const double     size = hole.max[0] - hole.min[0];
      std::size_t      same = hole.filled ? found.size() : 0; // footprints touch no other line
      while (same < found.size() &&
             (found[same].filled || std::hypot(at[0] - middle[same][0], at[1] - middle[same][1]) > 0.01 * size))
        ++same;
      if (same == found.size())
      {
        found.push_back({{}, hole.filled});
        for (const Side &side : hole.sides)
          found.back().points.push_back(side[0]);
        length.push_back(hole.filled ? whole : 0.);
        middle.push_back(at);
      }
      else if (found[same].points.size() != hole.sides.size() ||
               std::abs(found[same].points.front()[0] - hole.sides.front()[0][0]) > 1e-6 * size)
        throw NotSwept("a hole goes through several solids with different sections", hole.solid);
      length[same] += hole.filled ? 0. : hole.to - hole.from;
    }
    for (const double l : length)
      if (std::abs(l - whole) > 1e-6 * whole)
        throw NotSwept("neighbouring holes go through different thicknesses",
                       solids_.holes[region.holes.front()].solid);
    return found;
  }

  SectionMesh section_of(const SweptRegion &region) const
  {
    try
    {
      return section_mesh(outline(region), sections(region));
    }
    catch (const NotSwept &reason)
    {
      throw NotSwept(reason.what(), solids_.holes[region.holes.front()].solid);
    }
  }

  void add_region(const SweptRegion &region)
  {
    const int         d       = region.direction;
    const SectionMesh section = section_of(region);
    Index3            brick   = region.from;
    int               last    = -1;
    for (; brick[d] < region.to[d]; ++brick[d])
    {
      const int sheet = sheets_.of_brick[d][lattice_.index(brick)];
      if (sheet == last)
        continue;
      last               = sheet;
      const auto &limits = limits_[d][sheet];
      for (std::size_t k = 0; k + 1 < limits.size(); ++k)
        add_layer(section, d, {limits[k], limits[k + 1]}, lattice_.solid[lattice_.index(brick)]);
    }
  }

  void add_layer(const SectionMesh &section, int d, const std::array<double, 2> &levels, int solid)
  {
    const auto at = [&](int i, int level)
    {
      Vector3 own;
      own[d]           = levels[level];
      own[(d + 1) % 3] = section.points[i][0];
      own[(d + 2) % 3] = section.points[i][1];
      return point(own);
    };
    for (const auto &[i, j, k, l] : section.quadrilaterals)
    {
      result_.mesh.hexahedra.push_back(
          {at(i, 0), at(j, 0), at(k, 0), at(l, 0), at(i, 1), at(j, 1), at(k, 1), at(l, 1)});
      result_.mesh.cell_solid.push_back(solid);
    }
  }

  void sort_faces()
  {
    for (std::size_t f = 0; f < solids_.faces.size(); ++f)
    {
      const PlateFace &face = solids_.faces[f];
      on_plane_[{face.direction, lattice_.plane_at(face.direction, face.level)}].push_back(static_cast<int>(f));
    }
  }

  int surface_of(const std::vector<int> &corners) const
  {
    Vector3 centre{}, low = own_[corners[0]], high = low;
    for (const int corner : corners)
      for (int d = 0; d < 3; ++d)
      {
        centre[d] += own_[corner][d] / double(corners.size());
        low[d]  = std::min(low[d], own_[corner][d]);
        high[d] = std::max(high[d], own_[corner][d]);
      }
    for (int d = 0; d < 3; ++d)
      if (low[d] == high[d])
        if (const auto on = on_plane_.find({d, lattice_.plane_at(d, low[d])}); on != on_plane_.end())
          for (const int f : on->second)
            if (PlateSolids::contains(solids_.faces[f], {centre[(d + 1) % 3], centre[(d + 2) % 3]}))
              return solids_.faces[f].tag;
    return wall_at(centre);
  }

  /// The wall of a hole whose section has a side with this midpoint.
  int wall_at(const Vector3 &centre) const
  {
    for (const PlateHole &hole : solids_.holes)
    {
      const int d = hole.direction, a = (d + 1) % 3, b = (d + 2) % 3;
      if (hole.filled || centre[d] < hole.from || centre[d] > hole.to)
        continue;
      for (std::size_t i = 0; i < hole.sides.size(); ++i)
      {
        const auto &[p, q] = hole.sides[i];
        if (std::hypot(0.5 * (p[0] + q[0]) - centre[a], 0.5 * (p[1] + q[1]) - centre[b]) <
            1e-6 * std::hypot(p[0] - q[0], p[1] - q[1]))
          return hole.wall[i];
      }
    }
    return 0;
  }

  const PlateGroup                               &group_;
  const FrameSpecification                       &specification_;
  const MeshOptions                              &options_;
  PlateSolids                                     solids_;
  BrickLattice                                    lattice_;
  Sheets                                          sheets_;
  Limits                                          limits_;
  ExtractedMesh                                   result_;
  std::map<Vector3, int>                          point_at_;
  std::vector<Vector3>                            own_;      // of each point its coordinates in the solids' axes
  std::map<std::pair<int, int>, std::vector<int>> on_plane_; // faces by direction and plane
};

} // namespace

SweptMesh swept_mesh(const CadModel &model, const PlateGroup &group, const std::vector<Face> &all,
                     const Selection &selection, const FrameSpecification &specification, const MeshOptions &options)
{
  const PlateSolids plain = plate_solids(group.solids, all, model.unit);
  PlateSolids       with  = plain;
  add_footprints(with, group.contacts, model.unit, model.diagonal());
  if (with.holes.size() > plain.holes.size())
    try
    {
      return Sweeping(model, group, with, selection, specification, options).mesh();
    }
    catch (const NotSwept &) // joined to cells without sides along the footprints then
    {
    }
    catch (const std::invalid_argument &) // cells that overlap
    {
    }
  return Sweeping(model, group, plain, selection, specification, options).mesh();
}

} // namespace gestell::fem
