#pragma once

#include "coupling/integration/system/excitation.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Solves  A x = f,  A = w_M M + w_B B + w_C C,  for fixed weights; created by LinearSystem::factorise().
 *
 * If A is condensed to a few leading coordinates N, from which all others follow, an implicit step need not solve for
 * the others until the forces on N are known:
 *
 *     solve_leading(h, f, x)     x_N of A x = M h + f        (then x_N += Y_N p for forces p on N)
 *     solve_following(h, f, x)   the others, of the same equation, from the final x_N.
 */
class LinearSolver
{
public:
  virtual ~LinearSolver()                                                = default;
  virtual void solve(const Eigen::VectorXd &f, Eigen::VectorXd &x) const = 0;

  /// N; empty: there are no leading coordinates, and the other two functions must not be called.
  virtual const std::vector<int> &leading() const;
  virtual void solve_leading(const Eigen::VectorXd &h, const Eigen::VectorXd &f, Eigen::VectorXd &x) const;
  virtual void solve_following(const Eigen::VectorXd &h, const Eigen::VectorXd &f, Eigen::VectorXd &x) const;
};

/// One mode of the linear base system: s = -zeta omega +- i omega sqrt(1 - zeta^2).
struct SpectrumLine
{
  double omega; ///< [rad/s]
  double zeta;  ///< [1]
};

/// The linear base system  M q'' + B q' + C q = f_t(t), M, B, C [n x n] constant; it hides how its matrices are stored
/// and solved: dense, reduced or sparse.
class LinearSystem
{
public:
  virtual ~LinearSystem() = default;

  virtual int                           size() const                                                        = 0;
  virtual void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const      = 0;
  virtual void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const   = 0;
  virtual void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const = 0;
  virtual std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const                 = 0;
  virtual std::vector<SpectrumLine>     spectrum() const                                                    = 0;
  /// f_t(t) [n].
  virtual const Excitation &excitation() const = 0;
  /// M, B, C as dense matrices [n x n], for integrators that work in the modes of the base system; false: too large.
  virtual bool dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const;
  /// M, B, C as sparse matrices [n x n] that are cheap to factorise in every step, for systems of many joints; false:
  /// there are none, and joints are solved condensed to the measures.
  virtual bool sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                               Eigen::SparseMatrix<double> &C) const;
  /// Massless coordinates that are states of a law, not motions, such as the torque of a motor with first-order lag.
  /// M, B, C do not couple them to others; factorise(w, 0, 0) fixes them.  They store no energy.
  virtual const std::vector<int> &virtual_coordinates() const;
  /// Name of coordinate i, for messages.
  virtual std::string coordinate_name(int i) const = 0;
};

} // namespace gestell::coupling
