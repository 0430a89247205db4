#include "fem/values/stress_recovery.h"

namespace gestell::fem
{

namespace
{

using Gradients = Eigen::Matrix<double, Eigen::Dynamic, 3>; // [3 points x 3]: H_kl in row 3 point + l, column k

/// du_k/dx_l at all points from the displacements of the nodes.
Gradients gradients(const StressRecovery::Rows &shape, const Eigen::VectorXd &u)
{
  Gradients H = Gradients::Zero(3 * shape.rows(), 3);
  for (int i = 0; i < shape.outerSize(); ++i)
    for (StressRecovery::Rows::InnerIterator entry(shape, i); entry; ++entry)
    {
      const auto node = entry.col() / 3, l = entry.col() % 3;
      H.row(3 * i + l) += entry.value() * u.segment<3>(3 * node).transpose();
    }
  return H;
}

const Eigen::MatrixXf &by_state(const StressRecovery &recovery, StressOf which)
{
  return which == StressOf::mean ? recovery.mean_by_state : recovery.deviation_by_state;
}

} // namespace

Eigen::MatrixXd stresses_under_acceleration(const StressRecovery &recovery, StressOf which)
{
  return by_state(recovery, which).rightCols(recovery.mean_by_state.size() > 0 ? 3 : 0).cast<double>();
}

Eigen::MatrixXd stresses(const StressRecovery &recovery, const Eigen::Ref<const Eigen::MatrixXd> &q, StressOf which)
{
  const auto      n     = static_cast<Eigen::Index>(recovery.point.size());
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(stress_components * n, q.cols());
  if (const Eigen::MatrixXf &rows = by_state(recovery, which); rows.size() > 0)
  {
    for (Eigen::Index j = 0; j < q.rows(); ++j) // in double precision: terms of large rigid motions cancel
      sigma += rows.col(j).cast<double>() * q.row(j);
    return sigma;
  }
  for (Eigen::Index column = 0; column < q.cols(); ++column)
  {
    const Eigen::VectorXd u = recovery.u * q.col(column);
    Gradients             H = gradients(which == StressOf::mean ? recovery.mean : recovery.of_one, u);
    if (which == StressOf::deviation)
      H -= gradients(recovery.mean, u);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const auto &[lambda, mu]     = recovery.lame[i];
      const Eigen::Matrix3d strain = H.middleRows<3>(3 * i) + H.middleRows<3>(3 * i).transpose(); // doubled
      const double          press  = 0.5 * lambda * strain.trace();
      sigma.col(column).segment<stress_components>(stress_components * i) << press + mu * strain(0, 0),
          press + mu * strain(1, 1), press + mu * strain(2, 2), mu * strain(0, 1), mu * strain(1, 2), mu * strain(0, 2);
    }
  }
  return sigma;
}

} // namespace gestell::fem
