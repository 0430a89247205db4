#pragma once

#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/parallel/mumps_factor.h"
#include "coupling/parallel/shared_matrices.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * The frame with its interface held, on all ranks: each has its rows of C and M and its part of the factor of C22.
 *
 * Vectors on rank 0 have all n rows in the order of q, those of q1 zero.  Every function is collective; arguments and
 * results are those of rank 0.
 */
class SharedHeldFrame
{
public:
  /// @param q1 nullptr on the ranks above 0.
  SharedHeldFrame(std::shared_ptr<const SharedMatrices> matrices, const std::vector<int> *q1);

  /// C22 has a factor, and all pivots are positive.
  bool positive() const { return positive_; }
  /// x^T C22 x / x^T D x, D the diagonal, of a motion nearly as soft as any: rounding if one is free.
  double softest() const { return softest_; }

  /// X <- C22^-1 X on the rows of q2, zero on those of q1.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X);
  /// x <- C22^-1 f2 for f with entries in all rows; f and x differ.
  void solve(Vec f, Vec x);

  /**
   * The lowest modes of (C22 - omega^2 M22) v = 0: Krylov-Schur of SLEPc in the inner product of M, spectral transform
   * at shift 0.
   *
   * @param known modes found before, M-orthonormal: only higher ones are looked for.
   * @returns those that converged, fewer than `count` where M22 has a lower rank.
   * @throws fem::AgreedFailure if C22 is not positive definite.
   */
  LowestModes lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known);

  /// Number of modes below omega [rad/s]: of negative pivots of C22 - omega^2 M22.  Gives the factor of C22 back, which
  /// is made anew when it is needed.
  int modes_below(double omega);

private:
  void            factorise();
  PetscOwned<Vec> irregular_motion();
  void            measure_softest();

  std::shared_ptr<const SharedMatrices> matrices_;
  std::vector<int>                      q1_;     // rank 0
  std::vector<int>                      held_;   // its rows
  std::vector<int>                      places_; // rank 0: of all rows in the elimination
  PetscOwned<Vec>                       free_load_;
  std::unique_ptr<MumpsFactor>          factor_;
  bool                                  positive_ = false;
  double                                softest_  = 0.;
};

} // namespace gestell::coupling
