#pragma once

#include "coupling/periodic/base_receptance.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// The linear machine of LinearResponse, without a frequency.
struct LinearisedSystem
{
  /// An entry of M, B or C that is not zero.
  struct BaseEntry
  {
    Eigen::Index i, j;
    double       M, B, C;
  };

  std::vector<BaseEntry>        base;
  Eigen::MatrixXd               M, B, C;
  Eigen::SparseMatrix<double>   W;
  Eigen::MatrixXd               K_u, B_u, M_u; ///< D(w) = K_u + i w B_u - w^2 M_u [n_u x n_u]
  Eigen::MatrixXd               E;
  Eigen::Index                  n_c = 0;
  std::optional<BaseReceptance> modes;
  std::string                   not_condensed;

  Eigen::Index     n() const { return M.rows(); }
  Eigen::Index     n_u() const { return W.cols(); }
  Eigen::MatrixXcd D(double omega) const
  {
    using Complex = std::complex<double>;
    return (K_u - omega * omega * M_u).cast<Complex>() + Complex(0., omega) * B_u.cast<Complex>();
  }
};

} // namespace gestell::coupling
