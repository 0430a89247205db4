#include "coupling/integration/force_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

ExactContext::ExactContext(const SecondOrderSystem &machine, const ModalBlocks &modes, const NewtonOptions &options)
    : system(&machine), measures(modes, machine), newton(options)
{
  const auto n_u = machine.directions().cols();
  u_begin.setZero(n_u);
  scale.setZero(n_u);
  mobility = measures.read_v.transpose() * measures.put;
  rate_.setZero(2 * measures.n_p);
}

void ExactContext::accelerate(const Eigen::VectorXd &x, LocalState &local)
{
  for (int b = 0; b < measures.n_p; ++b)
  {
    const ModalBlock &block = measures.blocks[b];
    const double      x_1 = x[b], x_2 = x[measures.n_p + b];
    double           &y_1 = rate_[b], &y_2 = rate_[measures.n_p + b];
    switch (block.kind)
    {
    case ModalBlock::oscillating:
      y_1 = block.s * x_1 - block.w * x_2;
      y_2 = block.w * x_1 + block.s * x_2;
      break;
    case ModalBlock::decaying:
      y_1 = block.s * x_1;
      y_2 = block.w * x_2;
      break;
    case ModalBlock::free:
      y_1 = x_2;
      y_2 = 0.;
      break;
    }
  }
  rate_ += measures.constant;
  local.a.noalias() = measures.read_v.transpose() * rate_;
  const auto &held  = system->held();
  if (!held.empty())
  {
    factorise_delassus(local.t);
    for (const HeldMeasure &h : held)
      local.p[h.measure] = 0.;
    for (std::size_t i = 0; i < held.size(); ++i)
      rest_[Eigen::Index(i)] = -local.a[held[i].measure] - mobility.row(held[i].measure).dot(local.p);
    delassus_.solve_in_place(rest_);
    for (std::size_t i = 0; i < held.size(); ++i)
      local.p[held[i].measure] = rest_[Eigen::Index(i)];
  }
  local.a.noalias() += mobility.lazyProduct(local.p);
}

/// W_h^T M^-1 W_h of the held measures.
void ExactContext::factorise_delassus(double t)
{
  const auto &held = system->held();
  const int   n    = int(held.size());
  if (rest_.size() != n)
  {
    rest_.setZero(n);
    delassus_.resize(n);
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      delassus_.matrix()(i, j) = mobility(held[i].measure, held[j].measure);
  if (!delassus_.factorise())
    fail_singular(*system, t);
}

void ExactContext::project_held(Eigen::VectorXd &x, LocalState &local)
{
  const auto &held = system->held();
  factorise_delassus(local.t);
  for (std::size_t i = 0; i < held.size(); ++i)
    rest_[Eigen::Index(i)] = held[i].rate - local.v[held[i].measure];
  delassus_.solve_in_place(rest_);
  for (std::size_t i = 0; i < held.size(); ++i)
  {
    x += rest_[Eigen::Index(i)] * measures.put.col(held[i].measure);
    local.v += rest_[Eigen::Index(i)] * mobility.col(held[i].measure);
  }
}

void ExactContext::grow_scale(Eigen::VectorXd &grown, const Eigen::Ref<const Eigen::VectorXd> &u,
                              const Eigen::Ref<const Eigen::VectorXd> &v, double h) const
{
  constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < u.size(); ++i)
    grown[i] = std::max(
        {grown[i], std::abs(u[i] - u_begin[i]), h * std::abs(v[i]), rounding / newton.tolerance * std::abs(u[i])});
}

HermiteNodes::HermiteNodes(std::vector<double> sigma)
    : sigma_(std::move(sigma)), inverse_(sigma_.size(), 1.), own_slope_(sigma_.size(), 0.)
{
  for (std::size_t i = 0; i < sigma_.size(); ++i)
    for (std::size_t j = 0; j < sigma_.size(); ++j)
      if (j != i)
      {
        inverse_[i] /= sigma_[i] - sigma_[j];
        own_slope_[i] += 1. / (sigma_[i] - sigma_[j]);
      }
}

void HermiteNodes::weights(double sigma, double *value, double *slope, double *rate_value, double *rate_slope) const
{
  const int n = size();
  for (int i = 0; i < n; ++i)
  {
    double L = inverse_[i], L_slope = 0.;
    for (int j = 0; j < n; ++j)
      if (j != i)
      {
        L_slope = L_slope * (sigma - sigma_[j]) + L;
        L *= sigma - sigma_[j];
      }
    const double d = sigma - sigma_[i], square = L * L, b = 1. - 2. * d * own_slope_[i];
    value[i]      = b * square;
    slope[i]      = d * square;
    rate_value[i] = -2. * own_slope_[i] * square + 2. * b * L * L_slope;
    rate_slope[i] = square + 2. * d * L * L_slope;
  }
}

} // namespace gestell::coupling
