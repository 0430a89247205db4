#include "coupling/integration/propagation/force_step.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
/// Y_j^T M Y_j of the columns of Y.
Eigen::VectorXd energies(const SecondOrderSystem &system, const Eigen::MatrixXd &Y)
{
  Eigen::VectorXd y(Y.rows()), product(Y.rows()), sums(Y.cols());
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
  {
    y = Y.col(j);
    system.linear().mass_times(y, product);
    sums[j] = y.dot(product);
  }
  return sums;
}
} // namespace

PropagationContext::PropagationContext(const SecondOrderSystem &machine, const ModalBlocks &modes,
                                       const NewtonOptions &options)
    : system(&machine), measures(modes, machine), newton(options)
{
  const auto n_u = machine.forces().directions().cols();
  u_begin.setZero(n_u);
  scale.setZero(n_u);
  force.setZero(n_u);
  mobility      = measures.read_v.transpose() * measures.put;
  root_mobility = mobility.diagonal().cwiseMax(0.).cwiseSqrt();
  rate_.setZero(2 * measures.n_p);
  mass_of_q_     = energies(machine, reordered(modes.Q, measures.n_p));
  mass_of_v_     = energies(machine, reordered(modes.V, measures.n_p));
  double omega_1 = 0.;
  for (int b = 0; b < modes.n_modal; ++b)
    if (modes.blocks[b].kind == ModalBlock::oscillating)
      if (const double omega = std::hypot(modes.blocks[b].s, modes.blocks[b].w); omega_1 == 0. || omega < omega_1)
        omega_1 = omega;
  time_ = 1. / omega_1;
}

void PropagationContext::begin(const Eigen::VectorXd &x, const Eigen::VectorXd &u)
{
  x_begin_ = x;
  u_begin  = u;
  farthest = loads_way = 0.;
  scale.setZero();
  force.setZero();
}

double PropagationContext::way(const Eigen::VectorXd &x) const
{
  const auto   moved = (x - x_begin_).array().square();
  const double q = (mass_of_q_.array() * moved).sum(), v = (mass_of_v_.array() * moved).sum();
  return std::sqrt(v > 0. ? std::min(q, v * time_ * time_) : q);
}

void PropagationContext::free_rates(const double *x, double *rate) const
{
  for (int b = 0; b < measures.n_p; ++b)
  {
    const ModalBlock &block = measures.blocks[b];
    const double      x_1 = x[b], x_2 = x[measures.n_p + b];
    double           &y_1 = rate[b], &y_2 = rate[measures.n_p + b];
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
}

void PropagationContext::accelerate(const Eigen::VectorXd &x, LocalState &local)
{
  free_rates(x.data(), rate_.data());
  rate_ += measures.constant;
  local.a.noalias() = measures.read_v.transpose() * rate_;
  const auto &held  = system->forces().held();
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

void PropagationContext::accelerate_tangents(const Eigen::MatrixXd &X, double t, LocalTangents &local)
{
  local.a.resize(mobility.rows(), X.cols());
  for (Eigen::Index k = 0; k < X.cols(); ++k)
  {
    free_rates(X.col(k).data(), rate_.data());
    local.a.col(k).noalias() = measures.read_v.transpose() * rate_;
  }
  const auto &held = system->forces().held();
  for (const HeldMeasure &h : held)
    local.p.row(h.measure).setZero();
  local.a.noalias() += mobility * local.p;
  if (held.empty())
    return;
  factorise_delassus(t);
  for (Eigen::Index k = 0; k < X.cols(); ++k)
  {
    for (std::size_t i = 0; i < held.size(); ++i)
      rest_[Eigen::Index(i)] = -local.a(held[i].measure, k);
    delassus_.solve_in_place(rest_);
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      local.p(held[i].measure, k) = rest_[Eigen::Index(i)];
      local.a.col(k) += rest_[Eigen::Index(i)] * mobility.col(held[i].measure);
    }
  }
}

void PropagationContext::project_held_tangents(double t, Eigen::MatrixXd &X)
{
  const auto &held = system->forces().held();
  if (held.empty())
    return;
  factorise_delassus(t);
  for (Eigen::Index k = 0; k < X.cols(); ++k)
  {
    for (std::size_t i = 0; i < held.size(); ++i)
      rest_[Eigen::Index(i)] = -measures.read_v.col(held[i].measure).dot(X.col(k));
    delassus_.solve_in_place(rest_);
    for (std::size_t i = 0; i < held.size(); ++i)
      X.col(k) += rest_[Eigen::Index(i)] * measures.put.col(held[i].measure);
  }
}

/// Factorises W_h^T M^-1 W_h of the sticking measures.
void PropagationContext::factorise_delassus(double t)
{
  const auto &held = system->forces().held();
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

void PropagationContext::mobile_parts(double t, Eigen::VectorXd &part)
{
  constexpr double rounding = 1e-12; // of the difference of two mobilities
  const auto      &held     = system->forces().held();
  part.setOnes(mobility.rows());
  if (held.empty())
    return;
  factorise_delassus(t);
  for (Eigen::Index r = 0; r < part.size(); ++r)
  {
    if (!(mobility(r, r) > 0.))
      continue;
    for (std::size_t i = 0; i < held.size(); ++i)
      rest_[Eigen::Index(i)] = mobility(held[i].measure, r);
    delassus_.solve_in_place(rest_);
    for (std::size_t i = 0; i < held.size(); ++i)
      part[r] -= rest_[Eigen::Index(i)] * mobility(held[i].measure, r) / mobility(r, r);
    if (part[r] < rounding)
      part[r] = 0.;
  }
}

void PropagationContext::project_held(Eigen::VectorXd &x, LocalState &local)
{
  const auto &held = system->forces().held();
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

void PropagationContext::grow_scale(Eigen::VectorXd &grown, const Eigen::Ref<const Eigen::VectorXd> &u,
                                    const Eigen::Ref<const Eigen::VectorXd> &v, double h) const
{
  constexpr double rounding = 8. * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < u.size(); ++i)
    // A rotation has no largest excursion: what counts is the way gone in the time of the slowest mode.
    grown[i] = std::max({grown[i], std::min(std::abs(u[i] - u_begin[i]), time_ * std::abs(v[i])),
                         std::min(h, time_) * std::abs(v[i]), rounding / newton.tolerance * std::abs(u[i])});
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
  // of a step: a sine with 8 periods in it loses 1 - cos(2 pi 8 / 400), 0.8 %, of its largest value
  constexpr int samples = 200;
  for (int k = 0; k < samples; ++k)
  {
    double product = 1., slope = 0., factorial = 1.;
    for (std::size_t i = 0; i < sigma_.size(); ++i)
    {
      const double d = (k + 0.5) / samples - sigma_[i];
      slope          = slope * d + product;
      product *= d;
      factorial *= double(2 * i + 1) * double(2 * i + 2);
    }
    error_ = std::max(error_, 2. * std::abs(product * slope) / factorial);
  }
}

double HermiteNodes::error(double phase) const
{
  return error_ * std::pow(phase, 2 * size() - 1);
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

void PropagationContext::exchange(StateArchive &archive)
{
  archive(u_begin, scale, force, farthest, loads_way, x_begin_, work);
}

void exchange_table(StateArchive &archive, const std::vector<const StepTable *> &tables, const StepTable *&table)
{
  std::size_t place = std::size_t(std::find(tables.begin(), tables.end(), table) - tables.begin());
  archive(place);
  table = place < tables.size() ? tables[place] : nullptr;
}

} // namespace gestell::coupling
