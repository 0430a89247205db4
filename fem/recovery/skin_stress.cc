#include "fem/recovery/skin_stress.h"

#include "fem/assembly/cell_values.h"
#include "fem/assembly/reference_cell.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

namespace gestell::fem
{

namespace
{

using Lame     = std::array<double, 2>;
using PointKey = std::tuple<int, double, double>; // node of the skin and material
using Triple   = std::array<int, 3>;

Lame lame(const Material &material)
{
  return {material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu)),
          material.E / (2. * (1. + material.nu))};
}

Triple sorted(Triple corners)
{
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Corners of the triangles that may represent a face of a cell, as local nodes; both diagonals of quadrilaterals.
std::vector<Triple> face_triangles(CellKind kind)
{
  std::vector<Triple> triangles;
  for (const std::vector<int> &face : reference_cell(kind).faces)
    if (face.size() == 3)
      triangles.push_back({face[0], face[1], face[2]});
    else
      for (int left_out = 0; left_out < 4; ++left_out)
        triangles.push_back({face[(left_out + 1) % 4], face[(left_out + 2) % 4], face[(left_out + 3) % 4]});
  return triangles;
}

/// The triangles of the skin and the cells they belong to.
std::map<Triple, int> owners(const QuadraticMesh &mesh)
{
  std::vector<char>     on_skin(mesh.n_nodes(), 0);
  std::map<Triple, int> owner;
  for (const auto &face : mesh.skin)
  {
    owner[sorted({face[0], face[1], face[2]})] = -1;
    for (int k = 0; k < 3; ++k)
      on_skin[face[k]] = 1;
  }
  std::map<CellKind, std::vector<Triple>> triangles;
  for (const CellKind kind : {CellKind::tetrahedron, CellKind::hexahedron, CellKind::prism})
    triangles[kind] = face_triangles(kind);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (const auto &[a, b, c] : triangles[mesh.kind(cell)])
    {
      const int *nodes = mesh.nodes(cell);
      if (!on_skin[nodes[a]] || !on_skin[nodes[b]] || !on_skin[nodes[c]])
        continue;
      if (const auto found = owner.find(sorted({nodes[a], nodes[b], nodes[c]})); found != owner.end())
        found->second = cell;
    }
  std::map<Triple, int> in_order; // in the order of the skin's corners
  for (const auto &face : mesh.skin)
    in_order[{face[0], face[1], face[2]}] = owner.at(sorted({face[0], face[1], face[2]}));
  return in_order;
}

/// dN_a/dx at the corners of a cell where stresses are reliable.
struct CornerGradients
{
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 27, 3>;

  double               volume = 0.;
  std::vector<Weights> of_corner;
};

/// Of tetrahedra at the corners themselves; else carried on to them from the points where stresses are best.
class CornerValues
{
public:
  explicit CornerValues(const QuadraticMesh &mesh)
      : mesh_(mesh), nodes_(mesh, CellPoints::nodes), samples_(mesh, CellPoints::samples), rule_(mesh, CellPoints::rule)
  {
  }

  CornerGradients of(int cell)
  {
    const ReferenceCell &reference = reference_cell(mesh_.kind(cell));
    CornerGradients      result;
    result.volume = rule_.of(cell).weight.sum();
    if (mesh_.kind(cell) == CellKind::tetrahedron)
    {
      const Eigen::MatrixXd &dN = nodes_.of(cell).dN;
      for (int corner = 0; corner < reference.n_corners; ++corner)
        result.of_corner.emplace_back(dN.middleCols<3>(3 * corner));
      return result;
    }
    const Eigen::MatrixXd &dN = samples_.of(cell).dN;
    result.of_corner.assign(reference.n_corners, CornerGradients::Weights::Zero(reference.n_nodes, 3));
    for (Eigen::Index k = 0; k < reference.samples.cols(); ++k)
      for (int corner = 0; corner < reference.n_corners; ++corner)
        result.of_corner[corner] += reference.to_corners(k, corner) * dN.middleCols<3>(3 * k);
    return result;
  }

private:
  const QuadraticMesh &mesh_;
  CellValues           nodes_, samples_, rule_;
};

/// Gathers the rows of a StressRecovery cell by cell.
class Gatherer
{
public:
  Gatherer(const QuadraticMesh &mesh, const std::function<const Material &(int)> &material_of)
      : mesh_(mesh), material_of_(material_of), values_(mesh), column_of_(mesh.n_nodes(), -1)
  {
    place_points();
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
      add(cell);
  }

  StressRecovery recovery(const AffineConstraints &affine, const RigidNodes &rigid)
  {
    const auto n_points = static_cast<Eigen::Index>(result_.point.size());
    for (auto &entry : mean_)
      entry = {entry.row(), entry.col(), entry.value() / volume_[entry.row()]};
    result_.mean.resize(n_points, 3 * static_cast<Eigen::Index>(nodes_.size()));
    result_.mean.setFromTriplets(mean_.begin(), mean_.end());
    result_.of_one.resize(n_points, result_.mean.cols());
    result_.of_one.setFromTriplets(of_one_.begin(), of_one_.end());

    std::vector<Eigen::Triplet<double>> rows;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (int d = 0; d < 3; ++d)
        for (const auto &[coordinate, weight] : affine.row(3 * nodes_[i] + d))
          rows.emplace_back(3 * i + d, coordinate, weight);
    result_.u.resize(result_.mean.cols(), affine.n_coordinates());
    result_.u.setFromTriplets(rows.begin(), rows.end());
    mark(rigid);
    return std::move(result_);
  }

private:
  /// Numbers them in the order of the skin's triangles, as the picture numbers its points.
  void place_points()
  {
    std::vector<int> picture_point(mesh_.n_nodes(), -1);
    int              n_picture = 0;
    const auto       owner     = owners(mesh_);
    for (const auto &face : mesh_.skin)
    {
      const int cell = owner.at({face[0], face[1], face[2]});
      if (cell < 0)
        throw std::invalid_argument("skin_stress: a triangle of the skin is not part of a face of a cell");
      const Lame         moduli = lame(material_of_(cell));
      std::array<int, 3> triangle{};
      for (int k = 0; k < 3; ++k)
      {
        if (picture_point[face[k]] < 0)
          picture_point[face[k]] = n_picture++;
        const auto [found, is_new] =
            point_of_.emplace(PointKey{face[k], moduli[0], moduli[1]}, static_cast<int>(result_.point.size()));
        triangle[k] = found->second;
        if (!is_new)
          continue;
        result_.point.push_back(picture_point[face[k]]);
        result_.lame.push_back(moduli);
        owner_of_.push_back(cell);
      }
      result_.triangles.push_back(triangle);
    }
    volume_.assign(result_.point.size(), 0.);
    on_skin_.assign(mesh_.n_nodes(), 0);
    for (const auto &entry : point_of_)
      on_skin_[std::get<0>(entry.first)] = 1;
  }

  void add(int cell)
  {
    const int *nodes     = mesh_.nodes(cell);
    const int  n_corners = reference_cell(mesh_.kind(cell)).n_corners;
    if (std::none_of(nodes, nodes + n_corners, [&](int node) { return on_skin_[node]; }))
      return;
    const CornerGradients gradients = values_.of(cell);
    const Lame            moduli    = lame(material_of_(cell));
    for (int corner = 0; corner < n_corners; ++corner)
    {
      const auto point = point_of_.find({nodes[corner], moduli[0], moduli[1]});
      if (point == point_of_.end())
        continue;
      const int   i       = point->second;
      const auto &weights = gradients.of_corner[corner];
      volume_[i] += gradients.volume;
      for (Eigen::Index a = 0; a < weights.rows(); ++a)
        for (int l = 0; l < 3; ++l)
          if (weights(a, l) != 0.)
          {
            const int column = 3 * column_of(nodes[a]) + l;
            mean_.emplace_back(i, column, gradients.volume * weights(a, l));
            if (owner_of_[i] == cell)
              of_one_.emplace_back(i, column, weights(a, l));
          }
    }
  }

  int column_of(int node)
  {
    if (column_of_[node] < 0)
    {
      column_of_[node] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
    return column_of_[node];
  }

  void mark(const RigidNodes &rigid)
  {
    result_.nearby.assign(result_.point.size(), -1);
    for (std::size_t r = 0; r < rigid.size(); ++r)
    {
      result_.rigid.push_back(rigid[r].first);
      std::vector<char> held(mesh_.n_nodes(), 0);
      for (const int node : rigid[r].second)
        held[node] = 1;
      for (int cell = 0; cell < mesh_.n_cells(); ++cell)
      {
        const int *nodes = mesh_.nodes(cell);
        if (std::none_of(nodes, nodes + mesh_.n_nodes_of(cell), [&](int node) { return held[node]; }))
          continue;
        const Lame moduli = lame(material_of_(cell));
        for (int k = 0; k < reference_cell(mesh_.kind(cell)).n_corners; ++k)
          if (const auto point = point_of_.find({nodes[k], moduli[0], moduli[1]});
              point != point_of_.end() && result_.nearby[point->second] < 0)
            result_.nearby[point->second] = static_cast<int>(r);
      }
    }
  }

  const QuadraticMesh                        &mesh_;
  const std::function<const Material &(int)> &material_of_;
  CornerValues                                values_;
  std::map<PointKey, int>                     point_of_;
  std::vector<char>                           on_skin_;
  std::vector<int>                            owner_of_;  // [points] cell of of_one
  std::vector<int>                            column_of_; // [nodes of the mesh]
  std::vector<int>                            nodes_;     // near the skin
  std::vector<double>                         volume_;    // [points] of all cells that are averaged
  std::vector<Eigen::Triplet<double>>         mean_, of_one_;
  StressRecovery                              result_;
};

} // namespace

StressRecovery skin_stress(const QuadraticMesh &mesh, const std::function<const Material &(int)> &material_of,
                           const AffineConstraints &affine, const RigidNodes &rigid)
{
  return Gatherer(mesh, material_of).recovery(affine, rigid);
}

} // namespace gestell::fem
