#include "coupling/periodic/collocation.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double watched[]         = {0., 0.2, 0.5, 0.8, 1.}; ///< of an interval, where defects are looked at
constexpr double share_of_point    = 0.1;   ///< of an interval that the defect at one of them stands for
constexpr double repeats_by_itself = 1e-10; ///< det(E - e^(Lambda T)) of a block

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

PeriodicCollocation::PeriodicCollocation(const PeriodicProblem &problem)
    : problem_(problem), modes_(modal_blocks(*problem.system)), measures_(modes_, *problem.system),
      basis_(ForceBasis::gauss(stages)), n_u_(int(measures_.put.cols()))
{
  node_.resize(*problem.system);
  whole_.fill(measures_, basis_, problem_.period);
  for (Index b = 0; b < modes_.n_modal; ++b)
    if (!(std::abs(closing_determinant(b)) > repeats_by_itself))
      for (const Index row : {b, measures_.n_p + b})
        free_.push_back(row);
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
  for (std::size_t i = 0; i + 1 < mesh.size(); ++i)
    tables_[i].fill(measures_, basis_, (mesh[i + 1] - mesh[i]) * problem_.period);
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
    const double             a = 1. - whole_.E(b, 0), c = -whole_.E(b, 1), d = -whole_.E(b, 2), e = 1. - whole_.E(b, 3);
    const double             det = closing_determinant(b);
    const Eigen::RowVectorXd x_1 = X.row(b), x_2 = X.row(n_p + b);
    if (std::abs(det) > repeats_by_itself)
    {
      X.row(b)       = (e * x_1 - c * x_2) / det;
      X.row(n_p + b) = (a * x_2 - d * x_1) / det;
      continue;
    }
    closing_.row(unknown)     = -x_1;
    closing_.row(unknown + 1) = -x_2;
    closing_.block<2, 2>(unknown, n + unknown) << a, c, d, e;
    for (const Index row : {unknown, unknown + 1})
      if (const double largest = closing_.row(row).head(n).cwiseAbs().maxCoeff(); largest > 0.)
        closing_.row(row) /= largest;
    X.row(b)       = Eigen::RowVectorXd::Unit(X.cols(), n + unknown);
    X.row(n_p + b) = Eigen::RowVectorXd::Unit(X.cols(), n + unknown + 1);
    unknown += 2;
  }
}

/// r = p(t, u, u') - P and J = E - p_u G_u - p_v G_v; behind them what is left of closing the free states.
void PeriodicCollocation::evaluate(const VectorXd &y, VectorXd &r, MatrixXd *J)
{
  const LocalForces &forces = problem_.system->forces();
  const VectorXd     u = u_0_ + G_u_ * y, v = v_0_ + G_v_ * y;
  MatrixXd           p_u = MatrixXd::Zero(n_u_, n_u_), p_v = p_u;
  r.resize(y.size());
  r.tail(closing_.rows()) = -(closing_.leftCols(y.size()) * y + closing_.col(y.size()));
  if (J)
  {
    *J                             = MatrixXd::Identity(y.size(), y.size());
    J->bottomRows(closing_.rows()) = closing_.leftCols(y.size());
  }
  for (Index i = 0; i < n_intervals(); ++i)
    for (int j = 0; j < stages; ++j)
    {
      const Index  at   = (i * stages + j) * n_u_;
      const double from = mesh_[std::size_t(i)], to = mesh_[std::size_t(i) + 1];
      node_.t = problem_.begin + problem_.period * (from + basis_.points[std::size_t(j)] * (to - from));
      node_.u = u.segment(at, n_u_);
      node_.v = v.segment(at, n_u_);
      if (J)
      {
        forces.derivatives(node_, node_.p, p_u, p_v);
        J->middleRows(at, n_u_).noalias() -= p_u * G_u_.middleRows(at, n_u_);
        J->middleRows(at, n_u_).noalias() -= p_v * G_v_.middleRows(at, n_u_);
      }
      else
        forces.force(node_, node_.p);
      r.segment(at, n_u_) = node_.p - y.segment(at, n_u_);
    }
}

