#include "fem/assembly/supports.h"

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

/// Row of C summed over the nodes that a clamped support fixes in direction d.
Eigen::VectorXd clamped_row(const std::vector<char> &counted, const BlockMatrix &C)
{
  const BlockMatrix::Rows rows = C.rows();
  Eigen::VectorXd         row  = Eigen::VectorXd::Zero(counted.size());
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (counted[i])
      for (int k = rows.begin[i / 3]; k < rows.begin[i / 3 + 1]; ++k)
        for (int e = 0; e < 3; ++e)
          row[3 * rows.columns[k] + e] += rows.values[9 * k + 3 * e + i % 3];
  return row;
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

void add_foundations(const std::vector<SupportedPatch> &supports, Vector3 Support::*totals, BlockMatrix &matrix)
{
  for (const auto &[support, patch] : supports)
    if (support.kind == SupportKind::foundation)
    {
      const Eigen::Matrix3d per_area = directed(support, totals) / patch.area;
      for (int column = 0; column < patch.S.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(patch.S, column); entry; ++entry)
        {
          const Eigen::Matrix3d block = entry.value() * per_area;
          matrix.add_block(patch.nodes[entry.row()], patch.nodes[column], block.data());
        }
    }
  matrix.finish();
}

BlockMatrix assemble_foundations(const std::vector<SupportedPatch> &supports, Vector3 Support::*totals, int n_nodes)
{
  std::vector<std::array<int, 6>> faces;
  std::vector<std::array<int, 9>> quads;
  for (const auto &[support, patch] : supports)
    if (support.kind == SupportKind::foundation)
    {
      faces.insert(faces.end(), patch.faces.begin(), patch.faces.end());
      quads.insert(quads.end(), patch.quads.begin(), patch.quads.end());
    }
  BlockMatrix B(3, n_nodes, {faces, quads});
  add_foundations(supports, totals, B);
  return B;
}

std::vector<FrameOutput> support_forces(const std::vector<SupportedPatch> &supports, const BlockMatrix &C,
                                        const AffineConstraints &affine, const Eigen::VectorXd &nodal_mass,
                                        double rayleigh_stiffness)
{
  const int                n = affine.n_displacements();
  std::vector<char>        counted_before(n, 0);
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
      {
        std::vector<char> counted(n, 0);
        for (const int node : patch.nodes)
          if (support.held[d] && !counted_before[3 * node + d])
          {
            counted[3 * node + d] = counted_before[3 * node + d] = 1;
            output.under_acceleration[d] -= nodal_mass[node];
          }
        output.on_q = affine.gather(clamped_row(counted, C));
        output.on_v = rayleigh_stiffness * output.on_q;
        output.on_q += affine.gather(held_foundations_row(supports, &Support::stiffness, counted));
        output.on_v += affine.gather(held_foundations_row(supports, &Support::damping, counted));
      }
      outputs.push_back(std::move(output));
    }
  return outputs;
}

} // namespace gestell::fem
