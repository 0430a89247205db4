// Every factor of the stiffness, and solvers that options of PETSC_OPTIONS choose, against dense matrices.

#include "coupling/algebra/dense_modes.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/factors/make_factor.h"
#include "coupling/factors/mumps_factor.h"
#include "coupling/factors/row_distribution.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/parallel/petsc_session.h"
#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>
#include <petscsys.h>

#include <map>

namespace gestell
{
namespace
{

using coupling::LowestModes;
using coupling::QuietPetsc;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Options of PETSc during its lifetime.
class Options
{
public:
  explicit Options(std::map<std::string, std::string> values) : values_(std::move(values))
  {
    fem::petsc_session();
    for (const auto &[name, value] : values_)
      PetscOptionsSetValue(nullptr, name.c_str(), value.c_str());
  }
  ~Options()
  {
    for (const auto &[name, value] : values_)
      PetscOptionsClearValue(nullptr, name.c_str());
  }

private:
  std::map<std::string, std::string> values_;
};

/// A lattice with its interface fixed, and its modes by dense matrices.
struct FixedLattice
{
  fem::FrameMatrices frame = test::frame_of(test::Lattice{});
  std::vector<int>   held  = frame.interface_coordinates(), free;
  VectorXd           omega;

  FixedLattice()
  {
    for (int i = 0; i < frame.M.rows(); ++i)
    {
      frame.M.coeffRef(i, i) *= 1. + i % 7; // masses of different size
      if (!std::binary_search(held.begin(), held.end(), i))
        free.push_back(i);
    }
    omega = coupling::dense_modes(MatrixXd(frame.C)(free, free), MatrixXd(frame.M)(free, free)).omega;
  }

  std::unique_ptr<coupling::StiffnessFactor> factor(const std::string &name) const
  {
    return coupling::make_factor(name, {&frame.C, &frame.M, held});
  }

