// Every search for modes is one of SLEPc, by types of ours or of theirs, on the same matrices.

#include "coupling/algebra/dense_modes.h"
#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/integration/system/second_order_system.h"
#include "fem/parallel/petsc_session.h"
#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::LowestModes;
using coupling::PetscOwned;
using coupling::require_petsc;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// A lattice with its interface held, masses of very different size, and its modes by dense matrices.
struct HeldLattice
{
  fem::FrameMatrices       frame = test::frame_of(test::Lattice{});
  std::vector<int>         held  = frame.interface_coordinates(), free;
  coupling::SparseCholesky factor;
  VectorXd                 omega;

  HeldLattice() : factor((vary_mass(), frame.C), held)
  {
    for (int i = 0; i < frame.M.rows(); ++i)
      if (!std::binary_search(held.begin(), held.end(), i))
        free.push_back(i);
    omega = coupling::dense_modes(MatrixXd(frame.C)(free, free), MatrixXd(frame.M)(free, free)).omega;
  }
  void vary_mass()
  {
    for (int i = 0; i < frame.M.rows(); ++i)
      frame.M.coeffRef(i, i) *= 1. + i % 7;
  }

  std::unique_ptr<coupling::ModeSearch> search(const std::string &eigensolver, const LowestModes &known = {}) const
  {
    return coupling::search_modes(MPI_COMM_SELF,
                                  {std::make_shared<coupling::InverseByFactor>(factor, held), &frame.M, &frame.C},
                                  eigensolver, {}, known);
  }

  /// Largest relative distance of frequencies, and of V^T M V from the unit matrix.
  double error_of(const LowestModes &found) const
  {
    const auto k = found.omega.size();
    return std::max((found.omega.cwiseQuotient(omega.head(k)).array() - 1.).abs().maxCoeff(),
                    (found.V.transpose() * frame.M * found.V - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff());
  }
};

using Eigensolver = ::testing::TestWithParam<const char *>;

// Frequencies are better than the tolerance by its square, but LOBPCG's orthonormality ends at its tolerance 1e-8.
/// LOBPCG of SLEPc breaks down where rounding makes its Gram matrix indefinite (LAPACK's sygvd), as it does with
/// OpenBLAS' kernels for old processors: then it must say so, with the way out.
bool finds_or_breaks_down(coupling::ModeSearch &search, int count, const std::string &solver)
{
  try
  {
    search.find(count);
    return true;
  }
  catch (const std::exception &failure)
  {
    const std::string said = failure.what();
    if (solver != "lobpcg" || said.find("sygvd") == std::string::npos)
      throw;
    EXPECT_NE(said.find("check reduction.eigensolver"), std::string::npos) << said;
    return false;
  }
}

TEST_P(Eigensolver, FindsTheLowestModesOfTheFixedFrameAndSomeMore)
{
  const HeldLattice lattice;
  const auto        search = lattice.search(GetParam());
  for (const int count : {5, 17})
  {
    if (!finds_or_breaks_down(*search, count, GetParam()))
      return;
    const LowestModes found = search->modes(count);
    EXPECT_LT(lattice.error_of(found), 1e-8) << count;
    EXPECT_EQ(found.V(lattice.held, Eigen::all).cwiseAbs().maxCoeff(), 0.);
    const auto gap = search->gap_above(count);
    EXPECT_GE(gap.below, count);
    EXPECT_LT(lattice.omega(gap.below - 1), gap.low * (1. + 1e-8));
    EXPECT_GT(lattice.omega(gap.below), gap.high * (1. - 1e-2));
  }
}

TEST_P(Eigensolver, FindsTheModeThatIsMissingAmongThoseKnown)
{
  const HeldLattice lattice;
  const auto        search = lattice.search("block-lanczos");
  search->find(8);
  const LowestModes all = search->modes(8);
  for (const int missing : {0, 3, 7})
  {
    std::vector<int> others = {0, 1, 2, 3, 4, 5, 6, 7};
    others.erase(others.begin() + missing);
    const auto again = lattice.search(GetParam(), {all.omega(others), all.V(Eigen::all, others), all.bound(others)});
    if (!finds_or_breaks_down(*again, 8, GetParam()))
      return;
    EXPECT_LT(lattice.error_of(again->modes(8)), 1e-8) << missing;
  }
}

INSTANTIATE_TEST_SUITE_P(OfOursAndOfSlepc, Eigensolver, ::testing::Values("block-lanczos", "krylov-schur", "lobpcg"));

TEST(EigensolverOptions, ThatPetscDoesNotKnowAreReportedAsByPetsc)
{
  const HeldLattice lattice;
  tests::expect_refusal<coupling::ConvergenceFailure>([&] { lattice.search("no-such-type")->find(3); },
                                                      "eigensolver no-such-type");
}

TEST(BlockLanczosType, NeedsARangeOfMassAsLargeAsTheNumberOfModes)
{
  HeldLattice lattice;
  for (const int i : lattice.free)
    lattice.frame.M.coeffRef(i, i) *= i % 40 == 0;
  EXPECT_THROW(lattice.search("block-lanczos")->find(int(lattice.free.size()) - 1), coupling::ConvergenceFailure);
}

/// Upper triangle or both of C - sigma M with PETSc.
PetscOwned<Mat> matrix_of(const SparseMatrix &A, const char *type)
{
  Mat                   result = nullptr;
  PetscOwned<Mat>       owned;
  const Eigen::VectorXi entries =
      Eigen::VectorXi::Map(A.outerIndexPtr() + 1, A.cols()) - Eigen::VectorXi::Map(A.outerIndexPtr(), A.cols());
  require_petsc(MatCreate(PETSC_COMM_SELF, &result), "test");
  owned.reset(result);
  MatSetSizes(result, int(A.rows()), int(A.rows()), PETSC_DETERMINE, PETSC_DETERMINE);
  MatSetType(result, type);
  MatSeqAIJSetPreallocation(result, 0, entries.data());
  MatSeqSBAIJSetPreallocation(result, 1, 0, entries.data());
  if (type == std::string(MATSEQSBAIJ))
    MatSetOption(result, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE);
  for (int j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(A, j); a; ++a)
      require_petsc(MatSetValue(result, int(a.row()), j, a.value(), INSERT_VALUES), "test");
  MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY);
  return owned;
}

