#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace gestell::coupling
{

/// Number of elastic modes of interest if no frequency is given.
constexpr int elastic_of_interest = 12;
/// Smallest ratio of the highest mode of a basis to the highest frequency of interest.
constexpr double reach_of_basis = 1.5;

/**
 * T of (5.5.3/16) with its rows in the frame's own order of coordinates: q = T p, p = (q1, modes).
 *
 * On the rows of q1 the first n1 columns are E and the modes zero; on all others they are -C22^-1 C21 and V22.  Work
 * vectors of the fixed-interface frame also have all n rows, with zeros on q1, which avoids gathering and scattering.
 */
struct ReductionBasis
{
  std::vector<int> q1;     // interface coordinates, ascending
  Eigen::MatrixXd  T;      // [n x (n1 + m)]
  Eigen::MatrixXd  M_Psi;  // M times the constraint modes [n x n1]
  Eigen::MatrixXd  C_11;   // C*_11 [n1 x n1]
  Eigen::VectorXd  omega0; // [m] fixed-interface frequencies (5.5.3/17) [rad/s]

  int  n1() const { return int(q1.size()); }
  int  m() const { return int(omega0.size()); }
  auto constraint_modes() const { return T.leftCols(n1()); }
  auto fixed_modes() const { return T.rightCols(m()); }

  /// Replaces the modes.
  void set_modes(const Eigen::Ref<const Eigen::MatrixXd> &V, const Eigen::VectorXd &omega);
  void truncate(int m);
};

/// Reduced matrices.
struct ReducedMatrices
{
  Eigen::MatrixXd M, B, C; // [(n1 + m) x (n1 + m)]
};

/**
 * M*, B*, C* by the blocks of (5.5.3/20): M*_22 = E, C*_12 = 0 and C*_22 = diag(omega0^2) are not computed but known.
 * With Psi the constraint modes and V the fixed-interface modes, both padded as in ReductionBasis,
 *
 *     M*_11 = Psi^T M Psi,   M*_12 = (M Psi)^T V,   C*_11 = Psi^T C Psi,   B* = T^T B T.
 *
 * C*_11 = C11 - C12 C22^-1 C21 is that of the basis, computed as this energy because errors of Psi enter squared:
 * rigid-body modes remain free.
 */
ReducedMatrices reduced_matrices(const ReductionBasis &basis, const Eigen::SparseMatrix<double> &B);

/**
 * Initial values (5.5.3/22, 23): q*_10 = q_10,  q*_20 = diag(1 / omega0^2) (V22^T C21 q_10 + V22^T C22 q_20); the same
 * serves for velocities.
 *
 * @param C  stiffness of the frame [n x n].
 * @param q  displacements or velocities of all its coordinates [n].
 */
Eigen::VectorXd project_initial(const ReductionBasis &basis, const Eigen::SparseMatrix<double> &C,
                                const Eigen::VectorXd &q);

/// Y <- A X for a symmetric sparse A (both triangles stored) and several columns, passing through A once per eight of
/// them.
void            symmetric_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X,
                                  Eigen::MatrixXd &Y);
Eigen::MatrixXd symmetric_product(const Eigen::SparseMatrix<double> &A, const Eigen::Ref<const Eigen::MatrixXd> &X);

} // namespace gestell::coupling
