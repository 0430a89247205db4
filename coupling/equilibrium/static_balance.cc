#include "coupling/equilibrium/static_balance.h"

#include "coupling/machine/configuration/dense_matrices.h"

#include <Eigen/QR>

namespace gestell::coupling
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

StaticBalance::StaticBalance(Machine &machine, const InitialState &from, const KnownStart *held,
                             const SteadyMotion *motion)
    : machine_(machine), held_(held), moves_(motion), n_(machine.size()), n_c_(machine.joints().n_rows()), t_(from.t),
      zero_(VectorXd::Zero(n_)), v_(motion ? motion->v : zero_), a_(motion ? motion->a : zero_),
      G_(machine.joints().blocks()), C_(dense_stiffness(machine)), load_(n_)
{
  local_.resize(machine);
  machine.gather(t_, from.q, v_, a_, local_);
  machine.events().start(local_);
  acts_ = acting_measures(machine, local_.u, held && !motion ? Acting::structure : Acting::everything);
  if (held)
    load_ = machine.linear().excitation().constant();
  else
    machine.linear().excitation().at(t_, load_);
  for (int i = machine.model().n_frame(); held && i < n_; ++i)
    if (held->q_given[i])
      given_.push_back(i);
  n_g_ = held ? int(given_.size() + held->measures.size() + held->spins.size()) : 0;
  if (!motion)
    return;
  const MatrixXd M = dense_mass(machine);
  load_ -= M * a_ + dense_damping(machine) * v_;
  S_  = motion->S;
  MS_ = M * S_;
}

VectorXd StaticBalance::multipliers(const VectorXd &q, double share)
{
  const VectorXd none = VectorXd::Zero(n_rows());
  if (none.size() == 0)
    return none;
  MatrixXd saddle;
  VectorXd residual;
  evaluate(q, none, share, saddle, residual);
  return saddle.topRightCorner(n_, n_rows()).colPivHouseholderQr().solve(-residual.head(n_));
}

void StaticBalance::evaluate(const VectorXd &q, const VectorXd &lambda, double share, MatrixXd &saddle,
                             VectorXd &residual)
{
  const auto &W = machine_.forces().directions();
  machine_.gather(t_, q, v_, moves_ ? VectorXd(a_ + S_ * lambda.tail(n_g_)) : a_, local_);
  local_.lambda = lambda.head(n_c_);
  VectorXd g(n_c_);
  machine_.joints().constraints(local_, g, G_);
  MatrixXd dp = MatrixXd::Zero(W.cols(), W.cols()), geometric;
  machine_.forces().tangent(local_, 1., 0., 0., local_.p, dp);
  for (const HeldMeasure &sticking : machine_.forces().held())
  {
    local_.p[sticking.measure] = 0.;
    dp.row(sticking.measure).setZero();
  }
  local_.p = acts_.cwiseProduct(local_.p);
  dp       = acts_.asDiagonal() * dp;
  G_.set_forces(local_.lambda, local_.p);
  machine_.geometric(local_, geometric);
  const int n_l = n_rows();
  MatrixXd  A(n_l, n_);
  VectorXd  open(n_l);
  A.topRows(n_c_) = joint_jacobian(machine_, G_);
  open.head(n_c_) = g;
  if (held_)
    hold(q, A, open);
  saddle.setZero(n_ + n_l, n_ + n_l);
  saddle.topLeftCorner(n_, n_)   = C_ + W * (acts_.asDiagonal() * geometric - dp) * W.transpose();
  saddle.topRightCorner(n_, n_l) = -A.transpose();
  if (moves_)
    saddle.topRightCorner(n_, n_g_) = MS_;
  saddle.bottomLeftCorner(n_l, n_) = A;
  const VectorXd elastic           = C_ * q;
  residual.resize(n_ + n_l);
  residual.head(n_)  = elastic - share * load_ - W * local_.p + saddle.topRightCorner(n_, n_g_) * lambda.tail(n_g_);
  residual.tail(n_l) = open;
  forces_            = elastic.cwiseAbs() + load_.cwiseAbs() + W.cwiseAbs() * local_.p.cwiseAbs();
  if (moves_)
    return;
  for (const int i : machine_.linear().virtual_coordinates()) // states of laws keep the value they start with
  {
    saddle.row(i).setZero();
    saddle(i, i) = 1.;
    residual[i]  = 0.;
  }
}

/// Adds the rows of the fixed coordinates after those of the joints.
void StaticBalance::hold(const VectorXd &q, MatrixXd &A, VectorXd &open)
{
  for (const auto &[row, shift] : held_->shifts)
    open[row] -= shift;
  int row = n_c_;
  for (const int i : given_)
  {
    A.row(row)  = VectorXd::Unit(n_, i).transpose();
    open[row++] = q[i] - held_->state.q[i];
  }
  VectorXd gradient;
  for (const auto &[name, value] : held_->measures)
  {
    open[row]    = machine_.model().measure(name).evaluate(q, zero_, &gradient).s - value;
    A.row(row++) = gradient.transpose();
  }
  for (const KnownSpin &spin : held_->spins)
  {
    gradient     = spin_gradient(machine_, spin, held_->state.q);
    open[row]    = gradient.dot(q - held_->state.q);
    A.row(row++) = gradient.transpose();
  }
}

MatrixXd StaticBalance::with_closed_chains(const VectorXd &q, MatrixXd saddle) const
{
  MatrixXd stiffness, damping;
  engaged_matrices(machine_, q, {}, stiffness, damping);
  saddle.topLeftCorner(n_, n_) = C_ + stiffness;
  return saddle;
}

namespace
{

/// Share of the frame in the kinetic energy of a motion.
double share_of_frame(const Machine &machine, const VectorXd &motion)
{
  const MatrixXd M     = dense_mass(machine);
  const int      n     = machine.model().n_frame();
  const double   whole = motion.dot(M * motion);
  return whole > 0. ? motion.head(n).dot(M.topLeftCorner(n, n) * motion.head(n)) / whole : 0.;
}

} // namespace

std::string mechanism_mode_text(const Machine &machine, const VectorXd &motion)
{
  const ReducedFrame *frame      = machine.model().reduced_frame();
  constexpr double    takes_part = 0.01; // share of the kinetic energy of a motion: others only follow through springs
  if (frame && !frame->facts.free_motions.empty() && share_of_frame(machine, motion) > takes_part)
  {
    std::string free;
    for (const std::string &name : frame->facts.free_motions)
      free += (free.empty() ? "" : ", ") + name;
    return "the frame moves as a rigid body under the loads (without elements it has " +
           std::to_string(frame->facts.free_motions.size()) + " rigid-body modes: " + free +
           "); give it a support ([frame.support.NAME]) or elements to the ground";
  }
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  return "the motion of " + machine.coordinate_name(int(most)) +
         " has neither stiffness nor weight to restore it here; add a spring, a joint or a support";
}

} // namespace gestell::coupling
