#include "fem/mesh/hexahedral_mesh.h"

#include "fem/mesh/hexahedron.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

namespace
{

/// Corners at the two ends of the edges that leave each corner, as a right-handed triad.
constexpr std::array<std::array<int, 3>, 8> triads = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// Along the diagonal from corner 0 to corner 6, positively oriented.
constexpr std::array<std::array<int, 4>, 6> sixths = {
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};

using Key = std::array<int, 4>; // corners of an edge (the rest -1) or of a face, sorted

/// Numbers nodes by the corners they stand amid, and places them in the midst.
class Numbering
{
public:
  explicit Numbering(const Mesh &mesh, QuadraticMesh &result) : mesh_(mesh), result_(result) {}

  int at(std::vector<int> amid)
  {
    std::sort(amid.begin(), amid.end());
    if (amid.size() == 1)
    {
      int &node = result_.node_of[amid[0]];
      if (node < 0)
        node = add(amid);
      return node;
    }
    if (amid.size() == 8)
      return add(amid);
    const auto [entry, is_new] = middles_.try_emplace(key(amid), 0);
    if (is_new)
      entry->second = add(amid);
    return entry->second;
  }

  /// The node amid these corners, -1 if no cell has it.
  int find(std::vector<int> amid) const
  {
    std::sort(amid.begin(), amid.end());
    const auto entry = middles_.find(key(amid));
    return entry == middles_.end() ? -1 : entry->second;
  }

private:
  static Key key(const std::vector<int> &amid)
  {
    Key key = {-1, -1, -1, -1};
    std::copy(amid.begin(), amid.end(), key.begin());
    return key;
  }

  int add(const std::vector<int> &amid)
  {
    Point3 x{};
    for (const int corner : amid)
      x = x + (1. / static_cast<double>(amid.size())) * mesh_.points[corner];
    result_.points.push_back(x);
    return result_.n_nodes() - 1;
  }

  const Mesh        &mesh_;
  QuadraticMesh     &result_;
  std::map<Key, int> middles_;
};

/// Corners (0..7) a node of the reference cell stands amid.
std::vector<std::vector<int>> corners_of_nodes()
{
  std::vector<std::vector<int>> result;
  for (int node = 0; node < hexahedron::n_nodes; ++node)
  {
    std::vector<int> amid;
    for (int c = 0; c < 8; ++c)
    {
      const Eigen::Vector3d gap = hexahedron::node_position(hexahedron::corners[c]) - hexahedron::node_position(node);
      if ((gap.array().abs() < 1.5).all())
        amid.push_back(c);
    }
    result.push_back(amid);
  }
  return result;
}

void require_sound(const Mesh &mesh)
{
  for (std::size_t i = 0; i < mesh.hexahedra.size(); ++i)
    if (const double q = corner_quality(mesh, mesh.hexahedra[i]); !(q > 0.))
      throw std::invalid_argument(
          "quadratic_mesh: hexahedron " + std::to_string(i) + " folds: the determinant at a corner is " + text(q) +
          " times the edges there, but a positive one is needed; mesh again, or order its corners as gmsh does.");
}

} // namespace

QuadraticMesh number_nodes(const Mesh &mesh)
{
  return mesh.hexahedra.empty() ? quadratic_mesh(mesh) : hexahedral_nodes(mesh);
}

int number_of_nodes(const Mesh &mesh)
{
  return mesh.hexahedra.empty() ? static_cast<int>(mesh.points.size()) + number_of_edges(mesh)
                                : hexahedral_nodes(mesh).n_nodes();
}

double corner_quality(const Mesh &mesh, const std::array<int, 8> &cell)
{
  double worst = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 8; ++c)
  {
    const auto   edge   = [&](int k) { return mesh.points[cell[triads[c][k]]] - mesh.points[cell[c]]; };
    const double length = norm(edge(0)) * norm(edge(1)) * norm(edge(2));
    worst               = std::min(worst, dot(edge(0), cross(edge(1), edge(2))) / length);
  }
  return worst;
}

std::vector<std::array<int, 4>> tetrahedra_of(const Mesh &mesh)
{
  std::vector<std::array<int, 4>> result = mesh.cells;
  for (const auto &cell : mesh.hexahedra)
    for (const auto &[a, b, c, d] : sixths)
      result.push_back({cell[a], cell[b], cell[c], cell[d]});
  return result;
}

QuadraticMesh hexahedral_nodes(const Mesh &mesh)
{
  require_sound(mesh);
  static const std::vector<std::vector<int>> amid_of = corners_of_nodes();

  QuadraticMesh result;
  result.node_of.assign(mesh.points.size(), -1);
  Numbering numbering(mesh, result);
  for (const auto &cell : mesh.hexahedra)
  {
    hexahedron::Nodes nodes{};
    for (int node = 0; node < hexahedron::n_nodes; ++node)
    {
      std::vector<int> amid;
      for (const int c : amid_of[node])
        amid.push_back(cell[c]);
      nodes[node] = numbering.at(std::move(amid));
    }
    result.hexahedra.push_back(nodes);
  }
  for (const auto &[a, b, c, d] : mesh.skin_quads)
  {
    const std::array<int, 9> face = {result.node_of[a],      numbering.find({a, b}),       result.node_of[b],
                                     numbering.find({a, d}), numbering.find({a, b, c, d}), numbering.find({b, c}),
                                     result.node_of[d],      numbering.find({c, d}),       result.node_of[c]};
    if (*std::min_element(face.begin(), face.end()) < 0)
      throw std::invalid_argument("quadratic_mesh: a quadrilateral of the skin is no face of a hexahedron; surface and "
                                  "volume mesh must share their points.");
    result.skin_quads.push_back(face);
    result.skin.push_back({face[0], face[2], face[8], face[1], face[5], face[4]});
    result.skin.push_back({face[0], face[8], face[6], face[4], face[7], face[3]});
  }
  return result;
}

} // namespace gestell::fem
