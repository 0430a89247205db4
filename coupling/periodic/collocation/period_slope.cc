#include "coupling/periodic/collocation/collocation.h"

/// How the motion of given forces changes with its period.

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;
} // namespace

/// x' = Lambda x + put p + constant
VectorXd PeriodicCollocation::rate(const VectorXd &x, const VectorXd &p) const
{
  VectorXd f = measures_.put * p + measures_.constant;
  for (Index b = 0; b < Index(measures_.blocks.size()); ++b)
  {
    const ModalBlock &block = measures_.blocks[std::size_t(b)];
    const double      x_1 = x[b], x_2 = x[measures_.n_p + b];
    switch (block.kind)
    {
    case ModalBlock::oscillating:
      f[b] += block.s * x_1 - block.w * x_2;
      f[measures_.n_p + b] += block.w * x_1 + block.s * x_2;
      break;
    case ModalBlock::decaying:
      f[b] += block.s * x_1;
      f[measures_.n_p + b] += block.w * x_2;
      break;
    case ModalBlock::free:
      f[b] += x_2;
    }
  }
  return f;
}

/// -theta/T P_theta at the Gauss points of an interval, which determine it: its degree is that of P.
VectorXd PeriodicCollocation::slopes_of_forces(const VectorXd &y, int interval) const
{
  const Index  width = Index(stages) * n_u_;
  const double from = mesh_[std::size_t(interval)], w = mesh_[std::size_t(interval) + 1] - from;
  VectorXd     slopes = VectorXd::Zero(width);
  for (int j = 0; j < stages; ++j)
  {
    const double sigma = basis_.points[std::size_t(j)], factor = -(from + w * sigma) / (w * period_);
    for (int k = 0; k < stages; ++k)
    {
      double slope = 0.; // of l_k at sigma, by Horner
      for (Index d = basis_.l.cols() - 1; d > 0; --d)
        slope = slope * sigma + double(d) * basis_.l(k, d);
      slopes.segment(j * n_u_, n_u_) += factor * slope * y.segment(interval * width + k * n_u_, n_u_);
    }
  }
  return slopes;
}

VectorXd PeriodicCollocation::begin_of(const VectorXd &y) const
{
  const Index m = start_.cols() - 1;
  return start_.leftCols(m) * y.head(m) + start_.col(m);
}

/// dx/dT at the end of the period from eta at its begin; the measures on the way where `slope` is given.
VectorXd PeriodicCollocation::carry_slope(const VectorXd &y, VectorXd eta, PeriodSlope *slope) const
{
  const Index width = Index(stages) * n_u_;
  VectorXd    x = begin_of(y), eta_end(x.size()), x_end(x.size()), p_end = VectorXd::Zero(n_u_);
  for (int i = 0; i < n_intervals(); ++i)
  {
    const StepTable &table = tables_[std::size_t(i)];
    const VectorXd   P_i   = y.segment(i * width, width);
    const VectorXd   pi    = slopes_of_forces(y, i);
    eta -= mesh_[std::size_t(i)] * measures_.put * (force_at(P_i, 0.) - p_end);
    if (slope)
      read_slope(i, P_i, pi, x, eta, *slope);
    table.carry(eta, eta_end);
    table.carry(x, x_end);
    eta   = eta_end + table.in * pi;
    x     = x_end + table.in * P_i + table.constant;
    p_end = force_at(P_i, 1.);
  }
  return eta + rate(x, p_end);
}

/// Measures of dx/dT = eta + theta x' at the Gauss points of an interval.
void PeriodicCollocation::read_slope(int interval, const VectorXd &P_i, const VectorXd &pi, const VectorXd &x,
                                     const VectorXd &eta, PeriodSlope &slope) const
{
  const Index      width = Index(stages) * n_u_;
  const StepTable &table = tables_[std::size_t(interval)];
  const double     from = mesh_[std::size_t(interval)], w = mesh_[std::size_t(interval) + 1] - from;
  const VectorXd   rows    = table.rows.leftCols(2 * width).transpose() * eta;
  const VectorXd   by_pi_u = table.S_u.topRows(width) * pi, by_pi_v = table.S_v.topRows(width) * pi;
  for (int j = 0; j < stages; ++j)
  {
    const Index  at = interval * width + j * n_u_, here = j * n_u_;
    const double sigma = basis_.points[std::size_t(j)], theta = from + w * sigma;
    VectorXd     x_at = x;
    carry_inside(measures_, basis_, sigma * table.h, table.h, P_i, x_at);
    const VectorXd f = rate(x_at, P_i.segment(here, n_u_));
    slope.u.segment(at, n_u_) =
        rows.segment(2 * here, n_u_) + by_pi_u.segment(here, n_u_) + theta * (measures_.read_u.transpose() * f);
    slope.v.segment(at, n_u_) =
        rows.segment(2 * here + n_u_, n_u_) + by_pi_v.segment(here, n_u_) + theta * (measures_.read_v.transpose() * f);
  }
}

/// The polynomial of an interval's forces at a share of it.
VectorXd PeriodicCollocation::force_at(const VectorXd &P_i, double sigma) const
{
  VectorXd p = VectorXd::Zero(n_u_);
  for (int j = 0; j < stages; ++j)
    p += basis_.value(j, sigma) * P_i.segment(j * n_u_, n_u_);
  return p;
}

/// Free states stay as they are while T changes, all others close.
PeriodicCollocation::PeriodSlope PeriodicCollocation::period_slope(const VectorXd &y) const
{
  PeriodSlope    slope;
  const VectorXd end = carry_slope(y, VectorXd::Zero(2 * measures_.n_p), nullptr);
  slope.start        = VectorXd::Zero(end.size());
  slope.closing.resize(Index(free_.size()));
  Index unknown = 0;
  for (Index b = 0; b < modes_.n_modal; ++b)
    if (is_free(b, unknown))
    {
      slope.closing[unknown]     = -scale_[unknown] * end[b];
      slope.closing[unknown + 1] = -scale_[unknown + 1] * end[measures_.n_p + b];
      unknown += 2;
    }
    else
    {
      const Eigen::Vector2d begin    = closed(b, end[b], end[measures_.n_p + b]);
      slope.start[b]                 = begin[0];
      slope.start[measures_.n_p + b] = begin[1];
    }
  if (problem_.has_free_shifts())
    slope.closing =
        scale_.cwiseProduct(slope.closing.cwiseQuotient(scale_) -
                                        shifts_ * (shifts_.transpose() * slope.closing.cwiseQuotient(scale_)));
  slope.u.resize(u_0_.size());
  slope.v.resize(u_0_.size());
  carry_slope(y, slope.start, &slope);
  return slope;
}

} // namespace gestell::coupling
