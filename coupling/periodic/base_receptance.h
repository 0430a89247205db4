#pragma once

#include "coupling/integration/propagation/modal_blocks.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace gestell::coupling
{

/**
 * The response of the base system to harmonic forces F e^(i w t), in its complex modes:
 *
 *     q = Y(s) F,     Y(s) = (s^2 M + s B + C)^-1 = Q (s E - Lambda)^-1 G,     s = i w,
 *
 * so that a frequency costs two multiplications per mode and entry, and no factor; condensed to what is read and where
 * forces act,
 *
 *     R(s) = read^T (s E - Lambda)^-1 put = sum over the blocks of their products, weighed by shares that tell of s,
 *
 * m operations for a frequency and an entry.  Singular parts at s = 0 (motions without stiffness) are omitted there.
 * Virtual coordinates T x' + x = f are separate states.
 *
 * Source: docs/theory/frequency_response.md (3), docs/theory/periodic.md (6).
 */
class BaseReceptance
{
public:
  /// @param read  W of what is read [n x n_rows]
  /// @param act   W of the forces [n x n_u]
  /// @throws std::invalid_argument if the matrices are not dense, a coordinate has no mass or eigenvectors coincide
  BaseReceptance(const LinearSystem &base, const Eigen::MatrixXd &read, const Eigen::MatrixXd &act);
  /// Of modes that are known; blocks of a load are left out.
  BaseReceptance(const ModalBlocks &modes, const Eigen::MatrixXd &read, const Eigen::MatrixXd &act);

  Eigen::Index                   n_states() const { return Q_.cols(); }
  const Eigen::MatrixXd         &Q() const { return Q_; }       ///< [n x n_x]
  const Eigen::MatrixXd         &G() const { return G_; }       ///< [n_x x n]
  const Eigen::MatrixXd         &read() const { return read_; } ///< Q^T W of what is read [n_x x n_rows]
  const Eigen::MatrixXd         &put() const { return put_; }   ///< G W of the forces [n_x x n_u]
  const std::vector<ModalBlock> &blocks() const { return blocks_; }

  /// X becomes (s E - Lambda)^-1 X, [n_x x columns].  A block that is undamped and driven at its own frequency makes
  /// it infinite.
  void divide(std::complex<double> s, Eigen::Ref<Eigen::MatrixXcd> X) const;

  enum class Slopes
  {
    none,
    with
  };
  /// Computes R at s = i h omega, h = 0 ... H, and the derivatives by omega if requested.
  void             tabulate(double omega, int harmonics, Slopes slopes);
  Eigen::MatrixXcd R(int h) const { return entry(table_, h); }       ///< [n_rows x n_u]
  Eigen::MatrixXcd R_slope(int h) const { return entry(slope_, h); } ///< over omega [s/rad]

private:
  void             fill_products();
  void             fill_shares(int h);
  void             fill_share_slopes(int h);
  Eigen::MatrixXcd entry(const Eigen::MatrixXd &table, int h) const;

  std::vector<ModalBlock> blocks_; ///< of modes, then of virtual coordinates, whose second state is nothing
  Eigen::MatrixXd         Q_, G_, read_, put_;
  Eigen::ArrayXd          s_, w_;         ///< of the blocks
  std::vector<int>        others_;        ///< blocks that do not oscillate
  Eigen::MatrixXd         products_;      ///< of read and put, one or two for each block [n_rows n_u x (1 or 2) n_b]
  Eigen::MatrixXd         shares_;        ///< of the blocks at the harmonics [1 or 2 n_b x 2 or 4 (H + 1)]
  Eigen::MatrixXd         table_, slope_; ///< R and its slopes, real parts and imaginary ones beside them
  double                  omega_     = 0.;
  int                     harmonics_ = 0;
};

} // namespace gestell::coupling
