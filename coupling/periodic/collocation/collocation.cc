#include "coupling/periodic/collocation/collocation.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/integration/system/turning_forces.h"
#include "coupling/periodic/newton.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Makes an equation with these coefficients of forces as large as one.
double scale_of(const Eigen::RowVectorXd &forces)
{
  const double largest = forces.size() > 0 ? forces.cwiseAbs().maxCoeff() : 0.;
  return largest > 0. ? 1. / largest : 1.;
}

/// E X by blocks, for all columns.
void carry_columns(const StepTable &table, MatrixXd &X)
{
  const Index    n_p = table.E.rows();
  Eigen::ArrayXd first(n_p);
  for (Index k = 0; k < X.cols(); ++k)
  {
    auto x_1 = X.col(k).head(n_p).array(), x_2 = X.col(k).tail(n_p).array();
    first = table.E.col(0).array() * x_1 + table.E.col(1).array() * x_2;
    x_2   = table.E.col(2).array() * x_1 + table.E.col(3).array() * x_2;
    x_1   = first;
  }
}
} // namespace

PeriodicCollocation::PeriodicCollocation(const PeriodicProblem &problem, SharedModes *shared,
                                         const std::vector<Index> *free, bool period_changes)
    : problem_(problem), modes_(modal_blocks(*problem.system, shared)), measures_(modes_, *problem.system),
      basis_(ForceBasis::gauss(stages)), n_u_(int(measures_.put.cols())), period_(problem.period),
      period_changes_(period_changes || problem.period_is_unknown())
{
  node_.resize(*problem.system);
  whole_.fill(measures_, basis_, period_);
  if (free)
    free_ = *free;
  for (Index b = 0; b < modes_.n_modal && !free; ++b)
    if (may_repeat_by_itself(b))
      for (const Index row : {b, measures_.n_p + b})
        free_.push_back(row);
  if (problem_.has_free_shifts())
    find_shifts();
}

/// Whether a block repeats after the period; where that changes, whether it would after one near it.
bool PeriodicCollocation::may_repeat_by_itself(Index b) const
{
  constexpr double repeats_by_itself = 1e-10; // det(E - e^(Lambda T)) of a block
  if (!period_changes_)
    return !(std::abs(closing_determinant(b)) > repeats_by_itself);
  const auto       e     = whole_.E.row(b);
  constexpr double keeps = 0.3; // of itself, a block that repeats after a period that is still unknown
  return modes_.blocks[std::size_t(b)].kind == ModalBlock::oscillating
             ? std::sqrt(std::abs(e[0] * e[3] - e[1] * e[2])) > keeps
             : std::max(std::abs(e[0]), std::abs(e[3])) > keeps;
}

/// det(E - e^(Lambda T)) of a block.
double PeriodicCollocation::closing_determinant(Index b) const
{
  return (1. - whole_.E(b, 0)) * (1. - whole_.E(b, 3)) - whole_.E(b, 1) * whole_.E(b, 2);
}

void PeriodicCollocation::set_mesh(const std::vector<double> &mesh)
{
  mesh_ = mesh;
  tables_.assign(mesh.size() - 1, {});
  scale_       = VectorXd::Zero(Index(free_.size()));
  phase_scale_ = 0.;
  condense();
}

void PeriodicCollocation::use_period(double period)
{
  if (period == period_)
    return;
  period_ = period;
  whole_.fill(measures_, basis_, period_);
  condense();
}

