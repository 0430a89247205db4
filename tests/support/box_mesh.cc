#include "tests/support/box_mesh.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace gestell::test
{
namespace
{

/// The outer triangles of the six tetrahedra are those that lie in a side; corner d at 0 or n decides.
void add_side(fem::Mesh &mesh, const std::vector<std::array<int, 3>> &grid, const std::array<int, 3> &n,
              const std::array<int, 3> &triangle)
{
  for (int d = 0; d < 3; ++d)
    for (const int end : {0, n[d]})
      if (std::all_of(triangle.begin(), triangle.end(), [&](int point) { return grid[point][d] == end; }))
      {
        mesh.surfaces[std::string(1, "xyz"[d]) + (end == 0 ? "0" : "1")].push_back(static_cast<int>(mesh.skin.size()));
        mesh.skin.push_back(triangle);
      }
}

} // namespace

fem::Mesh box_mesh(const std::array<int, 3> &n, const std::array<double, 3> &size, double distortion)
{
  fem::Mesh                              mesh;
  std::vector<std::array<int, 3>>        grid;
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> shift(-distortion, distortion);
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
      {
        const std::array<int, 3> at{{i, j, k}};
        fem::Point3              x{};
        for (int d = 0; d < 3; ++d)
          x[d] = size[d] / n[d] * (at[d] + (at[d] > 0 && at[d] < n[d] ? shift(generator) : 0.));
        grid.push_back(at);
        mesh.points.push_back(x);
      }

  const auto point = [&](const std::array<int, 3> &at) { return at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2]); };
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        std::array<int, 3> order{{0, 1, 2}};
        int                count = 0; // permutations 0, 3, 4 in lexicographic order are the even ones
        do
        {
          std::array<int, 3> at{{i, j, k}};
          std::array<int, 4> cell{};
          cell[0] = point(at);
          for (int step = 0; step < 3; ++step)
          {
            ++at[order[step]];
            cell[step + 1] = point(at);
          }
          if (count != 0 && count != 3 && count != 4)
            std::swap(cell[2], cell[3]);
          ++count;
          mesh.cells.push_back(cell);
          const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}; // outward
          for (const auto &face : faces)
            add_side(mesh, grid, n, {{cell[face[0]], cell[face[1]], cell[face[2]]}});
        } while (std::next_permutation(order.begin(), order.end()));
      }
  mesh.cell_solid.assign(mesh.cells.size(), 0);
  mesh.solids = {"box"};
  return mesh;
}

fem::FrameSpecification free_steel()
{
  fem::FrameSpecification specification;
  specification.material = {210e9, 0.3, 7850., "test"};
  return specification;
}

fem::Support clamped(const std::string &name, const std::vector<std::string> &surfaces, const std::array<bool, 3> &held)
{
  fem::Support support;
  support.name     = name;
  support.surfaces = surfaces;
  support.held     = held;
  return support;
}

fem::Support foundation(const std::string &name, const std::vector<std::string> &surfaces,
                        const fem::Vector3 &stiffness, const fem::Vector3 &damping)
{
  fem::Support support;
  support.name      = name;
  support.surfaces  = surfaces;
  support.kind      = fem::SupportKind::foundation;
  support.stiffness = stiffness;
  support.damping   = damping;
  return support;
}

fem::InterfaceSpecification interface(const std::string &name, const std::vector<std::string> &surfaces,
                                      fem::InterfaceCoupling coupling)
{
  fem::InterfaceSpecification result;
  result.name     = name;
  result.surfaces = surfaces;
  result.coupling = coupling;
  return result;
}

const fem::FrameOutput &output(const fem::FrameMatrices &frame, const std::string &name)
{
  for (const fem::FrameOutput &candidate : frame.outputs)
    if (candidate.name == name)
      return candidate;
  throw std::out_of_range("no output " + name);
}

} // namespace gestell::test
