#include "fem/assembly/supports.h"

#include "fem/assembly/elasticity.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

std::string head(const Support &support)
{
  const std::string owner = "support \"" + support.name + "\"";
  return support.place.empty() ? owner : support.place + ": " + owner;
}

void require_valid(const Support &support)
{
  const char *const axes[3]     = {"x", "y", "z"};
  bool              does_hold   = false;
  const auto        require_one = [&](const char *quantity, const char *unit, double value, int d)
  {
    if (std::isfinite(value) && value >= 0.)
      return;
    std::ostringstream message;
    message << head(support) << ": " << quantity << " in " << axes[d] << " is " << value << " " << unit
            << ", but it must be finite and not negative.";
    throw std::invalid_argument(message.str());
  };
  for (int d = 0; d < 3; ++d)
    if (support.kind == SupportKind::clamped)
      does_hold = does_hold || support.held[d];
    else
    {
      require_one("stiffness", "N/m", support.stiffness[d], d);
      require_one("damping", "N s/m", support.damping[d], d);
      does_hold = does_hold || support.stiffness[d] > 0. || support.damping[d] > 0.;
    }
  if (!does_hold)
    throw std::invalid_argument(head(support) +
                                " acts in no direction; fix x, y or z, or give a foundation a stiffness [N/m].");
}

/// Rows of the cells' C and M, summed over the displacements of each output [3 n_nodes x n_outputs].
struct SummedRows
{
  Eigen::SparseMatrix<double> C, M;
};

/// @param output_of  a displacement, or -1
SummedRows summed_rows(const std::vector<int> &output_of, int n_outputs, const QuadraticMesh &mesh,
                       const CellMaterials &materials)
{
  std::vector<Eigen::Triplet<double>> stiffness, mass;
  CellValues                          values(mesh, CellPoints::rule);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    std::vector<int> own; // displacements
    for (int a = 0; a < mesh.n_nodes_of(cell); ++a)
      for (int d = 0; d < 3; ++d)
        own.push_back(3 * mesh.nodes(cell)[a] + d);
    if (std::all_of(own.begin(), own.end(), [&](int i) { return output_of[i] < 0; }))
      continue;
    const Eigen::MatrixXd C = tangent_stiffness(values.of(cell), mesh, materials, cell);
    const Eigen::MatrixXd M = mass_matrix(values.of(cell), materials[cell].rho);
    for (std::size_t i = 0; i < own.size(); ++i)
      if (const int output = output_of[own[i]]; output >= 0)
        for (std::size_t j = 0; j < own.size(); ++j)
        {
          stiffness.emplace_back(own[j], output, C(Eigen::Index(j), Eigen::Index(i)));
          if (i % 3 == j % 3)
            mass.emplace_back(own[j], output, M(Eigen::Index(j / 3), Eigen::Index(i / 3)));
        }
  }
  const auto matrix = [&](const std::vector<Eigen::Triplet<double>> &entries)
  {
    Eigen::SparseMatrix<double> rows(Eigen::Index(output_of.size()), n_outputs);
    rows.setFromTriplets(entries.begin(), entries.end());
    return rows;
  };
  return {matrix(stiffness), matrix(mass)};
}

/// sum_d k_d a_d a_d^T
Eigen::Matrix3d directed(const Support &support, Vector3 Support::*totals)
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
  for (int d = 0; d < 3; ++d)
  {
    const Eigen::Map<const Eigen::Vector3d> a(support.axes[d].data());
    K += (support.*totals)[d] * a * a.transpose();
  }
  return 0.5 * (K + K.transpose());
}

Eigen::VectorXd foundation_row(const SupportedPatch &supported, int d, Vector3 Support::*totals, int n_displacements)
{
  const auto &[support, patch] = supported;
  const Eigen::Matrix3d K      = directed(support, totals);
  Eigen::VectorXd       row    = Eigen::VectorXd::Zero(n_displacements);
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    row.segment<3>(3 * patch.nodes[i]) = -patch.weight[i] / patch.area * K.col(d);
  return row;
}

/// Sum of the rows of foundations for displacements that a clamp fixes.
Eigen::VectorXd held_foundations_row(const std::vector<SupportedPatch> &supports, Vector3 Support::*totals,
                                     const std::vector<char> &held)
{
  Eigen::VectorXd row = Eigen::VectorXd::Zero(held.size());
  for (const auto &[support, patch] : supports)
    if (support.kind == SupportKind::foundation)
    {
      const Eigen::Matrix3d per_area = directed(support, totals) / patch.area;
      for (int column = 0; column < patch.S.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(patch.S, column); entry; ++entry)
          for (int d = 0; d < 3; ++d)
            if (held[3 * patch.nodes[entry.row()] + d])
              row.segment<3>(3 * patch.nodes[column]) += entry.value() * per_area.col(d);
    }
  return row;
}