/// All affine functions of the forces, on the mesh and with the period as they are.
void PeriodicCollocation::condense()
{
  for (std::size_t i = 0; i < tables_.size(); ++i)
    tables_[i].fill(measures_, basis_, (mesh_[i + 1] - mesh_[i]) * period_);
  const Index N = n_intervals(), width = Index(stages) * n_u_, n = N * width, constant = n + Index(free_.size());
  MatrixXd    X = MatrixXd::Zero(2 * measures_.n_p, constant + 1);
  for (std::size_t j = 0; j < modes_.harmonics.size(); ++j) // the load's own states
  {
    X(modes_.n_modal + Index(j), constant)                 = std::cos(modes_.harmonics[j] * problem_.begin);
    X(measures_.n_p + modes_.n_modal + Index(j), constant) = std::sin(modes_.harmonics[j] * problem_.begin);
  }
  const MatrixXd load = X;
  for (Index i = 0; i < N; ++i)
  {
    carry_columns(tables_[i], X);
    X.middleCols(i * width, width) += tables_[i].in;
    X.col(constant) += tables_[i].constant;
  }
  close(X);
  start_ = load;
  for (Index b = 0; b < modes_.n_modal; ++b)
    for (const Index row : {b, measures_.n_p + b})
      start_.row(row) = X.row(row);
  read_measures();
  if (problem_.period_is_unknown())
    read_phase();
}

/// The equation of the phase, of the size of a force where it has forces.
void PeriodicCollocation::read_phase()
{
  phase_of_x_ = reordered(modes_.Q, measures_.n_p).row(problem_.phase);
  phase_      = phase_of_x_ * start_;
  phase_.tail(1)[0] -= problem_.phase_value;
  if (!(phase_scale_ > 0.))
    phase_scale_ = scale_of(phase_.head(u_0_.size()));
  phase_ *= phase_scale_;
  phase_of_x_ *= phase_scale_;
}

/// G_u, G_v, u_0, v_0 along the motion from start_.
void PeriodicCollocation::read_measures()
{
  const Index N = n_intervals(), width = Index(stages) * n_u_, n = N * width, constant = start_.cols() - 1;
  G_u_.resize(n, constant);
  G_v_.resize(n, constant);
  u_0_.resize(n);
  v_0_.resize(n);
  MatrixXd X = start_;
  for (Index i = 0; i < N; ++i)
  {
    const StepTable &table = tables_[std::size_t(i)];
    const MatrixXd   rows  = table.rows.leftCols(2 * width).transpose() * X;
    for (int j = 0; j < stages; ++j)
    {
      const Index at = i * width + j * n_u_, u = 2 * j * n_u_, v = u + n_u_;
      G_u_.middleRows(at, n_u_) = rows.block(u, 0, n_u_, constant);
      G_v_.middleRows(at, n_u_) = rows.block(v, 0, n_u_, constant);
      u_0_.segment(at, n_u_)    = rows.block(u, constant, n_u_, 1) + table.row_constant.segment(u, n_u_);
      v_0_.segment(at, n_u_)    = rows.block(v, constant, n_u_, 1) + table.row_constant.segment(v, n_u_);
    }
    G_u_.block(i * width, i * width, width, width) += table.S_u.topRows(width);
    G_v_.block(i * width, i * width, width, width) += table.S_v.topRows(width);
    carry_columns(table, X);
    X.middleCols(i * width, width) += table.in;
    X.col(constant) += table.constant;
  }
}

/// From what forces and loads leave of a start at zero, X, to the start that closes.  Free states become unknowns, with
/// the equations (E - e^(Lambda T)) x - X = 0, each of the size of a force.
void PeriodicCollocation::close(MatrixXd &X)
{
  const Index    n_p = measures_.n_p, constant = X.cols() - 1, n = constant - Index(free_.size());
  const VectorXd turn = modes_.from_q * problem_.turn;
  closing_.setZero(Index(free_.size()), X.cols());
  Index unknown = 0;
  for (Index b = 0; b < modes_.n_modal; ++b)
  {
    X(b, constant) -= turn[2 * b];
    X(n_p + b, constant) -= turn[2 * b + 1];
    if (is_free(b, unknown))
    {
      closing_.row(unknown)     = -X.row(b);
      closing_.row(unknown + 1) = -X.row(n_p + b);
      closing_.block<2, 2>(unknown, n + unknown) << 1. - whole_.E(b, 0), -whole_.E(b, 1), -whole_.E(b, 2),
          1. - whole_.E(b, 3);
      X.row(b)       = Eigen::RowVectorXd::Unit(X.cols(), n + unknown);
      X.row(n_p + b) = Eigen::RowVectorXd::Unit(X.cols(), n + unknown + 1);
      unknown += 2;
      continue;
    }
    for (Index k = 0; k < X.cols(); ++k)
    {
      const Eigen::Vector2d x = closed(b, X(b, k), X(n_p + b, k));
      X(b, k)                 = x[0];
      X(n_p + b, k)           = x[1];
    }
  }
  for (Index row = 0; row < unknown; ++row)
    if (!(scale_[row] > 0.))
      scale_[row] = scale_of(closing_.row(row).head(n));
  if (problem_.has_free_shifts())
    closing_ -= MatrixXd(shifts_ * (shifts_.transpose() * closing_));
  closing_.array().colwise() *= scale_.array();
}

