#include "fem/mesh/plates/sheets.h"

#include "fem/mesh/joined_cells.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace gestell::fem
{

namespace
{

void join(std::vector<int> &parent, std::size_t a, std::size_t b)
{
  parent[root(parent, static_cast<int>(a))] = root(parent, static_cast<int>(b));
}

/// Sheets across one direction.
class Cutting
{
public:
  Cutting(const BrickLattice &lattice, int direction) : lattice_(lattice), d_(direction) {}

  void cut(Sheets &sheets)
  {
    find_cuts();
    std::vector<int> parent(lattice_.size());
    std::iota(parent.begin(), parent.end(), 0);
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      if (lattice_.is_divided(brick, d_))
        for (int along = 0; along < 3; ++along)
          if (const int next = after(brick, along); next >= 0 && lattice_.is_divided(next, d_))
            if (along != d_ || !is_cut(next))
              join(parent, brick, next);
    number(parent, sheets);
  }

private:
  /// The next brick along a direction, -1 beyond the last.
  int after(std::size_t brick, int along) const
  {
    Index3 i = lattice_.place(brick);
    return ++i[along] < lattice_.n(along) ? static_cast<int>(lattice_.index(i)) : -1;
  }

  // The facet below each brick has the number of the brick; facets in the topmost plane are always cut.
  bool is_cut(std::size_t brick) { return needed_[root(facets_, static_cast<int>(brick))] != 0; }

  int below(std::size_t brick) const
  {
    Index3 i = lattice_.place(brick);
    return --i[d_] >= 0 ? static_cast<int>(lattice_.index(i)) : -1;
  }

  void find_cuts()
  {
    facets_.resize(lattice_.size());
    std::iota(facets_.begin(), facets_.end(), 0);
    const auto divided = [&](int brick) { return brick >= 0 && lattice_.is_divided(brick, d_); };
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      for (int along = 0; along < 3; ++along)
        if (const int next = after(brick, along); along != d_ && next >= 0)
          if ((divided(static_cast<int>(brick)) && divided(next)) || (divided(below(brick)) && divided(below(next))))
            join(facets_, brick, next);
    needed_.assign(lattice_.size(), 0);
    faces_.assign(lattice_.size(), 0.);
    inner_ = faces_;
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
    {
      const int    other = below(brick), in = root(facets_, static_cast<int>(brick));
      const Index3 i = lattice_.place(brick);
      const int    a = (d_ + 1) % 3, b = (d_ + 2) % 3;
      const double area = lattice_.width(a, i[a]) * lattice_.width(b, i[b]);
      if (other >= 0 && lattice_.solid[other] >= 0 && lattice_.solid[brick] >= 0)
        inner_[in] += area;
      else if (lattice_.solid[brick] >= 0 || (other >= 0 && lattice_.solid[other] >= 0))
        faces_[in] += area;
      if ((other < 0 ? -1 : lattice_.solid[other]) != lattice_.solid[brick] ||
          (other < 0 ? -1 : lattice_.region[other]) != lattice_.region[brick])
        needed_[in] = 1;
    }
  }

  /// Whether most of the plane below a brick lies within material.
  bool mostly_goes_on(int brick)
  {
    const int in = root(facets_, brick);
    return inner_[in] > faces_[in];
  }

  void number(std::vector<int> &parent, Sheets &sheets)
  {
    std::map<int, int> number_of; // of a root
    sheets.of_brick[d_].assign(lattice_.size(), -1);
    for (std::size_t brick = 0; brick < lattice_.size(); ++brick)
      if (lattice_.is_divided(brick, d_))
      {
        const int i = lattice_.place(brick)[d_];
        const auto [entry, is_new] =
            number_of.try_emplace(root(parent, static_cast<int>(brick)), static_cast<int>(sheets.across[d_].size()));
        if (is_new)
          sheets.across[d_].push_back({i, i + 1});
        Sheet &sheet               = sheets.across[d_][entry->second];
        sheet.first                = std::min(sheet.first, i);
        sheet.last                 = std::max(sheet.last, i + 1);
        sheets.of_brick[d_][brick] = entry->second;
        if (i == sheet.first)
          sheet.mostly_goes_on[0] = mostly_goes_on(static_cast<int>(brick));
        if (const int next = after(brick, d_); i + 1 == sheet.last)
          sheet.mostly_goes_on[1] = next >= 0 && mostly_goes_on(next);
      }
    for (Sheet &sheet : sheets.across[d_])
    {
      sheet.from = lattice_.planes[d_][sheet.first];
      sheet.to   = lattice_.planes[d_][sheet.last];
    }
  }

  const BrickLattice &lattice_;
  int                 d_;
  std::vector<int>    facets_;        // joined where one cut continues into the next
  std::vector<char>   needed_;        // of the root
  std::vector<double> faces_, inner_; // area on faces and within material, of the root [m^2]
};

/// The narrower of the other two sides of a brick, once planes that cut nothing are gone.
void find_thickness(const BrickLattice &lattice, Sheets &sheets)
{
  std::array<std::vector<std::map<double, double>>, 3> volume_of; // of each sheet, by thickness
  for (int d = 0; d < 3; ++d)
    volume_of[d].resize(sheets.across[d].size());
  for (std::size_t brick = 0; brick < lattice.size(); ++brick)
  {
    if (lattice.solid[brick] < 0)
      continue;
    const Index3 i      = lattice.place(brick);
    const double volume = lattice.width(0, i[0]) * lattice.width(1, i[1]) * lattice.width(2, i[2]);
    const auto   width  = [&](int other)
    {
      const int sheet = sheets.of_brick[other][brick];
      return sheet >= 0 ? sheets.across[other][sheet].width() : lattice.width(other, i[other]); // of a region
    };
    for (int d = 0; d < 3; ++d)
      if (const int sheet = sheets.of_brick[d][brick]; sheet >= 0)
        volume_of[d][sheet][std::min(width((d + 1) % 3), width((d + 2) % 3))] += volume;
  }
  for (int d = 0; d < 3; ++d)
    for (std::size_t s = 0; s < sheets.across[d].size(); ++s)
    {
      double all = 0., sum = 0.;
      for (const auto &[thickness, volume] : volume_of[d][s])
        all += volume;
      for (const auto &[thickness, volume] : volume_of[d][s])
      {
        sheets.across[d][s].thickness = thickness;
        if ((sum += volume) >= 0.5 * all)
          break;
      }
    }
}

} // namespace

Sheets sheets_of(const BrickLattice &lattice)
{
  Sheets sheets;
  for (int d = 0; d < 3; ++d)
    Cutting(lattice, d).cut(sheets);
  find_thickness(lattice, sheets);
  return sheets;
}

} // namespace gestell::fem