void require_orthonormal(const Support &support)
{
  Eigen::Matrix3d A;
  for (int d = 0; d < 3; ++d)
    A.col(d) = Eigen::Map<const Eigen::Vector3d>(support.axes[d].data());
  if (!((A.transpose() * A - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-8))
    throw std::invalid_argument(head(support) + ": its axes must be unit vectors at right angles to each other.");
}

} // namespace

std::vector<SupportedPatch> find_supports(const Mesh &mesh, const QuadraticMesh &quadratic,
                                          const std::vector<Support> &supports)
{
  std::vector<SupportedPatch> result;
  for (const Support &support : supports)
  {
    require_valid(support);
    require_orthonormal(support);
    result.push_back(
        {support, surface_patch(mesh, quadratic, support.surfaces, "support \"" + support.name + "\"", support.place)});
    auto &[own, patch] = result.back();
    for (int d = 0; d < 3; ++d)
    {
      own.stiffness[d] *= support.per_area[0] ? patch.area : 1.;
      own.damping[d] *= support.per_area[1] ? patch.area : 1.;
    }
  }
  return result;
}

void hold(const std::vector<SupportedPatch> &supports, MultipointConstraints &constraints)
{
  for (const auto &[support, patch] : supports)
    if (support.kind == SupportKind::clamped)
      for (const int node : patch.nodes)
      {
        constraints.holder.emplace(node, support.name);
        for (int d = 0; d < 3; ++d)
          if (support.held[d])
            constraints.held[3 * node + d] = 1;
      }
}

Eigen::SparseMatrix<double> foundations(const std::vector<SupportedPatch> &supports, Vector3 Support::*totals,
                                        const AffineConstraints &affine)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto &[support, patch] : supports)
    if (support.kind == SupportKind::foundation)
    {
      const Eigen::Matrix3d per_area = directed(support, totals) / patch.area;
      for (int column = 0; column < patch.S.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(patch.S, column); entry; ++entry)
          for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e)
              entries.emplace_back(3 * patch.nodes[entry.row()] + d, 3 * patch.nodes[column] + e,
                                   entry.value() * per_area(d, e));
    }
  Eigen::SparseMatrix<double> A(affine.n_displacements(), affine.n_displacements());
  A.setFromTriplets(entries.begin(), entries.end());
  return affine.project(A);
}

std::vector<FrameOutput> support_forces(const std::vector<SupportedPatch> &supports, const QuadraticMesh &mesh,
                                        const CellMaterials &materials, const AffineConstraints &affine,
                                        const Eigen::VectorXd &nodal_mass, const std::array<double, 2> &rayleigh)
{
  const int                n = affine.n_displacements();
  std::vector<int>         clamped_at(n, -1); // output of the first support that holds the displacement
  std::vector<FrameOutput> outputs;
  for (const SupportedPatch &supported : supports)
    for (int d = 0; d < 3; ++d)
    {
      const auto &[support, patch] = supported;
      FrameOutput output{"support." + support.name + "." + "xyz"[d], "N", {}, {}, Eigen::Vector3d::Zero()};
      if (support.kind == SupportKind::foundation)
      {
        output.on_q = affine.gather(foundation_row(supported, d, &Support::stiffness, n));
        output.on_v = affine.gather(foundation_row(supported, d, &Support::damping, n));
      }
      else
        for (const int node : patch.nodes)
          if (support.held[d] && clamped_at[3 * node + d] < 0)
          {
            clamped_at[3 * node + d] = static_cast<int>(outputs.size());
            output.under_acceleration[d] -= nodal_mass[node];
          }
      outputs.push_back(std::move(output));
    }
  const SummedRows rows = summed_rows(clamped_at, int(outputs.size()), mesh, materials);
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (supports[k / 3].support.kind == SupportKind::clamped)
    {
      std::vector<char> counted(n, 0);
      std::transform(clamped_at.begin(), clamped_at.end(), counted.begin(), [k](int at) { return at == int(k); });
      const Eigen::VectorXd of_cells = affine.gather(Eigen::VectorXd(rows.C.col(Eigen::Index(k))));
      outputs[k].on_a                = affine.gather(Eigen::VectorXd(rows.M.col(Eigen::Index(k))));
      outputs[k].on_q = of_cells + affine.gather(held_foundations_row(supports, &Support::stiffness, counted));
      outputs[k].on_v = rayleigh[0] * outputs[k].on_a + rayleigh[1] * of_cells +
                        affine.gather(held_foundations_row(supports, &Support::damping, counted));
    }
  return outputs;
}

} // namespace gestell::fem