/// The free shifts of the problem in the free states, which have them all, orthonormal.
void PeriodicCollocation::find_shifts()
{
  const MatrixXd in_modes = modes_.from_q * problem_.free;
  shifts_.resize(Index(free_.size()), in_modes.cols());
  for (Index k = 0; k < shifts_.rows(); ++k)
  {
    const Index state = free_[std::size_t(k)];
    shifts_.row(k)    = in_modes.row(state < measures_.n_p ? 2 * state : 2 * (state - measures_.n_p) + 1);
  }
  shifts_ = orthonormal_columns(shifts_, shifts_.cols());
}

/// (E - e^(Lambda T))^-1 (x_1, x_2) of a block.
Eigen::Vector2d PeriodicCollocation::closed(Index b, double x_1, double x_2) const
{
  const double a = 1. - whole_.E(b, 0), c = -whole_.E(b, 1), d = -whole_.E(b, 2), e = 1. - whole_.E(b, 3);
  return Eigen::Vector2d(e * x_1 - c * x_2, a * x_2 - d * x_1) / closing_determinant(b);
}

/// r = p(t, u, u') - P and J = E - p_u G_u - p_v G_v; behind them what is left of closing the free states and of the
/// phase.
void PeriodicCollocation::evaluate(const VectorXd &y, VectorXd &r, MatrixXd *J)
{
  problem_.system->events().follow_history(false);
  if (problem_.period_is_unknown())
    use_period(y.tail(1)[0]);
  const Index n = u_0_.size(), m = G_u_.cols(), n_free = closing_.rows();
  r.resize(y.size());
  r.segment(n, n_free) = -(closing_.leftCols(m) * y.head(m) + closing_.col(m));
  if (problem_.period_is_unknown())
    r.tail(1)[0] = -(phase_.head(m).dot(y.head(m)) + phase_[m]);
  if (J)
  {
    *J                                   = MatrixXd::Identity(y.size(), y.size());
    J->middleRows(n, n_free).leftCols(m) = closing_.leftCols(m);
    if (problem_.has_free_shifts()) // along them the start stays where it is
      J->block(n, n, n_free, n_free) += shifts_ * shifts_.transpose();
    if (problem_.period_is_unknown())
    {
      J->row(m).head(m) = phase_.head(m);
      J->col(m).setZero();
    }
  }
  add_forces(y, r, J);
}

