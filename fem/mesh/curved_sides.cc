#include "fem/mesh/curved_sides.h"

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/values/vector3.h"

#include <Eigen/Dense>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace gestell::fem
{

namespace
{

using Edge = std::array<int, 2>;

constexpr std::array<Edge, 6> edges_of_cell = {{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}};

Edge edge_between(int a, int b)
{
  return {std::min(a, b), std::max(a, b)};
}

Point3 straight_middle(const Mesh &mesh, const Edge &edge)
{
  return 0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]);
}

// --- determinant of dx/dxi of a quadratic tetrahedron

constexpr int n_coefficients = 20; // of a cubic in barycentric coordinates

/// Exponents i + j + k + l = 3 of Bernstein's cubics; divided by 3 also the points of their lattice.
const std::vector<std::array<int, 4>> &exponents()
{
  static const std::vector<std::array<int, 4>> all = []
  {
    std::vector<std::array<int, 4>> list;
    for (int i = 0; i <= 3; ++i)
      for (int j = 0; i + j <= 3; ++j)
        for (int k = 0; i + j + k <= 3; ++k)
          list.push_back({i, j, k, 3 - i - j - k});
    return list;
  }();
  return all;
}

/// Matrix from values at the lattice points to coefficients: the inverse of B_c(point) = 3!/(i! j! k! l!) l^exponents.
const Eigen::Matrix<double, n_coefficients, n_coefficients> &to_coefficients()
{
  static const Eigen::Matrix<double, n_coefficients, n_coefficients> inverse = []
  {
    constexpr double                                      factorial[] = {1., 1., 2., 6.};
    Eigen::Matrix<double, n_coefficients, n_coefficients> B;
    for (int p = 0; p < n_coefficients; ++p)
      for (int c = 0; c < n_coefficients; ++c)
      {
        B(p, c) = 6.;
        for (int m = 0; m < 4; ++m)
          B(p, c) *= std::pow(exponents()[p][m] / 3., exponents()[c][m]) / factorial[exponents()[c][m]];
      }
    return Eigen::Matrix<double, n_coefficients, n_coefficients>(B.inverse());
  }();
  return inverse;
}

using Coefficients = Eigen::Matrix<double, n_coefficients, 1>;

/// x = sum l_i (2 l_i - 1) x_i + sum 4 l_i l_j m_ij;  dx/dxi_k = dx/dl_k - dx/dl_0, k = 1, 2, 3.
Coefficients determinant(const Mesh &mesh, const std::array<int, 4> &cell)
{
  Eigen::Matrix<double, 3, 4> corners;
  for (int i = 0; i < 4; ++i)
    corners.col(i) = Eigen::Map<const Eigen::Vector3d>(mesh.points[cell[i]].data());
  std::array<Eigen::Vector3d, 6> middles;
  for (int e = 0; e < 6; ++e)
  {
    const auto &[a, b] = edges_of_cell[e];
    const auto found   = mesh.middles.find(edge_between(cell[a], cell[b]));
    middles[e]         = 0.5 * (corners.col(a) + corners.col(b));
    if (found != mesh.middles.end())
      middles[e] = Eigen::Map<const Eigen::Vector3d>(found->second.data());
  }
  Coefficients values;
  for (int p = 0; p < n_coefficients; ++p)
  {
    Eigen::Vector4d l;
    for (int m = 0; m < 4; ++m)
      l[m] = exponents()[p][m] / 3.;
    Eigen::Matrix<double, 3, 4> by_l;
    for (int i = 0; i < 4; ++i)
      by_l.col(i) = (4. * l[i] - 1.) * corners.col(i);
    for (int e = 0; e < 6; ++e)
    {
      const auto &[a, b] = edges_of_cell[e];
      by_l.col(a) += 4. * l[b] * middles[e];
      by_l.col(b) += 4. * l[a] * middles[e];
    }
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k)
      J.col(k) = by_l.col(k + 1) - by_l.col(0);
    values[p] = J.determinant();
  }
  return to_coefficients() * values;
}

// --- middles on the geometry

Point3 onto_cylinder(const Face &face, const Point3 &x)
{
  const Vector3 along  = dot(x - face.through, face.direction) * face.direction;
  const Vector3 radial = x - face.through - along;
  return face.through + along + face.radius * unit(radial);
}

/// gmsh's nearest points, of many at once.
std::vector<Point3> onto_entity(int dim, int tag, const std::vector<Point3> &points, double unit_length)
{
  std::vector<double> from, to, parameters;
  for (const Point3 &point : points)
    for (const double x : point)
      from.push_back(x / unit_length);
  gmsh::model::getClosestPoint(dim, tag, from, to, parameters);
  std::vector<Point3> result;
  for (std::size_t i = 0; i + 2 < to.size(); i += 3)
    result.push_back(unit_length * Point3{to[i], to[i + 1], to[i + 2]});
  return result.size() == points.size() ? result : points;
}

