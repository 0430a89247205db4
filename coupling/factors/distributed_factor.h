#pragma once

#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/factors/row_distribution.h"
#include "coupling/factors/stiffness_factor.h"
#include "fem/parallel/ranks.h"

#include <memory>
#include <string>

namespace gestell::coupling
{

/// Whether PETSC_OPTIONS select a factor or an iterative solver (-reduction_st_...).
bool options_choose_solver();

/**
 * The part of this rank of a factor by PETSc.  Every function is collective; those with "on first" read and write
 * columns of rank 0.
 *
 * The matrix is factored by MUMPS: L L^T for solutions, and L D L^T with pivots for the inertia of C - sigma M. Options
 * of PETSc replace the first.
 */
class DistributedFactor
{
public:
  DistributedFactor(const fem::Ranks &ranks, const FactorMatrices &on_first);
  ~DistributedFactor();

  /// @returns whether C is positive definite.
  /// @throws NotEnoughMemory on all ranks.
  bool   factorise();
  double regularity() const { return regularity_; } ///< x^T C x / x^T diag(C) x of a motion with little stiffness
  void   release();

  /// Own rows of X <- C^-1 X.
  void    solve(Eigen::Ref<Eigen::MatrixXd> X) const;
  void    solve_on_first(Eigen::Ref<Eigen::MatrixXd> X) const;
  Inertia inertia(double sigma) const;

  /// See StiffnessFactor.
  void                        add_product_on_first(Given which, const Eigen::Ref<const Eigen::MatrixXd> &X,
                                                   Eigen::Ref<Eigen::MatrixXd> Y) const;
  Eigen::SparseMatrix<double> taken_back_on_first(Given which) const { return rows_.collected(given(which).get()); }

  std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                     const LowestModes *known_on_first);
  /// Modes with their rows on rank 0, [0 x count] elsewhere.
  LowestModes on_first(LowestModes own) const;

private:
  struct Solver;
  PetscOwned<Mat> stiffness() const;
  PetscOwned<Mat> mass() const;
  void            put_away(PetscOwned<Mat> &rows, StoredRows &stored) const;
  PetscOwned<Mat> given(Given which) const { return which == Given::C ? stiffness() : mass(); }
  double          regularity_of(const Eigen::VectorXd &diagonal) const;

  fem::Ranks              ranks_;
  FactorMatrices          on_first_;
  double                  available_;
  RowDistribution         rows_;
  PetscOwned<Mat>         given_C_, given_M_;   ///< C on several ranks until the first search
  StoredRows              stored_C_, stored_M_; ///< on several ranks; other matrices are distributed for each use
  std::unique_ptr<Solver> solver_;
  double                  regularity_ = 1.;
};

} // namespace gestell::coupling
