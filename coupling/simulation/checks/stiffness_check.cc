#include "coupling/simulation/checks/stiffness_check.h"
#include "coupling/integration/system/state_archive.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

double stored(const mechanism::Element &element, const Eigen::VectorXd &u, const Eigen::VectorXd &v)
{
  const Eigen::VectorXd        at_rest = Eigen::VectorXd::Zero(u.size());
  const mechanism::LocalMotion motion{0., u.data(), v.data(), at_rest.data()};
  return element.force_law()->stored_energy(motion, started(element, motion).data());
}

} // namespace

StiffnessCheck::StiffnessCheck(const Machine &machine, const TimeIntegrator &integrator, const InitialState &start,
                               const MethodOptions &options)
    : machine_(machine), integrator_(integrator), options_(options)
{
  const auto       weights         = method_of(options).step_weights(options, -1.);
  constexpr double weight_rounding = 1e-14; // of step weights, sums of a few terms of order one
  if (!weights || controlled(options) || is_large(machine) ||
      weights->stiffness > -weight_rounding) // stable at every stiffness
    return;
  const StepWeights w     = *weights;
  int               first = 0, row = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int k = placement.element->n_measures();
    if (stiffens(*placement.element))
    {
      watched_.push_back({&placement, first, k, row});
      row += k;
    }
    first += k;
  }
  if (watched_.empty())
    return;

  const double    h = options.step;
  Eigen::MatrixXd K, D, W = Eigen::MatrixXd::Zero(machine.size(), row);
  stiffest_matrices(machine, start.q, K, D);
  const Eigen::VectorXd u = machine.forces().directions().transpose() * start.q;
  for (const Watched &watched : watched_)
  {
    const Eigen::MatrixXd own               = machine.forces().directions().middleCols(watched.first, watched.size);
    W.middleCols(watched.row, watched.size) = own;
    K -= own * stiffness(watched, u) * own.transpose();
  }
  const Eigen::MatrixXd             M = dense_mass(machine);
  const Eigen::LLT<Eigen::MatrixXd> A(w.mass * M + (w.damping * h) * (dense_damping(machine) + D) +
                                      (w.stiffness * h * h) * (dense_stiffness(machine) + K));
  if (A.info() != Eigen::Success) // it grows without them: a run that is forced
  {
    watched_.clear();
    return;
  }
  F_         = (-w.stiffness * h * h) * (W.transpose() * A.solve(W));
  lightness_ = W.transpose() * M.llt().solve(W);
  last_.u    = u;
  last_.v    = machine.forces().directions().transpose() * start.v;
}

Eigen::MatrixXd StiffnessCheck::stiffness(const Watched &watched, const Eigen::VectorXd &u) const
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(watched.size, watched.size), D = K;
  stiffest(*watched.placement->element, u.data() + watched.first, K.data(), D.data());
  return K;
}

/// Largest eigenvalue of K F, or its trace where that is below 1; `most` is the element with most part in it.
double StiffnessCheck::largest(const Eigen::VectorXd &u, std::size_t &most) const
{
  double sum = 0., highest = 0.;
  for (std::size_t i = 0; i < watched_.size(); ++i)
  {
    const auto &[placement, first, k, row] = watched_[i];
    const double part                      = stiffness(watched_[i], u).cwiseProduct(F_.block(row, row, k, k)).sum();
    sum += part;
    if (part > highest)
    {
      highest = part;
      most    = i;
    }
  }
  if (sum < 1. || F_.rows() == 1)
    return sum;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(F_.rows(), F_.cols());
  for (const Watched &watched : watched_)
    K.block(watched.row, watched.row, watched.size, watched.size) = stiffness(watched, u);
  return GeneralEigenSolver(K * F_, WithVectors::no).eigenvalues().real().maxCoeff();
}

void StiffnessCheck::step()
{
  if (watched_.empty())
    return;
  const LocalState &state = integrator_.local();
  std::size_t       most  = 0;
  const double      share = largest(state.u, most);
  if (!(share < 1.))
    fail(state, share, watched_[most]);
  last_.u = state.u;
  last_.v = state.v;
}

/// Circular frequency [rad/s] of the masses of one element's measures on it where the motion of the step before will
/// have turned: all their kinetic energy is stored in it then.  Where that is not found, at `u`.
double StiffnessCheck::frequency_at_peak(const Watched &watched, const Eigen::VectorXd &now) const
{
  const auto &[placement, first, k, row] = watched;
  const Eigen::VectorXd u = last_.u.segment(first, k), v = last_.v.segment(first, k);
  const Eigen::MatrixXd lightness = lightness_.block(row, row, k, k);
  const double energy = stored(*placement->element, u, v) + 0.5 * v.dot(LeastSquaresSolver(lightness).solve(v));
  double       far    = options_.step;
  for (int i = 0; i < 60 && stored(*placement->element, u + far * v, v) < energy; ++i)
    far *= 2.;
  const bool found = stored(*placement->element, u + far * v, v) >= energy;
  double     near  = 0.;
  for (int i = 0; i < 50; ++i)
  {
    const double middle                                                    = 0.5 * (near + far);
    (stored(*placement->element, u + middle * v, v) < energy ? near : far) = middle;
  }
  Eigen::VectorXd peak = now;
  if (found)
    peak.segment(first, k) = u + far * v;
  return std::sqrt(stiffness(watched, peak).cwiseProduct(lightness).sum());
}

void StiffnessCheck::fail(const LocalState &state, double share, const Watched &watched) const
{
  // A motion that reaches the element inside a step continues without its force for v h at most, which creates energy
  // of the share (omega h)^2 for constant stiffness and less for a growing one: a third keeps it below 1/9.
  constexpr double   resolved = 1. / 3.;
  std::ostringstream text;
  text.precision(4);
  text << method_name(options_) << " is unstable with run.step = " << options_.step << " s from t = " << state.t
       << " s: element \"" << watched.placement->name << "\" has become " << share
       << " times too stiff for the step, and its motion grows; use run.step = "
       << std::min(options_.step, resolved / frequency_at_peak(watched, state.u))
       << " s or less, or run.method = \"bdf\" with run.order = 2, stable at any stiffness; run.force_unstable = true "
          "runs it anyway";
  throw ConvergenceFailure(text.str());
}

void StiffnessCheck::exchange(StateArchive &archive)
{
  archive(last_);
}

} // namespace gestell::coupling