int PeriodicCollocation::solve(VectorXd &P, const PeriodicOptions &options)
{
  constexpr double rounding = 1e-13;
  problem_.system->events().follow_history(false);
  VectorXd r, next_r;
  MatrixXd J;
  for (int k = 1; k <= options.iterations; ++k)
  {
    if (problem_.interrupted())
      throw SearchInterrupted();
    evaluate(P, r, &J);
    const VectorXd dP = lu_solution(J, r);
    if (!dP.allFinite())
      throw NoPeriodicMotion("collocation: nothing determines the motion: no element acts where the mesh looks; begin "
                             "nearer to the motion (--lead-in), or take shooting");
    double part = 1.;
    for (; part > 1e-4; part *= 0.5)
    {
      evaluate(P + part * dP, next_r, nullptr);
      if (next_r.norm() < (1. - 0.1 * part) * r.norm() || dP.norm() <= rounding * P.norm())
        break;
    }
    P += part * dP;
    const Index n = u_0_.size(); // forces; free states follow them
    if (part * dP.head(n).norm() <= options.tolerance * P.head(n).norm() || P.head(n).isZero(0.))
      return k;
  }
  std::ostringstream text;
  text << "collocation: Newton's method does not converge in " << options.iterations
       << " iterations; begin nearer to the motion (--lead-in), or take shooting";
  throw NoPeriodicMotion(text.str());
}

VectorXd PeriodicCollocation::carried_over(const std::vector<double> &mesh, const VectorXd &P) const
{
  VectorXd other                  = VectorXd::Zero(n_unknowns());
  other.tail(Index(free_.size())) = P.tail(Index(free_.size()));
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

VectorXd PeriodicCollocation::unknowns(const VectorXd &forces, const VectorXd &q, const VectorXd &v) const
{
  const VectorXd x = modes_.state(problem_.begin, q, v);
  VectorXd       y(n_unknowns());
  y.head(forces.size()) = forces;
  for (std::size_t k = 0; k < free_.size(); ++k)
    y[forces.size() + Index(k)] = free_[k] < measures_.n_p ? x[2 * free_[k]] : x[2 * (free_[k] - measures_.n_p) + 1];
  return y;
}

VectorXd PeriodicCollocation::errors(const VectorXd &P)
{
  const LocalForces &forces = problem_.system->forces();
  const Index        width  = Index(stages) * n_u_;
  const VectorXd     u      = u_0_ + G_u_ * P;
  VectorXd           low = VectorXd::Constant(n_u_, 1e300), high = -low, errors = VectorXd::Zero(n_intervals());
  for (Index at = 0; at < u.size(); at += n_u_)
  {
    low  = low.cwiseMin(u.segment(at, n_u_));
    high = high.cwiseMax(u.segment(at, n_u_));
  }
  const VectorXd size = (high - low).cwiseMax(1e-300);
  VectorXd       x    = start_.leftCols(P.size()) * P + start_.col(P.size()), x_at(x.size());
  for (Index i = 0; i < n_intervals(); ++i)
  {
    const StepTable &table = tables_[std::size_t(i)];
    const VectorXd   P_i   = P.segment(i * width, width);
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
      node_.t = problem_.begin + problem_.period * mesh_[std::size_t(i)] + part * table.h;
      node_.u = measures_.read_u.transpose() * x_at;
      node_.v = measures_.read_v.transpose() * x_at;
      forces.force(node_, node_.p);
      VectorXd defect = node_.p;
      for (int j = 0; j < stages; ++j)
        defect -= basis_.value(j, part) * P_i.segment(j * n_u_, n_u_);
      // The defect over the whole interval moves the measures there, and by its impulse in the rest of the period.
      for (int j = 0; j < stages; ++j)
      {
        const auto     moves  = table.S_u.block(stages * n_u_, j * n_u_, n_u_, n_u_);
        const auto     pushes = table.S_v.block(stages * n_u_, j * n_u_, n_u_, n_u_);
        const VectorXd way = (moves * defect).cwiseAbs() + problem_.period / (2. * M_PI) * (pushes * defect).cwiseAbs();
        errors[i]          = std::max(errors[i], share_of_point * way.cwiseQuotient(size).maxCoeff());
      }
    }
    x = x_at;
  }
  return errors;
}

void PeriodicCollocation::state_at_begin(const VectorXd &P, VectorXd &q, VectorXd &v) const
{
  const VectorXd x = start_.leftCols(P.size()) * P + start_.col(P.size());
  q                = reordered(modes_.Q, measures_.n_p) * x;
  v                = reordered(modes_.V, measures_.n_p) * x;
}

} // namespace gestell::coupling
