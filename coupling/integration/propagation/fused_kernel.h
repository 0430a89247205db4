#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * One pass over the modes:   y = E y_0 + c + F p   and   free = (C^T y),   all in the layout of ModalMeasures.
 *
 * @param E     [n_p x 4]
 * @param F     [2 n_p x n_f]
 * @param read  [2 n_p x n_r]
 */
struct FusedPass
{
  const Eigen::MatrixXd *E, *F, *read;
  const Eigen::VectorXd *constant;
};

/// For n_f = N and n_r = 2 N known at compile time; sums are over packets of four, always in the same order.
template <int N>
void fused_pass(const FusedPass &pass, const double *y_0, const double *p, double *y, double *free)
{
  using Packet         = Eigen::Array<double, 4, 1>;
  using In             = Eigen::Map<const Packet>;
  using Out            = Eigen::Map<Packet>;
  const Eigen::Index n = pass.E->rows(), column = 2 * n;
  const double      *E = pass.E->data(), *F = pass.F->data(), *C = pass.read->data(), *c = pass.constant->data();
  Packet             sum[2 * N];
  for (int j = 0; j < 2 * N; ++j)
    sum[j].setZero();
  for (Eigen::Index b = 0; b < n; b += 4)
  {
    const Packet x_1 = In(y_0 + b), x_2 = In(y_0 + n + b);
    Packet       y_1 = In(c + b) + In(E + b) * x_1 + In(E + n + b) * x_2;
    Packet       y_2 = In(c + n + b) + In(E + 2 * n + b) * x_1 + In(E + 3 * n + b) * x_2;
    for (int j = 0; j < N; ++j)
    {
      y_1 += p[j] * In(F + j * column + b);
      y_2 += p[j] * In(F + j * column + n + b);
    }
    Out(y + b)     = y_1;
    Out(y + n + b) = y_2;
    for (int j = 0; j < 2 * N; ++j)
      sum[j] += y_1 * In(C + j * column + b) + y_2 * In(C + j * column + n + b);
  }
  for (int j = 0; j < 2 * N; ++j)
    free[j] = (sum[j][0] + sum[j][1]) + (sum[j][2] + sum[j][3]);
}

/// For any number of measures.
inline void fused_pass_any(const FusedPass &pass, const double *y_0, const double *p, double *y, double *free)
{
  const Eigen::Index                     n = pass.E->rows(), n_f = pass.F->cols(), n_r = pass.read->cols();
  const Eigen::Map<const Eigen::ArrayXd> x_1(y_0, n), x_2(y_0 + n, n);
  Eigen::Map<Eigen::VectorXd>            out(y, 2 * n), result(free, n_r);
  out = *pass.constant;
  out.head(n).array() += pass.E->col(0).array() * x_1 + pass.E->col(1).array() * x_2;
  out.tail(n).array() += pass.E->col(2).array() * x_1 + pass.E->col(3).array() * x_2;
  for (Eigen::Index j = 0; j < n_f; ++j)
    out += p[j] * pass.F->col(j);
  for (Eigen::Index j = 0; j < n_r; ++j)
    result[j] = pass.read->col(j).dot(out);
}

} // namespace gestell::coupling
