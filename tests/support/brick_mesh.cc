#include "tests/support/brick_mesh.h"

#include "tests/support/box_mesh.h"

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace gestell::test
{
namespace
{

using Grid = std::vector<std::array<int, 3>>;

/// Points of the grid, those that cells use, and the cells.
class Builder
{
public:
  Builder(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion) : n_(n)
  {
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> shift(-distortion, distortion);
    for (int k = 0; k <= n[2]; ++k)
      for (int j = 0; j <= n[1]; ++j)
        for (int i = 0; i <= n[0]; ++i)
        {
          const std::array<int, 3> at     = {i, j, k};
          const bool               inside = i > 0 && i < n[0] && j > 0 && j < n[1] && k > 0 && k < n[2];
          fem::Point3              x{};
          for (int d = 0; d < 3; ++d)
            x[d] = size[d] / n[d] * (at[d] + (inside ? shift(generator) : 0.));
          grid_.push_back(at);
          mesh.points.push_back(x);
        }
  }

  void fill(int i, int j, int k, fem::CellKind kind)
  {
    const auto               point = [&](int a, int b, int c) { return a + (n_[0] + 1) * (b + (n_[1] + 1) * c); };
    const std::array<int, 8> brick = {
        point(i, j, k),     point(i + 1, j, k),     point(i + 1, j + 1, k),     point(i, j + 1, k),
        point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)};
    const auto of = [&](int corner) { return brick[corner]; };
    if (kind == fem::CellKind::hexahedron)
      mesh.hexahedra.push_back(brick);
    else if (kind == fem::CellKind::prism)
    {
      mesh.prisms.push_back({of(0), of(1), of(2), of(4), of(5), of(6)});
      mesh.prisms.push_back({of(0), of(2), of(3), of(4), of(6), of(7)});
    }
    else
      for (const auto &[a, b, c, d] : fem::cell_shape(fem::CellKind::hexahedron).pieces)
        mesh.cells.push_back({of(a), of(b), of(c), of(d)});
  }

  void add_skin()
  {
    std::map<std::vector<int>, std::vector<std::vector<int>>> faces; // sorted corners to the faces that have them
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
      for (std::vector<int> face : fem::cell_shape(mesh.kind(cell)).faces)
      {
        for (int &corner : face)
          corner = mesh.corners(cell)[corner];
        std::vector<int> key = face;
        std::sort(key.begin(), key.end());
        faces[key].push_back(face);
      }
    for (const std::size_t n : {4u, 3u})
      for (const auto &entry : faces)
        if (entry.second.size() == 1 && entry.first.size() == n)
          add(entry.second.front());
    mesh.cell_solid.assign(mesh.n_cells(), 0);
    mesh.solids = {"box"};
  }

  fem::Mesh mesh;

private:
  void add(const std::vector<int> &face)
  {
    const int first = static_cast<int>(mesh.skin.size());
    mesh.skin.push_back({face[0], face[1], face[2]});
    if (face.size() == 4)
    {
      mesh.skin_quads.push_back({face[0], face[1], face[2], face[3]});
      mesh.skin.push_back({face[0], face[2], face[3]});
    }
    for (int d = 0; d < 3; ++d)
      for (const int end : {0, n_[d]})
        if (std::all_of(face.begin(), face.end(), [&](int point) { return grid_[point][d] == end; }))
          for (std::size_t triangle = first; triangle < mesh.skin.size(); ++triangle)
            mesh.surfaces[std::string(1, "xyz"[d]) + (end == 0 ? "0" : "1")].push_back(static_cast<int>(triangle));
  }

  std::array<int, 3> n_;
  Grid               grid_;
};

} // namespace

fem::Mesh filled_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, const Filling &filling,
                      double distortion)
{
  Builder builder(n, size, distortion);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (const auto kind = filling(i, j, k))
          builder.fill(i, j, k, *kind);
  builder.add_skin();
  return builder.mesh;
}

fem::Mesh brick_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion)
{
  return filled_mesh(
      n, size, [](int, int, int) { return fem::CellKind::hexahedron; }, distortion);
}

fem::Mesh prism_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion)
{
  return filled_mesh(
      n, size, [](int, int, int) { return fem::CellKind::prism; }, distortion);
}

fem::Mesh tied_mesh(const std::array<double, 3> &size)
{
  fem::Mesh       mesh = brick_mesh({3, 2, 2}, {0.5 * size[0], size[1], size[2]});
  const fem::Mesh more = box_mesh({3, 3, 3}, {0.5 * size[0], size[1], size[2]}, 0.2);
  const int       n = int(mesh.points.size()), n_skin = int(mesh.skin.size());
  for (const auto &x : more.points)
    mesh.points.push_back({x[0] + 0.5 * size[0], x[1], x[2]});
  for (const auto &[a, b, c, d] : more.cells)
    mesh.cells.push_back({a + n, b + n, c + n, d + n});
  for (const auto &[a, b, c] : more.skin)
    mesh.skin.push_back({a + n, b + n, c + n});
  fem::MeshTie tie;
  for (const int face : more.surfaces.at("x0"))
    tie.faces.push_back({more.skin[face][0] + n, more.skin[face][1] + n, more.skin[face][2] + n, -1});
  for (int hexahedron = int(mesh.cells.size()); hexahedron < mesh.n_cells(); ++hexahedron)
    tie.cells.push_back(hexahedron);
  tie.solids = {"far", "near"};
  mesh.ties.push_back(tie);
  mesh.surfaces["x1"].clear();
  for (const int face : more.surfaces.at("x1"))
    mesh.surfaces["x1"].push_back(face + n_skin);
  mesh.cell_solid.assign(mesh.n_cells(), 0);
  return mesh;
}

} // namespace gestell::test
