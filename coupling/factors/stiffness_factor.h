#pragma once

#include "coupling/algebra/multifrontal.h"
#include "coupling/eigensolvers/block_lanczos.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Matrices of a frame, compressed with both triangles stored, which must outlive their factor.
struct FactorMatrices
{
  const Eigen::SparseMatrix<double> *C         = nullptr;  ///< [n x n]
  const Eigen::SparseMatrix<double> *M         = nullptr;  ///< the same; none: solutions only
  std::vector<int>                   held      = {};       ///< fixed coordinates, ascending
  Eigen::SparseMatrix<double>       *given_C   = nullptr;  ///< in place of C: without entries when it is distributed
  double                             available = INFINITY; ///< bytes of this computer
  Eigen::SparseMatrix<double>       *given_M   = nullptr;  ///< likewise, in place of M

  const Eigen::SparseMatrix<double> &stiffness() const { return given_C ? *given_C : *C; }
};

/// A matrix that was given away.
enum class Given
{
  C,
  M
};

/**
 * A factor of C22, the stiffness without the fixed coordinates: for solutions, modes and their number.  Each kind has
 * the same functions:
 *
 * | name      | factor                                        | number of modes below a frequency | processes |
 * |-----------|-----------------------------------------------|-----------------------------------|-----------|
 * | "gestell" | SparseCholesky                                | its own L D L^T                   | one       |
 * | "cholmod" | CHOLMOD, supernodal, indices of 64 bit        | MUMPS                             | one       |
 * | "mumps"   | MUMPS through PETSc                           | MUMPS                             | any       |
 *
 * Options of PETSc (-reduction_st_pc_factor_mat_solver_type, -reduction_st_pc_type, -reduction_st_ksp_type) replace the
 * factor of solutions in any number of processes.
 */
class StiffnessFactor
{
public:
  virtual ~StiffnessFactor() = default;

  /// Computes the factor if needed.
  /// @throws NotPositiveDefinite, with coordinate -1 if the library does not name it; NotEnoughMemory.
  virtual void factorise() = 0;
  /// Distance from singularity, roughly: a frame that is held has more than 1e-11.
  virtual double regularity() const = 0;
  /// Frees the memory of the factor; below() stays available.
  virtual void release() = 0;

  /// X [n x k] <- C22^-1 X; zero in the fixed coordinates.
  virtual void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const = 0;
  /// Y [n x k] <- Y + A22 X for a matrix that was given away, summed in twice the working precision; zero in the fixed
  /// coordinates.
  virtual void add_product(Given, const Eigen::Ref<const Eigen::MatrixXd> &, Eigen::Ref<Eigen::MatrixXd>) const
  {
    throw std::logic_error("StiffnessFactor: no matrix was given away");
  }
  /// A22 itself [n x n], without the rows and columns of fixed coordinates.
  virtual Eigen::SparseMatrix<double> taken_back(Given) const
  {
    throw std::logic_error("StiffnessFactor: no matrix was given away");
  }

  /// Number of modes below omega [rad/s], by the inertia of C22 - omega^2 M22.
  virtual Inertia below(double omega) = 0;
  /// The search for the lowest modes; see search_modes().
  virtual std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                             const LowestModes &known) const = 0;
};

} // namespace gestell::coupling
