#include "fem/recovery/skin.h"

namespace gestell::fem
{

Picture skin_picture(const QuadraticMesh &mesh, const AffineConstraints &affine)
{
  Picture          picture;
  std::vector<int> point_of(mesh.n_nodes(), -1), nodes;
  for (const auto &face : mesh.skin)
  {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k)
    {
      int &point = point_of[face[k]];
      if (point < 0)
      {
        point = static_cast<int>(nodes.size());
        nodes.push_back(face[k]);
        picture.points.push_back(mesh.points[face[k]]);
      }
      triangle[k] = point;
    }
    picture.triangles.push_back(triangle);
  }

  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t point = 0; point < nodes.size(); ++point)
    for (int d = 0; d < 3; ++d)
      for (const auto &[coordinate, weight] : affine.row(3 * nodes[point] + d))
        entries.emplace_back(3 * point + d, coordinate, weight);
  picture.displacement.resize(3 * nodes.size(), affine.n_coordinates());
  picture.displacement.setFromTriplets(entries.begin(), entries.end());
  return picture;
}

} // namespace gestell::fem