PetscOwned<Mat> factor_of(Mat A)
{
  Mat F = nullptr;
  require_petsc(MatGetFactor(A, coupling::own_factor, MAT_FACTOR_CHOLESKY, &F), "test");
  PetscOwned<Mat> owned(F);
  require_petsc(MatCholeskyFactorSymbolic(F, A, nullptr, nullptr), "test");
  require_petsc(MatCholeskyFactorNumeric(F, A, nullptr), "test");
  return owned;
}

class OwnFactor : public ::testing::TestWithParam<const char *>
{
protected:
  void SetUp() override
  {
    fem::petsc_session();
    coupling::register_own_types();
  }
};

TEST_P(OwnFactor, SolvesForMatricesOfPetsc)
{
  const SparseMatrix    C = test::frame_of(test::Lattice{}).C;
  const PetscOwned<Mat> A = matrix_of(C, GetParam()), F = factor_of(A.get());
  const int             n = int(C.rows());
  const MatrixXd        X = MatrixXd::Random(n, 3);
  MatrixXd              B = C * X, found = MatrixXd::Zero(n, 3);
  Mat                   f = nullptr, x = nullptr;
  MatCreateSeqDense(PETSC_COMM_SELF, n, 3, B.data(), &f);
  MatCreateSeqDense(PETSC_COMM_SELF, n, 3, found.data(), &x);
  const PetscOwned<Mat> own_f(f), own_x(x);
  require_petsc(MatMatSolve(F.get(), f, x), "test");
  EXPECT_LT((found - X).norm(), 1e-9 * X.norm());
  Vec a = nullptr, b = nullptr;
  VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, B.data(), &a);
  VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, found.data(), &b);
  const PetscOwned<Vec> own_a(a), own_b(b);
  found.setZero();
  require_petsc(MatSolve(F.get(), a, b), "test");
  EXPECT_LT((found.col(0) - X.col(0)).norm(), 1e-9 * X.col(0).norm());
}

TEST_P(OwnFactor, CountsTheModesBelowAShiftByInertia)
{
  const auto     frame = test::frame_of(test::Lattice{});
  const VectorXd omega = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M)).omega;
  for (const int below : {0, 1, 12})
  {
    const double          shift = below > 0 ? 0.5 * (omega(below - 1) + omega(below)) : 0.5 * omega(0);
    const PetscOwned<Mat> A = matrix_of(frame.C - shift * shift * frame.M, GetParam()), F = factor_of(A.get());
    PetscInt              negative = 0, zero = 0, positive = 0;
    require_petsc(MatGetInertia(F.get(), &negative, &zero, &positive), "test");
    EXPECT_EQ(negative, below);
    EXPECT_EQ(negative + positive, frame.C.rows());
    MatFactorError error = MAT_FACTOR_NOERROR;
    MatFactorGetError(F.get(), &error);
    EXPECT_EQ(error == MAT_FACTOR_NOERROR, below == 0) << "a Cholesky factor is of positive definite matrices";
  }
}

INSTANTIATE_TEST_SUITE_P(OfBothKindsOfMatrices, OwnFactor, ::testing::Values(MATSEQAIJ, MATSEQSBAIJ));

} // namespace
} // namespace gestell