/// The rows of the forces.
void PeriodicCollocation::add_forces(const VectorXd &y, VectorXd &r, MatrixXd *J)
{
  const LocalForces &forces = problem_.system->forces();
  const Index        m      = G_u_.cols();
  const VectorXd     u = u_0_ + G_u_ * y.head(m), v = v_0_ + G_v_ * y.head(m);
  MatrixXd           p_u = MatrixXd::Zero(n_u_, n_u_), p_v = p_u;
  PeriodSlope        slope;
  if (J && problem_.period_is_unknown())
  {
    slope                                     = period_slope(y);
    J->col(m).segment(u.size(), free_.size()) = slope.closing;
    J->col(m).tail(1)                         = phase_of_x_ * slope.start;
  }
  for (Index i = 0; i < n_intervals(); ++i)
    for (int j = 0; j < stages; ++j)
    {
      const Index  at   = (i * stages + j) * n_u_;
      const double from = mesh_[std::size_t(i)], to = mesh_[std::size_t(i) + 1];
      node_.t = problem_.begin + period_ * (from + basis_.points[std::size_t(j)] * (to - from));
      node_.u = u.segment(at, n_u_);
      node_.v = v.segment(at, n_u_);
      if (J)
      {
        coupling::linearise(forces, node_, node_.p, p_u, p_v);
        J->middleRows(at, n_u_).leftCols(m).noalias() -= p_u * G_u_.middleRows(at, n_u_);
        J->middleRows(at, n_u_).leftCols(m).noalias() -= p_v * G_v_.middleRows(at, n_u_);
        if (slope.u.size() > 0)
          J->col(m).segment(at, n_u_) -= p_u * slope.u.segment(at, n_u_) + p_v * slope.v.segment(at, n_u_);
      }
      else
        forces.force(node_, node_.p);
      r.segment(at, n_u_) = node_.p - y.segment(at, n_u_);
    }
}

int PeriodicCollocation::solve(VectorXd &P, const PeriodicOptions &options)
{
  VectorXd   r;
  MatrixXd   J;
  const auto step = [&](NewtonResult &newton) -> NewtonStep
  {
    if (problem_.interrupted())
      throw SearchInterrupted();
    evaluate(P, r, &J);
    const VectorXd dP = lu_solution(J, r);
    if (!dP.allFinite())
      throw NoPeriodicMotion("collocation: the motion is undetermined: no element acts at the points of the mesh; "
                             "start closer to the solution (--lead-in), or use shooting");
    const Index n    = u_0_.size(); // forces; free states and the period follow them
    newton.converged = (dP.head(n).norm() <= options.tolerance * P.head(n).norm() || P.head(n).isZero(0.)) &&
                       (!problem_.period_is_unknown() || std::abs(dP.tail(1)[0]) <= options.tolerance * P.tail(1)[0]);
    if (newton.converged)
    {
      P += dP;
      ++newton.iterations;
      return {};
    }
    constexpr double longest_change = 0.5; // of T in a Newton step: T stays above zero
    const double     share =
        problem_.period_is_unknown() ? std::min(1., longest_change * period_ / std::abs(dP.tail(1)[0])) : 1.;
    return {dP, r.norm(), 0.1, share, 1e-4 / share};
  };
  const auto length = [&](const VectorXd &next)
  {
    evaluate(next, r, nullptr);
    return r.norm();
  };
  const NewtonResult newton = solve_by_newton(P, options.iterations, step, length);
  if (newton.converged)
    return newton.iterations;
  throw NoPeriodicMotion(
      "collocation: Newton's method does not converge; start closer to the solution (--lead-in), or use shooting");
}

VectorXd PeriodicCollocation::carried_over(const std::vector<double> &mesh, const VectorXd &P) const
{
  VectorXd    other = VectorXd::Zero(n_unknowns());
  const Index after = n_unknowns() - u_0_.size(); // free states and the period
  other.tail(after) = P.tail(after);
  for (Index i = 0; i < n_intervals(); ++i)
    for (int j = 0; j < stages; ++j)
    {
      const double s    = mesh_[i] + basis_.points[j] * (mesh_[i + 1] - mesh_[i]);
      const auto   k    = std::clamp<Index>(std::upper_bound(mesh.begin(), mesh.end(), s) - mesh.begin() - 1, 0,
                                       Index(mesh.size()) - 2);
      const double part = (s - mesh[k]) / (mesh[k + 1] - mesh[k]);
      for (int m = 0; m < stages; ++m)
        other.segment((i * stages + j) * n_u_, n_u_) +=
            basis_.value(m, part) * P.segment((k * stages + m) * n_u_, n_u_);
    }
  return other;
}

