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

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Equilibrium
{
public:
  Equilibrium(Machine &machine, const InitialState &from)
      : machine_(machine), n_(machine.size()), n_c_(machine.n_constraints()), t_(from.t), q_(from.q),
        lambda_(VectorXd::Zero(n_c_)), zero_(VectorXd::Zero(n_)), G_(machine.constraint_blocks()),
        C_(dense_stiffness(machine)), load_(n_)
  {
    local_.resize(machine);
    machine.gather(t_, q_, zero_, zero_, local_);
    machine.start(local_);
    machine.excitation().at(t_, load_);
  }

  const VectorXd &q() const { return q_; }

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
    if (n_c_ > 0)
      lambda_ = saddle.topRightCorner(n_, n_c_).colPivHouseholderQr().solve(-residual.head(n_));
  }

  void evaluate(double share, MatrixXd &saddle, VectorXd &residual)
  {
    const auto &W = machine_.directions();
    machine_.gather(t_, q_, zero_, zero_, local_);
    local_.lambda = lambda_;
    VectorXd g(n_c_);
    machine_.constraints(local_, g, G_);
    MatrixXd dp = MatrixXd::Zero(W.cols(), W.cols()), geometric;
    machine_.local_tangent(local_, 1., 0., 0., local_.p, dp);
    for (const HeldMeasure &held : machine_.held())
    {
      local_.p[held.measure] = 0.;
      dp.row(held.measure).setZero();
    }
    G_.set_forces(lambda_, local_.p);
    machine_.geometric(local_, geometric);
    const MatrixXd A = joint_jacobian(machine_, G_);
    saddle.setZero(n_ + n_c_, n_ + n_c_);
    saddle.topLeftCorner(n_, n_)      = C_ + W * (geometric - dp) * W.transpose();
    saddle.topRightCorner(n_, n_c_)   = -A.transpose();
    saddle.bottomLeftCorner(n_c_, n_) = A;
    residual.resize(n_ + n_c_);
    residual.head(n_)   = C_ * q_ - share * load_ - W * local_.p;
    residual.tail(n_c_) = g;
  }

  /// Scaled to rows and columns of equal size: stiffnesses beside cosines.
  VectorXd solution(const MatrixXd &saddle, const VectorXd &right) const
  {
    VectorXd scale(n_ + n_c_);
    for (int i = 0; i < n_; ++i)
      scale[i] = 1. / std::sqrt(std::max(saddle.col(i).head(n_).cwiseAbs().maxCoeff(), 1.));
    for (int i = n_; i < n_ + n_c_; ++i)
    {
      const double row = saddle.row(i).head(n_).cwiseProduct(scale.head(n_).transpose()).cwiseAbs().maxCoeff();
      scale[i]         = row > 0. ? 1. / row : 1.;
    }
    Eigen::FullPivLU<MatrixXd> lu(scale.asDiagonal() * saddle * scale.asDiagonal());
    lu.setThreshold(singular);
    if (!lu.isInvertible())
    {
      int            worst  = 0;
      const VectorXd motion = scale.asDiagonal() * lu.kernel().col(0);
      motion.head(n_).cwiseAbs().maxCoeff(&worst);
      throw std::invalid_argument("there is no static equilibrium: the motion of " + machine_.coordinate_name(worst) +
                                  " has neither stiffness nor weight that holds it here; hold it, start from another "
                                  "position, or with rule = \"given\"");
    }
    return scale.asDiagonal() * lu.solve(scale.asDiagonal() * right);
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
      lambda_ += part * delta.tail(n_c_);
      if (part == 1. && (size <= converged * scale || (size < 1e-9 * scale && size > 0.3 * before)))
        return true;
      before = size;
    }
    return false;
  }

  Machine           &machine_;
  int                n_, n_c_;
  double             t_;
  VectorXd           q_, lambda_, zero_;
  ConstraintJacobian G_;
  MatrixXd           C_;
  VectorXd           load_;
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

} // namespace gestell::coupling
