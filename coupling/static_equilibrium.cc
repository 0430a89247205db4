#include "coupling/static_equilibrium.h"

#include "coupling/dense_matrices.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr int    most_iterations = 50, most_parts = 64;
constexpr double converged = 1e-13; ///< correction, against the size of q
constexpr double singular  = 1e-14; ///< smallest pivot of the scaled saddle matrix
constexpr double balanced  = 1e-9;  ///< residual beside its forces that counts as none along a free motion

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Equilibrium
{
public:
  /// @param held  what is kept where it is, or null; see held_equilibrium()
  Equilibrium(Machine &machine, const InitialState &from, const KnownStart *held = nullptr)
      : machine_(machine), held_(held), n_(machine.size()), n_c_(machine.n_constraints()), t_(from.t), q_(from.q),
        zero_(VectorXd::Zero(n_)), G_(machine.constraint_blocks()), C_(dense_stiffness(machine)), load_(n_)
  {
    local_.resize(machine);
    machine.gather(t_, q_, zero_, zero_, local_);
    machine.start(local_);
    acts_ = acting_measures(machine, local_.u, held ? Acting::structure : Acting::everything);
    if (held)
      load_ = machine.excitation().constant();
    else
      machine.excitation().at(t_, load_);
    for (int i = machine.n_frame(); held && i < n_; ++i)
      if (held->q_given[i])
        given_.push_back(i);
    n_g_    = held ? int(given_.size() + held->measures.size()) : 0;
    lambda_ = VectorXd::Zero(n_c_ + n_g_);
  }

  const VectorXd &q() const { return q_; }
  VectorXd        multipliers() const { return lambda_.head(n_c_); }

  void solve()
  {
    const VectorXd begin = q_;
    guess_multipliers(1.);
    if (newton(1.))
      return;
    for (int parts = 4; parts <= most_parts; parts *= 4)
    {
      q_ = begin;
      guess_multipliers(1. / parts);
      bool found = true;
      for (int k = 1; found && k <= parts; ++k)
        found = newton(double(k) / parts);
      if (found)
        return;
    }
    std::ostringstream message;
    message << "no static equilibrium was found near the position of the start, even with the loads put on in "
            << most_parts << " parts; give a better position, or start with rule = \"given\"";
    throw std::invalid_argument(message.str());
  }

  /// K v - A^T lambda' = 0,  A v = -dg/dt  with A = G W^T.
  VectorXd drift()
  {
    MatrixXd saddle;
    VectorXd residual;
    evaluate(1., saddle, residual);
    VectorXd rate(n_c_), bias(n_c_), right = VectorXd::Zero(n_ + n_c_);
    machine_.constraint_rates(local_, rate, bias);
    right.tail(n_c_) = -rate;
    return solution(saddle, right).head(n_);
  }

private:
  /// The multipliers that come nearest to equilibrium where the machine stands: without them nothing holds a load on a
  /// rope, whose stiffness is its tension.
  void guess_multipliers(double share)
  {
    MatrixXd saddle;
    VectorXd residual;
    lambda_.setZero();
    evaluate(share, saddle, residual);
    if (lambda_.size() > 0)
      lambda_ = saddle.topRightCorner(n_, lambda_.size()).colPivHouseholderQr().solve(-residual.head(n_));
  }

  void evaluate(double share, MatrixXd &saddle, VectorXd &residual)
  {
    const auto &W = machine_.directions();
    machine_.gather(t_, q_, zero_, zero_, local_);
    local_.lambda = lambda_.head(n_c_);
    VectorXd g(n_c_);
    machine_.constraints(local_, g, G_);
    MatrixXd dp = MatrixXd::Zero(W.cols(), W.cols()), geometric;
    machine_.local_tangent(local_, 1., 0., 0., local_.p, dp);
    for (const HeldMeasure &held : machine_.held())
    {
      local_.p[held.measure] = 0.;
      dp.row(held.measure).setZero();
    }
    local_.p = acts_.cwiseProduct(local_.p);
    dp       = acts_.asDiagonal() * dp;
    G_.set_forces(local_.lambda, local_.p);
    machine_.geometric(local_, geometric);
    const int n_l = n_c_ + n_g_;
    MatrixXd  A(n_l, n_);
    VectorXd  open(n_l);
    A.topRows(n_c_) = joint_jacobian(machine_, G_);
    open.head(n_c_) = g;
    if (held_)
      hold(A, open);
    saddle.setZero(n_ + n_l, n_ + n_l);
    saddle.topLeftCorner(n_, n_)     = C_ + W * (acts_.asDiagonal() * geometric - dp) * W.transpose();
    saddle.topRightCorner(n_, n_l)   = -A.transpose();
    saddle.bottomLeftCorner(n_l, n_) = A;
    residual.resize(n_ + n_l);
    residual.head(n_)  = C_ * q_ - share * load_ - W * local_.p - A.bottomRows(n_g_).transpose() * lambda_.tail(n_g_);
    residual.tail(n_l) = open;
    for (const int i : machine_.virtual_coordinates()) // states of laws keep the value they start with
    {
      saddle.row(i).setZero();
      saddle(i, i) = 1.;
      residual[i]  = 0.;
    }
  }

  /// Rows of what is held, behind those of the joints.
  void hold(MatrixXd &A, VectorXd &open)
  {
    for (const auto &[row, shift] : held_->shifts)
      open[row] -= shift;
    int row = n_c_;
    for (const int i : given_)
    {
      A.row(row)  = VectorXd::Unit(n_, i).transpose();
      open[row++] = q_[i] - held_->state.q[i];
    }
    VectorXd gradient;
    for (const auto &[name, value] : held_->measures)
    {
      open[row]    = machine_.measure(name).evaluate(q_, zero_, &gradient).s - value;
      A.row(row++) = gradient.transpose();
    }
  }

  /// Scaled to rows and columns of equal size: stiffnesses beside cosines.
  VectorXd solution(const MatrixXd &saddle, const VectorXd &right) const
  {
    const int size = int(saddle.rows());
    VectorXd  scale(size);
    for (int i = 0; i < n_; ++i)
      scale[i] = 1. / std::sqrt(std::max(saddle.col(i).head(n_).cwiseAbs().maxCoeff(), 1.));
    for (int i = n_; i < size; ++i)
    {
      const double row = saddle.row(i).head(n_).cwiseProduct(scale.head(n_).transpose()).cwiseAbs().maxCoeff();
      scale[i]         = row > 0. ? 1. / row : 1.;
    }
    const MatrixXd             scaled = scale.asDiagonal() * saddle * scale.asDiagonal();
    const VectorXd             forces = scale.asDiagonal() * right;
    Eigen::FullPivLU<MatrixXd> lu;
    lu.setThreshold(singular);
    lu.compute(scaled);
    if (lu.isInvertible())
      return scale.asDiagonal() * lu.solve(forces);
    VectorXd motion = scale.asDiagonal() * lu.kernel().col(0);
    if (held_)
    {
      const VectorXd x = scaled.completeOrthogonalDecomposition().solve(forces);
      if ((scaled * x - forces).norm() <= balanced * forces.norm())
        return scale.asDiagonal() * x;
      // Open play gives no stiffness: closed elements show the way through it.
      const MatrixXd way = scale.asDiagonal() * with_closed_chains(saddle) * scale.asDiagonal();
      lu.compute(way);
      if (lu.isInvertible())
        return scale.asDiagonal() * lu.solve(forces);
      motion = scaled * x - forces; // of the free motions the one along which a force acts
    }
    int worst = 0;
    motion.head(n_).cwiseAbs().maxCoeff(&worst);
    throw std::invalid_argument("there is no static equilibrium: the motion of " + machine_.coordinate_name(worst) +
                                " has neither stiffness nor weight that holds it here; hold it, start from another "
                                "position, or with rule = \"given\"");
  }

  MatrixXd with_closed_chains(MatrixXd saddle) const
  {
    MatrixXd stiffness, damping;
    engaged_matrices(machine_, q_, {}, stiffness, damping);
    saddle.topLeftCorner(n_, n_) = C_ + stiffness;
    return saddle;
  }

  bool newton(double share)
  {
    MatrixXd saddle;
    VectorXd residual;
    double   before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_iterations; ++k)
    {
      evaluate(share, saddle, residual);
      const VectorXd delta = solution(saddle, -residual);
      if (!delta.allFinite())
        return false;
      const double size = delta.head(n_).cwiseAbs().maxCoeff(), scale = std::max(q_.cwiseAbs().maxCoeff(), 1e-6);
      // A long way is gone in parts: another equilibrium lies behind the next turn.
      const double part = size > 0.5 ? 0.5 / size : 1.;
      q_ += part * delta.head(n_);
      lambda_ += part * delta.tail(lambda_.size());
      if (part == 1. && (size <= converged * scale || (size < 1e-9 * scale && size > 0.3 * before)))
        return true;
      before = size;
    }
    return false;
  }

  Machine           &machine_;
  const KnownStart  *held_;
  int                n_, n_c_, n_g_ = 0; ///< coordinates; equations of joints, and of what is held
  std::vector<int>   given_;             ///< held coordinates
  double             t_;
  VectorXd           q_, lambda_, zero_;
  ConstraintJacobian G_;
  MatrixXd           C_;
  VectorXd           load_, acts_;
  LocalState         local_;
};

} // namespace

InitialState static_equilibrium(Machine &machine, const InitialState &assembled, Drift drift)
{
  if (machine.full_frame())
    throw std::invalid_argument(
        "a static start needs a reduced frame; give [reduction], or start with rule = \"given\"");
  Equilibrium equilibrium(machine, assembled);
  equilibrium.solve();
  InitialState state = assembled;
  state.q            = equilibrium.q();
  state.v            = drift == Drift::quasistatic ? equilibrium.drift() : Eigen::VectorXd::Zero(machine.size()).eval();
  return state;
}

HeldEquilibrium held_equilibrium(Machine &machine, const KnownStart &position)
{
  Equilibrium equilibrium(machine, position.state, &position);
  equilibrium.solve();
  return {equilibrium.q(), equilibrium.multipliers()};
}

} // namespace gestell::coupling
