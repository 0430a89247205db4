#include "fem/recovery/patch_recovery.h"

#include "fem/assembly/reference_cell.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace gestell::fem
{

namespace
{

using Stress = Eigen::Matrix<double, 6, 1>;

constexpr int monomials = 10; // 1 x y z xx yy zz xy yz zx

using Monomials = Eigen::Matrix<double, monomials, 1>;

Monomials monomials_at(const Eigen::Vector3d &x)
{
  Monomials p;
  p << 1., x[0], x[1], x[2], x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[2] * x[0];
  return p;
}

Stress stress_of(const Eigen::Matrix3d &gradient, const Material &material)
{
  const double lambda = material.E * material.nu / ((1. + material.nu) * (1. - 2. * material.nu));
  const double mu     = material.E / (2. * (1. + material.nu));
  const double volume = lambda * gradient.trace();
  Stress       s;
  s << volume + 2. * mu * gradient(0, 0), volume + 2. * mu * gradient(1, 1), volume + 2. * mu * gradient(2, 2),
      mu * (gradient(0, 1) + gradient(1, 0)), mu * (gradient(1, 2) + gradient(2, 1)),
      mu * (gradient(2, 0) + gradient(0, 2));
  return s;
}

Eigen::Vector3d point(const QuadraticMesh &mesh, int node)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
}

/// Positions and stresses of all samples; those of cell i of a list start at begin[i].
struct Samples
{
  std::vector<Eigen::Index> begin{0};
  Eigen::MatrixXd           x; // [3 x samples]
  Stresses                  stress;

  Eigen::Index count(int i) const { return begin[i + 1] - begin[i]; }
};

Samples sample(const QuadraticMesh &mesh, const Material &material, const std::vector<int> &cells, const NodalFields &u)
{
  Samples result;
  for (const int cell : cells)
    result.begin.push_back(result.begin.back() + reference_cell(mesh.kind(cell)).samples.cols());
  result.x.resize(3, result.begin.back());
  result.stress.resize(2 * u.rows(), result.begin.back());
  CellValues values(mesh, CellPoints::samples);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const auto         first = result.begin[i], n = result.begin[i + 1] - first;
    const PointValues &samples    = values.of(cells[i]);
    result.x.middleCols(first, n) = positions(mesh, cells[i]) * samples.N;
    stresses_at(samples, mesh, material, cells[i], u, result.stress.middleCols(first, n));
  }
  return result;
}

/// The cells at every corner, compressed, as counted in a list of cells.
struct CellsAround
{
  const std::vector<int> &list;
  std::vector<int>        begin, cells;
};

/// Calls visit(node) for the corners of a cell.
template <typename Visit>
void for_each_corner(const QuadraticMesh &mesh, int cell, const Visit &visit)
{
  std::for_each_n(mesh.nodes(cell), reference_cell(mesh.kind(cell)).n_corners, visit);
}

CellsAround cells_around(const QuadraticMesh &mesh, const std::vector<int> &list)
{
  CellsAround around{list, {}, {}};
  around.begin.assign(mesh.n_nodes() + 1, 0);
  for (const int cell : list)
    for_each_corner(mesh, cell, [&](int node) { ++around.begin[node + 1]; });
  for (int i = 0; i < mesh.n_nodes(); ++i)
    around.begin[i + 1] += around.begin[i];
  around.cells.resize(around.begin.back());
  std::vector<int> next(around.begin.begin(), around.begin.end() - 1);
  for (std::size_t i = 0; i < list.size(); ++i)
    for_each_corner(mesh, list[i], [&](int node) { around.cells[next[node]++] = static_cast<int>(i); });
  return around;
}

std::vector<int> patch_of(const QuadraticMesh &mesh, const CellsAround &around, int corner, const Samples &samples)
{
  const auto       begin = around.cells.begin();
  std::vector<int> patch(begin + around.begin[corner], begin + around.begin[corner + 1]);
  Eigen::Index     count = 0;
  for (const int i : patch)
    count += samples.count(i);
  constexpr Eigen::Index fewest = 16; // samples of a patch; fewer do not carry a quadratic fit
  if (count >= fewest)
    return patch;
  const std::vector<int> own = patch;
  for (const int cell : own)
    for_each_corner(mesh, around.list[cell],
                    [&](int other)
                    { patch.insert(patch.end(), begin + around.begin[other], begin + around.begin[other + 1]); });
  std::sort(patch.begin(), patch.end());
  patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
  return patch;
}

