#include "tests/support/brick_mesh.h"

#include "fem/mesh/hexahedron.h"

#include <algorithm>
#include <random>

namespace gestell::test
{

fem::Mesh brick_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion)
{
  fem::Mesh                              mesh;
  std::vector<std::array<int, 3>>        grid;
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> shift(-distortion, distortion);
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
      {
        const std::array<int, 3> at = {i, j, k};
        fem::Point3              x{};
        const bool               inside = i > 0 && i < n[0] && j > 0 && j < n[1] && k > 0 && k < n[2];
        for (int d = 0; d < 3; ++d)
          x[d] = size[d] / n[d] * (at[d] + (inside ? shift(generator) : 0.));
        grid.push_back(at);
        mesh.points.push_back(x);
      }

  const auto point = [&](int i, int j, int k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const std::array<int, 8> cell = {
            point(i, j, k),     point(i + 1, j, k),     point(i + 1, j + 1, k),     point(i, j + 1, k),
            point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)};
        mesh.hexahedra.push_back(cell);
        for (const auto &face : fem::hexahedron::faces)
          for (int d = 0; d < 3; ++d)
            for (const int end : {0, n[d]})
              if (std::all_of(face.begin(), face.end(), [&](int c) { return grid[cell[c]][d] == end; }))
              {
                const int first         = static_cast<int>(mesh.skin.size());
                const auto [a, b, c, e] = face;
                mesh.skin_quads.push_back({cell[a], cell[b], cell[c], cell[e]});
                mesh.skin.push_back({cell[a], cell[b], cell[c]});
                mesh.skin.push_back({cell[a], cell[c], cell[e]});
                auto &surface = mesh.surfaces[std::string(1, "xyz"[d]) + (end == 0 ? "0" : "1")];
                surface.insert(surface.end(), {first, first + 1});
              }
      }
  mesh.cell_solid.assign(mesh.hexahedra.size(), 0);
  mesh.solids = {"box"};
  return mesh;
}

} // namespace gestell::test
