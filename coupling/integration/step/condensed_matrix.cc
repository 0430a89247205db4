#include "coupling/integration/step/condensed_matrix.h"

#include <algorithm>

namespace gestell::coupling
{

CondensedMatrix::CondensedMatrix(const SecondOrderSystem &system) : blocks_(system.forces().blocks())
{
  for (const ForceBlock &block : blocks_)
    for (int i = 0; i < block.n_measures; ++i)
      of_forces_.push_back(block.first_measure + i);
  const auto n_u = system.forces().directions().cols(), n_c = Eigen::Index(system.joints().n_rows()),
             n_F = Eigen::Index(of_forces_.size());
  is_held_.assign(of_forces_.size(), 0);
  tangent_.reserve(std::size_t(tangent_size(blocks_)));
  forces_.resize(int(n_F));
  joints_.resize(int(n_c));
  S_G_.setZero(n_u, n_c);
  G_S_G_.setZero(n_c, n_c);
  X_.setZero(n_F, n_c);
  delta_F_.setZero(n_F);
  p_F_.setZero(n_F);
}

void CondensedMatrix::set_joints(const Eigen::MatrixXd &S, const ConstraintJacobian &G)
{
  G.times_transposed(S, S_G_);
  G.times(S_G_, G_S_G_);
}

namespace
{
/// Displacement of a sticking measure under a unit force, which converts its unknown to a displacement like all others.
double own_compliance(const Eigen::MatrixXd &S, int measure)
{
  const double own = S(measure, measure);
  return own > 0. ? own : 1.;
}
} // namespace

void CondensedMatrix::collect(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent,
                              const std::vector<HeldMeasure> &held)
{
  for (std::size_t i = 0; i < of_forces_.size(); ++i)
  {
    is_held_[i] = 0;
    for (const HeldMeasure &h : held)
      if (h.measure == of_forces_[i])
        is_held_[i] = 1;
  }
  tangent_.clear();
  const double *value = tangent.data();
  int           first = 0;
  for (const ForceBlock &block : blocks_)
  {
    const int end = first + block.n_measures;
    for (int j = first; j < end; ++j)
      for (int i = first; i < end; ++i, ++value)
        if (is_held_[j] && i == j)
          tangent_.push_back({i, j, 1. / own_compliance(S, of_forces_[j])});
        else if (*value != 0.)
          tangent_.push_back({i, j, *value});
    first = end;
  }
}

/// y = p' x on the measures of forces.
void CondensedMatrix::times_tangent(const double *x, double *y) const
{
  std::fill_n(y, of_forces_.size(), 0.);
  for (const Entry &e : tangent_)
    y[e.row] += e.value * x[e.column];
}

bool CondensedMatrix::factorise(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent,
                                const std::vector<HeldMeasure> &held)
{
  const int n_F = int(of_forces_.size()), n_c = int(S_G_.cols());
  failed_joint_ = -1;
  collect(S, tangent, held);
  if (tangent_.empty()) // J = E, H = G S G^T
  {
    joints_.matrix() = G_S_G_;
    return factorise_joints();
  }
  Eigen::MatrixXd &J = forces_.matrix();
  J.setZero();
  for (const Entry &e : tangent_)
  {
    const double *of_S   = S.data() + S.rows() * of_forces_[e.row];
    double       *column = J.data() + J.rows() * e.column;
    for (int k = 0; k < n_F; ++k)
      column[k] -= e.value * of_S[of_forces_[k]];
  }
  for (int j = 0; j < n_F; ++j)
    if (!is_held_[j]) // adding 1 and taking it away again would round a small S away
      J(j, j) += 1.;
  if (!forces_.factorise(!held.empty()))
    return false;
  if (n_c == 0)
    return true;

  for (int c = 0; c < n_c; ++c)
  {
    double *x = X_.data() + Eigen::Index(n_F) * c;
    for (int k = 0; k < n_F; ++k)
      x[k] = S_G_(of_forces_[k], c);
    forces_.solve_in_place(x);
  }
  Eigen::MatrixXd &H = joints_.matrix();
  for (int c = 0; c < n_c; ++c)
  {
    times_tangent(X_.data() + Eigen::Index(n_F) * c, p_F_.data());
    for (int d = 0; d < n_c; ++d)
    {
      double sum = G_S_G_(d, c);
      for (int k = 0; k < n_F; ++k)
        sum += S_G_(of_forces_[k], d) * p_F_[k];
      H(d, c) = sum;
    }
  }
  return factorise_joints();
}

bool CondensedMatrix::factorise_joints()
{
  if (joints_.matrix().size() == 0 || joints_.factorise())
    return true;
  failed_joint_ = joints_.failed();
  return false;
}

void CondensedMatrix::close_joints(Eigen::VectorXd &g, Eigen::VectorXd &a) const
{
  g = -g;
  joints_.solve_in_place(g);
  a.noalias() += S_G_.lazyProduct(g);
}

void CondensedMatrix::solve_in_place(const Eigen::MatrixXd &S, const ConstraintJacobian &G, Eigen::VectorXd &r,
                                     Eigen::VectorXd &g)
{
  const int n_F = int(of_forces_.size()), n_c = int(S_G_.cols());
  if (tangent_.empty())
  {
    G.add_product(1., r, g);
    close_joints(g, r);
    return;
  }
  for (int k = 0; k < n_F; ++k)
    delta_F_[k] = r[of_forces_[k]];
  forces_.solve_in_place(delta_F_);
  if (n_c > 0)
  {
    times_tangent(delta_F_.data(), p_F_.data());
    G.add_product(1., r, g);
    for (int c = 0; c < n_c; ++c)
    {
      double sum = -g[c];
      for (int k = 0; k < n_F; ++k)
        sum -= S_G_(of_forces_[k], c) * p_F_[k];
      g[c] = sum;
    }
    joints_.solve_in_place(g);
    delta_F_.noalias() += X_.lazyProduct(g);
    times_tangent(delta_F_.data(), p_F_.data());
    r.noalias() += S_G_.lazyProduct(g);
    for (int k = 0; k < n_F; ++k)
      if (p_F_[k] != 0.)
        r.noalias() += p_F_[k] * S.col(of_forces_[k]);
  }
  for (int k = 0; k < n_F; ++k)
    r[of_forces_[k]] = is_held_[k] ? delta_F_[k] / own_compliance(S, of_forces_[k]) : delta_F_[k];
}

} // namespace gestell::coupling