/// Least squares fit of the stresses of a patch.
class PatchFit
{
public:
  PatchFit(const Samples &samples, const std::vector<int> &patch, const Eigen::Vector3d &centre) : centre_(centre)
  {
    Eigen::Index count = 0;
    for (const int i : patch)
      count += samples.count(i);
    Eigen::Matrix3Xd x(3, count);
    Stresses         stress(samples.stress.rows(), count);
    Eigen::Index     at = 0;
    for (const int i : patch)
    {
      const Eigen::Index n = samples.count(i), first = samples.begin[i];
      x.middleCols(at, n)      = samples.x.middleCols(first, n).colwise() - centre_;
      stress.middleCols(at, n) = samples.stress.middleCols(first, n);
      at += n;
    }
    scale_ = x.array().abs().rowwise().maxCoeff().max(std::numeric_limits<double>::min()).inverse();

    const Columns                               P      = monomials_of(x);
    Eigen::Matrix<double, monomials, monomials> normal = P * P.transpose();
    constexpr double ridge = 1e-6;             // of the quadratic monomials, which small patches do not all determine
    normal.diagonal().tail<6>() *= 1. + ridge; // z^2 is a constant to samples at z = +-a: then it is left out
    coefficients_ = normal.ldlt().solve(P * stress.transpose()).transpose();
  }

  /// Fitted stresses at places [3 x k], one in each column.
  Stresses operator()(const Eigen::Matrix3Xd &x) const { return coefficients_ * monomials_of(x.colwise() - centre_); }

private:
  using Columns = Eigen::Matrix<double, monomials, Eigen::Dynamic>;

  Columns monomials_of(const Eigen::Matrix3Xd &r) const
  {
    Columns P(monomials, r.cols());
    for (Eigen::Index k = 0; k < r.cols(); ++k)
      P.col(k) = monomials_at((r.col(k).array() * scale_).matrix());
    return P;
  }

  Eigen::Vector3d centre_;
  Eigen::Array3d  scale_;
  Eigen::MatrixXd coefficients_; // [6 fields x monomials]
};

/// The nodes that take a part of their stress from the fit around a corner, and how large a part.
class NodesOfCorner
{
public:
  explicit NodesOfCorner(const QuadraticMesh &mesh) : mesh_(mesh), seen_(mesh.n_nodes(), -1) {}

  void collect(const CellsAround &around, int corner)
  {
    nodes.clear();
    share.clear();
    for (int k = around.begin[corner]; k < around.begin[corner + 1]; ++k)
    {
      const int            cell      = around.list[around.cells[k]];
      const int           *of_cell   = mesh_.nodes(cell);
      const ReferenceCell &reference = reference_cell(mesh_.kind(cell));
      for (int a = 0; a < reference.n_nodes; ++a)
      {
        const std::vector<int> &amid = reference.between[a];
        if (seen_[of_cell[a]] == corner ||
            std::none_of(amid.begin(), amid.end(), [&](int c) { return of_cell[c] == corner; }))
          continue;
        seen_[of_cell[a]] = corner;
        nodes.push_back(of_cell[a]);
        share.push_back(1. / static_cast<double>(amid.size()));
      }
    }
  }

  std::vector<int>    nodes;
  std::vector<double> share;

private:
  const QuadraticMesh &mesh_;
  std::vector<int>     seen_; // last corner that took the node
};

} // namespace

void stresses_at(const PointValues &points, const QuadraticMesh &mesh, const Material &material, int cell,
                 const NodalFields &u, Eigen::Ref<Stresses> result)
{
  const int  *nodes = mesh.nodes(cell);
  NodalFields of_cell(u.rows(), mesh.n_nodes_of(cell));
  for (int a = 0; a < of_cell.cols(); ++a)
    of_cell.col(a) = u.col(nodes[a]);
  const Eigen::MatrixXd gradients = of_cell * points.dN; // du_i / dx_d of point k in column 3 k + d
  for (Eigen::Index k = 0; k < points.N.cols(); ++k)
    for (Eigen::Index field = 0; field < u.rows() / 3; ++field)
      result.col(k).segment<6>(6 * field) = stress_of(gradients.block<3, 3>(3 * field, 3 * k), material);
}

Stresses recovered_stresses(const QuadraticMesh &mesh, const Material &material, const std::vector<int> &cells,
                            const NodalFields &u)
{
  const Samples     samples = sample(mesh, material, cells, u);
  const CellsAround around  = cells_around(mesh, cells);
  Stresses          result  = Stresses::Zero(2 * u.rows(), mesh.n_nodes());
  NodesOfCorner     takers(mesh);
  for (int corner = 0; corner < mesh.n_nodes(); ++corner)
  {
    if (around.begin[corner] == around.begin[corner + 1])
      continue; // not a corner
    const PatchFit fit(samples, patch_of(mesh, around, corner, samples), point(mesh, corner));
    takers.collect(around, corner);
    Eigen::Matrix3Xd x(3, takers.nodes.size());
    for (std::size_t k = 0; k < takers.nodes.size(); ++k)
      x.col(k) = point(mesh, takers.nodes[k]);
    const Stresses fitted = fit(x);
    for (std::size_t k = 0; k < takers.nodes.size(); ++k)
      result.col(takers.nodes[k]) += takers.share[k] * fitted.col(k);
  }
  return result;
}

double energy_product(const Eigen::Ref<const Stress> &s, const Eigen::Ref<const Stress> &t, const Material &material)
{
  const double normal = s.head<3>().dot(t.head<3>()), shear = s.tail<3>().dot(t.tail<3>());
  return ((1. + material.nu) * (normal + 2. * shear) - material.nu * s.head<3>().sum() * t.head<3>().sum()) /
         material.E;
}

} // namespace gestell::fem