VectorXd PeriodicCollocation::weights() const
{
  VectorXd weights = VectorXd::Ones(n_unknowns());
  for (Index i = 0; i < n_intervals(); ++i)
    weights.segment(i * stages * n_u_, stages * n_u_)
        .setConstant(std::sqrt((mesh_[std::size_t(i) + 1] - mesh_[std::size_t(i)]) / stages));
  return weights;
}

VectorXd PeriodicCollocation::unknowns(const VectorXd &forces, const VectorXd &q, const VectorXd &v,
                                       double period) const
{
  const VectorXd x = modes_.state(problem_.begin, q, v);
  VectorXd       y(n_unknowns());
  y.head(forces.size()) = forces;
  for (std::size_t k = 0; k < free_.size(); ++k)
    y[forces.size() + Index(k)] = free_[k] < measures_.n_p ? x[2 * free_[k]] : x[2 * (free_[k] - measures_.n_p) + 1];
  if (problem_.period_is_unknown())
    y.tail(1)[0] = period;
  return y;
}

VectorXd PeriodicCollocation::errors(const VectorXd &P)
{
  if (n_u_ == 0) // the base system alone, which steps carry exactly
    return VectorXd::Zero(n_intervals());
  problem_.system->events().follow_history(false);
  const LocalForces &forces = problem_.system->forces();
  const Index        width  = Index(stages) * n_u_;
  const VectorXd     u      = u_0_ + G_u_ * P.head(G_u_.cols());
  VectorXd           low = VectorXd::Constant(n_u_, 1e300), high = -low, errors = VectorXd::Zero(n_intervals());
  for (Index at = 0; at < u.size(); at += n_u_)
  {
    low  = low.cwiseMin(u.segment(at, n_u_));
    high = high.cwiseMax(u.segment(at, n_u_));
  }
  const VectorXd size = (high - low).cwiseMax(1e-300);
  VectorXd       x    = begin_of(P), x_at(x.size());
  for (Index i = 0; i < n_intervals(); ++i)
  {
    const StepTable &table = tables_[std::size_t(i)];
    const VectorXd   P_i   = P.segment(i * width, width);
    // of an interval, where defects are looked at: its ends, and between its four points
    constexpr double watched[] = {0., 0.2, 0.5, 0.8, 1.};
    for (const double part : watched)
    {
      if (part == 1.)
      {
        table.carry(x, x_at);
        x_at += table.constant + table.in * P_i;
      }
      else
      {
        x_at = x;
        carry_inside(measures_, basis_, part * table.h, table.h, P_i, x_at);
      }
      node_.t = problem_.begin + period_ * mesh_[std::size_t(i)] + part * table.h;
      node_.u = measures_.read_u.transpose() * x_at;
      node_.v = measures_.read_v.transpose() * x_at;
      forces.force(node_, node_.p);
      const VectorXd defect = node_.p - force_at(P_i, part);
      // The defect over the whole interval moves the measures there, and by its impulse in the rest of the period.
      for (int j = 0; j < stages; ++j)
      {
        const auto       moves  = table.S_u.block(stages * n_u_, j * n_u_, n_u_, n_u_);
        const auto       pushes = table.S_v.block(stages * n_u_, j * n_u_, n_u_, n_u_);
        const VectorXd   way    = (moves * defect).cwiseAbs() + period_ / (2. * M_PI) * (pushes * defect).cwiseAbs();
        constexpr double share_of_point = 0.1; // of an interval that the defect at one of them stands for
        errors[i]                       = std::max(errors[i], share_of_point * way.cwiseQuotient(size).maxCoeff());
      }
    }
    x = x_at;
  }
  return errors;
}

void PeriodicCollocation::state_at_begin(const VectorXd &P, VectorXd &q, VectorXd &v) const
{
  const VectorXd x = begin_of(P);
  q                = reordered(modes_.Q, measures_.n_p) * x;
  v                = reordered(modes_.V, measures_.n_p) * x;
}

} // namespace gestell::coupling