/// Keeps a middle that leaves the straight edge by no more than half of it.
void bend(Mesh &mesh, const Edge &edge, const Point3 &middle)
{
  const double     length = norm(mesh.points[edge[1]] - mesh.points[edge[0]]);
  const double     off    = norm(middle - straight_middle(mesh, edge));
  constexpr double bent   = 1e-9; // middles that are off by less than this share of the edge are straight
  if (off > bent * length && off < 0.5 * length)
    mesh.middles[edge] = middle;
}

/// Edges of the mesh on each curve, which then belong to no face.
std::map<int, std::vector<Edge>> edges_on_curves(const ExtractedMesh &extracted)
{
  std::map<std::size_t, int> index; // gmsh's tag to point
  for (std::size_t i = 0; i < extracted.node.size(); ++i)
    index[extracted.node[i]] = static_cast<int>(i);
  std::map<int, std::vector<Edge>> result;
  gmsh::vectorpair                 curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto &[dim, tag] : curves)
  {
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(1, elements, nodes, tag); // 1: lines of two nodes
    for (std::size_t i = 0; i + 1 < nodes.size(); i += 2)
      if (index.count(nodes[i]) > 0 && index.count(nodes[i + 1]) > 0)
        result[tag].push_back(edge_between(index.at(nodes[i]), index.at(nodes[i + 1])));
  }
  return result;
}

void bend_all(Mesh &mesh, const std::vector<Edge> &edges, int dim, int tag, double unit_length)
{
  std::vector<Point3> middles;
  for (const Edge &edge : edges)
    middles.push_back(straight_middle(mesh, edge));
  middles = onto_entity(dim, tag, middles, unit_length);
  for (std::size_t i = 0; i < edges.size(); ++i)
    bend(mesh, edges[i], middles[i]);
}

} // namespace

void follow_geometry(ExtractedMesh &extracted, const CadModel &model)
{
  Mesh          &mesh = extracted.mesh;
  std::set<Edge> on_curve;
  for (const auto &[tag, edges] : edges_on_curves(extracted))
  {
    on_curve.insert(edges.begin(), edges.end());
    std::string type;
    gmsh::model::getType(1, tag, type);
    if (type != "Line")
      bend_all(mesh, edges, 1, tag, model.unit);
  }
  std::map<int, std::set<Edge>> on_face;
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const Edge edge = edge_between(mesh.skin[t][k], mesh.skin[t][(k + 1) % 3]); on_curve.count(edge) == 0)
        on_face[extracted.skin_surface[t]].insert(edge);
  for (const Face &face : model.faces)
  {
    const std::vector<Edge> edges(on_face[face.tag].begin(), on_face[face.tag].end());
    if (face.kind == FaceKind::cylinder)
      for (const Edge &edge : edges)
        bend(mesh, edge, onto_cylinder(face, straight_middle(mesh, edge)));
    else if (face.kind == FaceKind::other)
      bend_all(mesh, edges, 2, face.tag, model.unit);
  }
  unfold(mesh);
}

void unfold(Mesh &mesh)
{
  const std::size_t n_curved = mesh.middles.size();
  std::set<Edge>    straightened; // or halved: these keep a middle node
  for (bool folded = !mesh.middles.empty(); folded;)
  {
    folded = false;
    for (const auto &cell : mesh.cells)
    {
      std::vector<Edge> curved;
      for (const auto &[a, b] : edges_of_cell)
        if (const Edge edge = edge_between(cell[a], cell[b]); mesh.middles.count(edge) > 0)
          curved.push_back(edge);
      constexpr double least_share = 0.1; // of the straight determinant that must be left
      if (curved.empty() || determinant(mesh, cell).minCoeff() >= least_share * six_volumes(mesh, cell))
        continue;
      folded = true;
      for (const Edge &edge : curved)
      {
        const Point3 middle = straight_middle(mesh, edge), halfway = 0.5 * (mesh.middles[edge] + middle);
        mesh.middles.erase(edge);
        if (norm(halfway - middle) > 0.01 * norm(mesh.points[edge[1]] - mesh.points[edge[0]]))
          mesh.middles[edge] = halfway;
        straightened.insert(edge);
      }
    }
  }
  if (!straightened.empty())
    mesh.notes.push_back(std::to_string(straightened.size()) + " of " + std::to_string(n_curved) +
                         " curved edges are straightened, because cells next to them would fold; use smaller elements "
                         "there to keep them curved");
}

std::vector<double> curved_volumes(const Mesh &mesh)
{
  std::vector<double> volumes;
  for (const auto &cell : tetrahedra_of(mesh))
    volumes.push_back((mesh.middles.empty() ? six_volumes(mesh, cell) : determinant(mesh, cell).mean()) / 6.);
  return volumes;
}

double curved_volume(const Mesh &mesh)
{
  const std::vector<double> volumes = curved_volumes(mesh);
  return std::accumulate(volumes.begin(), volumes.end(), 0.);
}

} // namespace gestell::fem
