#include "coupling/integration/propagation/modal_propagation.h"

#include "coupling/integration/system/turning_forces.h"

namespace gestell::coupling
{

using Eigen::MatrixXd;

void ModalPropagation::begin_tangents(const MatrixXd &dq, const MatrixXd &dv)
{
  const MatrixXd modal = modes_.from_q * dq + modes_.from_v * dv;
  const auto     n_p   = context_.measures.n_p;
  X_.setZero(2 * n_p, dq.cols());
  for (int b = 0; b < modes_.n_modal; ++b)
  {
    X_.row(b)       = modal.row(2 * b);
    X_.row(n_p + b) = modal.row(2 * b + 1);
  }
  context_.project_held_tangents(local_.t, X_);
}

void ModalPropagation::carry_tangents()
{
  if (local_.t > t_begin_)
    force_->carry_tangents(X_);
}

void ModalPropagation::jump_tangents(const Eigen::VectorXd &before, const Eigen::RowVectorXd &dt)
{
  X_.noalias() += context_.measures.put * (before - local_.p) * dt;
  context_.project_held_tangents(local_.t, X_);
}

void ModalPropagation::tangents(MatrixXd &dq, MatrixXd &dv) const
{
  dq.noalias() = Q_ * X_;
  dv.noalias() = V_ * X_;
}

LocalTangents ModalPropagation::local_tangents_of(const MatrixXd &X)
{
  const Eigen::Index n_u = context_.measures.put.cols();
  LocalTangents      local;
  local.u               = context_.measures.read_u.transpose() * X;
  local.v               = context_.measures.read_v.transpose() * X;
  MatrixXd        dp_du = MatrixXd::Zero(n_u, n_u), dp_dv = dp_du;
  Eigen::VectorXd p = local_.p;
  linearise(system_.forces(), local_, p, dp_du, dp_dv);
  ++context_.work.evaluations;
  local.p = dp_du * local.u + dp_dv * local.v;
  context_.accelerate_tangents(X, local_.t, local);
  return local;
}

LocalTangents ModalPropagation::local_rates()
{
  const Eigen::VectorXd &x = state_at(local_.t);
  MatrixXd               rate(x.size(), 1);
  context_.free_rates(x.data(), rate.data());
  rate += context_.measures.constant + context_.measures.put * local_.p;
  return local_tangents_of(rate);
}

} // namespace gestell::coupling