  double error_of(const LowestModes &found) const
  {
    const auto k = found.omega.size();
    return std::max((found.omega.cwiseQuotient(omega.head(k)).array() - 1.).abs().maxCoeff(),
                    (found.V.transpose() * frame.M * found.V - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff());
  }
};

void expect_dense_answers(const FixedLattice &lattice, coupling::StiffnessFactor &factor)
{
  const fem::FrameMatrices &frame = lattice.frame;
  const std::vector<int>   &held = lattice.held, &free = lattice.free;
  const VectorXd           &omega = lattice.omega;
  factor.factorise();
  EXPECT_GT(factor.regularity(), 1e-11);

  const MatrixXd loads = MatrixXd::Random(frame.C.rows(), 19);
  const MatrixXd C = MatrixXd(frame.C)(free, free), F = loads(free, Eigen::all);
  MatrixXd       X = loads, expected = MatrixXd::Zero(loads.rows(), loads.cols());
  const MatrixXd inner       = C.ldlt().solve(F);
  expected(free, Eigen::all) = inner;
  factor.solve_in_place(X);
  EXPECT_LT((X - expected).norm(), 1e-9 * expected.norm());
  EXPECT_EQ(X(held, Eigen::all).cwiseAbs().maxCoeff(), 0.);

  {
    const auto search = factor.search("block-lanczos", {}, {});
    search->find(9);
    const LowestModes found = search->modes(9);
    EXPECT_LT(lattice.error_of(found), 1e-8);
    EXPECT_EQ(found.V(held, Eigen::all).cwiseAbs().maxCoeff(), 0.);

    const auto rest =
        factor.search("block-lanczos", {}, {found.omega.head(4), found.V.leftCols(4), found.bound.head(4)});
    rest->find(9);
    EXPECT_LT(lattice.error_of(rest->modes(9)), 1e-8) << "beyond known modes";
  }
  factor.release();
  for (const int below : {0, 1, 7})
  {
    const double            shift   = below > 0 ? 0.5 * (omega(below - 1) + omega(below)) : 0.5 * omega(0);
    const coupling::Inertia inertia = factor.below(shift);
    EXPECT_EQ(inertia.negative, below);
    EXPECT_LT(inertia.growth, 1e6); // of rounding: far below 1 / sqrt(eps)
  }
  factor.factorise();
  X = loads;
  factor.solve_in_place(X);
  EXPECT_LT((X - expected).norm(), 1e-9 * expected.norm()) << "after release()";
}

using Factor = ::testing::TestWithParam<const char *>;

TEST_P(Factor, SolvesFindsModesAndCountsThem)
{
  const FixedLattice lattice;
  expect_dense_answers(lattice, *lattice.factor(GetParam()));
}

TEST_P(Factor, RefusesAnIndefiniteMatrix)
{
  FixedLattice lattice;
  lattice.frame.C.coeffRef(lattice.free[100], lattice.free[100]) *= -1.;
  EXPECT_THROW(lattice.factor(GetParam())->factorise(), coupling::NotPositiveDefinite);
}

TEST_P(Factor, ReducesAFrameAsTheOthersDo)
{
  const auto                 frame = test::frame_of(test::Lattice{});
  coupling::ReductionOptions options;
  options.n_modes     = 6;
  const auto expected = coupling::reduce_frame(frame, options);
  options.factor      = GetParam();
  const auto reduced  = coupling::reduce_frame(frame, options);
  EXPECT_LT((reduced.omega0 - expected.omega0).norm(), 1e-9 * expected.omega0.norm());
  EXPECT_LT((reduced.C - expected.C).norm(), 1e-9 * expected.C.norm());
  EXPECT_EQ(reduced.statements.front(), expected.statements.front());
}

TEST_P(Factor, NamesTheFreeMotionOfAFrameThatFloats)
{
  test::Lattice lattice;
  lattice.foundation = 0.;
  auto frame         = test::frame_of(lattice);
  frame.interfaces.clear();
  coupling::ReductionOptions options;
  options.n_modes = 3;
  options.factor  = GetParam();
  tests::expect_refusal<std::invalid_argument>([&] { coupling::reduce_frame(frame, options); },
                                               "the frame is unconstrained");
}

TEST_P(Factor, RefusesMoreThanTheMemory)
{
  const FixedLattice lattice;
  const auto factor = coupling::make_factor(GetParam(), {&lattice.frame.C, &lattice.frame.M, {}, nullptr, 1000.});
  EXPECT_THROW(factor->factorise(), coupling::NotEnoughMemory);
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, Factor, ::testing::Values("gestell", "cholmod", "mumps"));

TEST(FactorOptions, OfPetscReplaceTheFactor)
{
  const FixedLattice lattice;
  for (const auto &values :
       {std::map<std::string, std::string>{{"-reduction_st_pc_factor_mat_solver_type", "cholmod"}},
        {{"-reduction_st_pc_type", "lu"}, {"-reduction_st_pc_factor_mat_solver_type", "superlu_dist"}},
        {{"-reduction_st_pc_type", "icc"}}}) // preconditions conjugate gradients
  {
    const Options options(values);
    expect_dense_answers(lattice, *lattice.factor(""));
  }
}

TEST(FactorOptions, OfMumpsReachItsFactor)
{
  const FixedLattice lattice;
  const Options      options({{"-reduction_mat_mumps_icntl_22", "1"}, {"-reduction_mat_mumps_ooc_tmpdir", "/nowhere"}});
  EXPECT_THROW(lattice.factor("mumps")->factorise(), coupling::ConvergenceFailure) << "a folder that does not exist";
}

TEST(MumpsFactor, EliminatesInTheOrderOfItsRows)
{
  fem::petsc_session();
  const FixedLattice              lattice;
  const fem::Ranks                alone = fem::Ranks::alone();
  const coupling::RowDistribution rows(alone, &lattice.frame.C, lattice.held);
  const auto                      C        = rows.distributed(&lattice.frame.C);
  const auto                      order_of = [&](bool definite)
  {
    PetscInt         order = 0;
    const QuietPetsc quiet;
    MatMumpsGetInfog(coupling::mumps_factor(alone, C.get(), definite, INFINITY).get(), 7, &order);
    return order;
  };
  constexpr int given = 1, by_degree = 0;
  EXPECT_EQ(order_of(true), given);
  EXPECT_EQ(order_of(false), given);
  const Options options(std::map<std::string, std::string>{{"-reduction_mat_mumps_icntl_7", "0"}});
  EXPECT_EQ(order_of(true), by_degree) << "an option of the user";
}

TEST(FactorOptions, OfAPoorSolverAreRefused)
{
  const FixedLattice lattice;
  const Options      options({{"-reduction_st_ksp_type", "preonly"}, {"-reduction_st_pc_type", "jacobi"}});
  const auto         factor = lattice.factor("");
  tests::expect_refusal<coupling::ConvergenceFailure>([&] { factor->factorise(); }, "of the load as residual");
}

TEST(Factors, HaveNoOtherNames)
{
  const FixedLattice lattice;
  tests::expect_refusal<std::invalid_argument>([&] { lattice.factor("pardiso"); }, "there is no factor \"pardiso\"");
}

} // namespace
} // namespace gestell
