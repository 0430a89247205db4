#include "coupling/integration/system/error_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

// Rounding errors in measures and coordinates: see ErrorScale.

namespace
{
constexpr double terms = 8.; ///< rounding of numbers that are the sum of several, enlarged by levers
} // namespace

/// A joint of size r [m] closes to epsilon r.  Whichever of its measures takes that does not move further than its mass
/// lets it where others yield more easily, sqrt(m_k) |u_k| <= epsilon r min_l sqrt(m_l)/|G_l|: a length by epsilon r,
/// an angle of a small body by as much more as its lever is short of a metre.
void ErrorScale::find_noise_of_joints()
{
  LocalState at;
  at.resize(system_);
  at.u                 = u_begin_;
  at.v                 = rate_begin_;
  Eigen::VectorXd    g = Eigen::VectorXd::Zero(system_.joints().n_rows());
  ConstraintJacobian G(system_.joints().blocks());
  system_.joints().constraints(at, g, G);
  for (std::size_t b = 0; b < G.blocks().size(); ++b)
  {
    const ConstraintBlock &block = G.blocks()[b];
    const auto             own   = static_cast<const ConstraintJacobian &>(G)[b];
    const auto             lever = [&](int k) { return own.col(k).cwiseAbs().maxCoeff(); };
    const auto             mass  = [&](int k) { return root_mass_[block.first_measure + k]; };
    double                 least = std::numeric_limits<double>::infinity(); // root of energy per g
    for (int k = 0; k < block.n_measures; ++k)
      if (lever(k) > 0. && mass(k) > 0.)
        least = std::min(least, mass(k) / lever(k));
    for (int k = 0; k < block.n_measures; ++k)
    {
      const double way                = mass(k) > 0. && std::isfinite(least) ? std::max(1., least / mass(k)) : 1.;
      noise_[block.first_measure + k] = terms * block.size * way;
    }
  }
}

/// In a step a force with dp/du'' moves a measure by  1/m dp/du''  times the motion of the others, if nothing else
/// moves it; the norm of dp/du'' is that of any position, as for an unbalance at any angle.
void ErrorScale::inertia(const LocalState &at)
{
  if (system_.joints().n_rows() == 0)
    return;
  const std::vector<ForceBlock> blocks = system_.forces().blocks();
  Eigen::VectorXd p = Eigen::VectorXd::Zero(noise_.size()), tangent = Eigen::VectorXd::Zero(tangent_size(blocks));
  system_.forces().tangent_blocks(at, 0., 0., 1., p, tangent);
  const double *entry    = tangent.data();
  bool          carry_it = false;
  for (const ForceBlock &block : blocks)
  {
    const int    n  = block.n_measures;
    const double dp = Eigen::Map<const Eigen::MatrixXd>(entry, n, n).norm();
    entry += n * n;
    if (!(dp > 0.))
      continue;
    carry_it           = true;
    const double noise = joint_noise_.segment(block.first_measure, n).maxCoeff();
    for (int j = block.first_measure; j < block.first_measure + n; ++j)
      if (root_mass_[j] > 0.)
        noise_[j] = std::max(noise_[j], dp * noise / (root_mass_[j] * root_mass_[j]));
  }
  if (carry_it)
    spread(noise_, noise_of_groups_);
}

/// Rounding errors of joints and forces, from the sizes of their terms, in their own measures, from there in the
/// coordinates, and then in all measures of these.
void ErrorScale::find_noise()
{
  noise_.setZero(ends_.cols());
  const auto own = [this](int first, int n, double size) { noise_.segment(first, n).setConstant(terms * size); };
  find_noise_of_joints();
  joint_noise_ = noise_;
  spread(joint_noise_, noise_of_groups_);
  for (const ForceBlock &block : system_.forces().blocks())
    own(block.first_measure, block.n_measures, block.size);
  for (const Virtual &z : virtual_)
    noise_[z.measure] = 0.;
  spread(noise_, noise_of_groups_);
}

/// Transfers noise of measures to their coordinates, and to all measures of these; groups: in the energy norm.
void ErrorScale::spread(Eigen::VectorXd &noise, std::vector<double> &of_groups) const
{
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(ends_.rows()); // of the coordinates, as its root
  of_groups.assign(n_groups_, 0.);
  for (int j = 0; j < ends_.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(ends_, j); it; ++it)
      energy[it.row()] = std::max(energy[it.row()], root_mass_[j] * noise[j]);
  for (int j = 0; j < ends_.outerSize(); ++j)
  {
    double of_ends = 0.;
    for (Eigen::SparseMatrix<double>::InnerIterator it(ends_, j); it; ++it)
      if (const double m = m_[end_index_[it.row()]]; m > 0.)
        of_ends = std::max(of_ends, it.value() * energy[it.row()] / std::sqrt(m));
    noise[j] = std::max(noise[j], of_ends);
  }
  for (std::size_t k = 0; k < end_index_.size(); ++k)
    of_groups[end_group_[k]] = std::max(of_groups[end_group_[k]], energy[Eigen::Index(k)]);
}

} // namespace gestell::coupling
