#include "fem/patch_recovery.h"

#include "fem/reference_cell.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace gestell::fem
{

namespace
{

using Stress = Eigen::Matrix<double, 6, 1>;

constexpr int         monomials = 10;   // 1 x y z xx yy zz xy yz zx
constexpr std::size_t fewest    = 16;   // samples of a patch; fewer do not carry a quadratic fit
constexpr double      ridge     = 1e-6; // of the quadratic monomials, which small patches do not all determine

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

// of a cell, without allocations
using Positions = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 27>;
using Slopes    = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, 27, 3>;

Positions positions_of(const QuadraticMesh &mesh, int cell)
{
  Positions X(3, mesh.nodes_per_cell());
  for (int a = 0; a < X.cols(); ++a)
    X.col(a) = Eigen::Map<const Eigen::Vector3d>(mesh.points[mesh.nodes(cell)[a]].data());
  return X;
}

/// Stresses of all fields at one point of a cell; column `at` of the result.
void stresses_at(const ReferenceCell::Point &point, const Positions &X, const int *nodes, const Material &material,
                 const Eigen::MatrixXd &u, Eigen::Ref<Eigen::VectorXd> result)
{
  const Eigen::Matrix3d J     = X.lazyProduct(point.dN);
  const Slopes          slope = point.dN.lazyProduct(J.inverse().eval()); // dN_a / dx_j
  for (int field = 0; field < u.cols(); ++field)
  {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero(); // du_i / dx_j
    for (int a = 0; a < slope.rows(); ++a)
      gradient += u.col(field).segment<3>(3 * nodes[a]) * slope.row(a);
    result.segment<6>(6 * field) = stress_of(gradient, material);
  }
}

Eigen::Vector3d point(const QuadraticMesh &mesh, int node)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
}

/// Places and stresses of all samples; those of a cell stand together.
struct Samples
{
  int             per_cell = 0;
  Eigen::MatrixXd x; // [3 x samples]
  Stresses        stress;
};

Samples sample(const QuadraticMesh &mesh, const Material &material, const std::vector<int> &cells,
               const Eigen::MatrixXd &u)
{
  const ReferenceCell &reference = reference_cell(mesh);
  Samples              result;
  result.per_cell = static_cast<int>(reference.samples.size());
  result.x.resize(3, cells.size() * result.per_cell);
  result.stress.resize(6 * u.cols(), cells.size() * result.per_cell);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const Positions X = positions_of(mesh, cells[i]);
    for (int k = 0; k < result.per_cell; ++k)
    {
      const auto at    = static_cast<Eigen::Index>(i) * result.per_cell + k;
      result.x.col(at) = X.lazyProduct(reference.samples[k].N);
      stresses_at(reference.samples[k], X, mesh.nodes(cells[i]), material, u, result.stress.col(at));
    }
  }
  return result;
}

/// The cells at every corner, compressed, as counted in a list of cells.
struct CellsAround
{
  const std::vector<int> &list;
  std::vector<int>        begin, cells;
};

CellsAround cells_around(const QuadraticMesh &mesh, const std::vector<int> &list)
{
  const std::vector<int> &corners = reference_cell(mesh).corners;
  CellsAround             around{list, {}, {}};
  around.begin.assign(mesh.n_nodes() + 1, 0);
  for (const int cell : list)
    for (const int k : corners)
      ++around.begin[mesh.nodes(cell)[k] + 1];
  for (int i = 0; i < mesh.n_nodes(); ++i)
    around.begin[i + 1] += around.begin[i];
  around.cells.resize(around.begin.back());
  std::vector<int> next(around.begin.begin(), around.begin.end() - 1);
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const int k : corners)
      around.cells[next[mesh.nodes(list[i])[k]]++] = static_cast<int>(i);
  return around;
}

std::vector<int> patch_of(const QuadraticMesh &mesh, const CellsAround &around, int corner, std::size_t samples)
{
  const auto       begin = around.cells.begin();
  std::vector<int> patch(begin + around.begin[corner], begin + around.begin[corner + 1]);
  if (patch.size() * samples >= fewest)
    return patch;
  const std::vector<int> own = patch;
  for (const int cell : own)
    for (const int k : reference_cell(mesh).corners)
    {
      const int other = mesh.nodes(around.list[cell])[k];
      patch.insert(patch.end(), begin + around.begin[other], begin + around.begin[other + 1]);
    }
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
    const int      n     = samples.per_cell;
    Eigen::Array3d reach = Eigen::Array3d::Constant(std::numeric_limits<double>::min());
    for (const int cell : patch)
      for (int k = 0; k < n; ++k)
        reach = reach.max((samples.x.col(cell * n + k) - centre_).array().abs());
    scale_ = reach.inverse();

    Eigen::Matrix<double, monomials, monomials> normal = Eigen::Matrix<double, monomials, monomials>::Zero();
    Eigen::MatrixXd                             right  = Eigen::MatrixXd::Zero(monomials, samples.stress.rows());
    for (const int cell : patch)
      for (int k = 0; k < n; ++k)
      {
        const Monomials p = at(samples.x.col(cell * n + k));
        normal += p * p.transpose();
        right.noalias() += p * samples.stress.col(cell * n + k).transpose();
      }
    normal.diagonal().tail<6>() *= 1. + ridge; // z^2 is a constant to samples at z = +-a: then it is left out
    coefficients_ = normal.ldlt().solve(right);
  }

  Eigen::VectorXd operator()(const Eigen::Vector3d &x) const { return coefficients_.transpose() * at(x); }

private:
  Monomials at(const Eigen::Vector3d &x) const { return monomials_at(((x - centre_).array() * scale_).matrix()); }

  Eigen::Vector3d centre_;
  Eigen::Array3d  scale_;
  Eigen::MatrixXd coefficients_; // [monomials x 6 fields]
};

} // namespace

Stresses nodal_stresses(const QuadraticMesh &mesh, const Material &material, int cell, const Eigen::MatrixXd &u)
{
  const auto     &nodes = reference_cell(mesh).nodes;
  Stresses        result(6 * u.cols(), nodes.size());
  const Positions X = positions_of(mesh, cell);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    stresses_at(nodes[a], X, mesh.nodes(cell), material, u, result.col(a));
  return result;
}

Stresses recovered_stresses(const QuadraticMesh &mesh, const Material &material, const std::vector<int> &cells,
                            const Eigen::MatrixXd &u)
{
  const ReferenceCell &reference = reference_cell(mesh);
  const Samples        samples   = sample(mesh, material, cells, u);
  const CellsAround    around    = cells_around(mesh, cells);
  Stresses             result    = Stresses::Zero(6 * u.cols(), mesh.n_nodes());
  std::vector<int>     seen(mesh.n_nodes(), -1); // by which corner
  for (int corner = 0; corner < mesh.n_nodes(); ++corner)
  {
    if (around.begin[corner] == around.begin[corner + 1])
      continue; // no corner
    const PatchFit fit(samples, patch_of(mesh, around, corner, reference.samples.size()), point(mesh, corner));
    for (int k = around.begin[corner]; k < around.begin[corner + 1]; ++k)
    {
      const int *nodes = mesh.nodes(cells[around.cells[k]]);
      for (int a = 0; a < reference.n_nodes; ++a)
      {
        const std::vector<int> &amid = reference.between[a];
        if (seen[nodes[a]] == corner ||
            std::none_of(amid.begin(), amid.end(), [&](int c) { return nodes[reference.corners[c]] == corner; }))
          continue;
        seen[nodes[a]] = corner;
        result.col(nodes[a]) += fit(point(mesh, nodes[a])) / static_cast<double>(amid.size());
      }
    }
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
