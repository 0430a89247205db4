// A team of ranks with a task that fails, or does not, in the way the one argument says.  Called by team_test.

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/factors/make_factor.h"
#include "coupling/factors/mumps_factor.h"
#include "coupling/factors/petsc_factor.h"
#include "coupling/factors/row_distribution.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/parallel/petsc_session.h"
#include "tests/support/lattice.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{

using gestell::fem::Ranks;

constexpr int trial_order = 1000;

int shares_of_factor(const Ranks &ranks);

/// @returns on rank 0 the number of ranks that took part.
int trial(const Ranks &ranks, std::string how)
{
  ranks.broadcast(how);
  ranks.agree(
      [&]
      {
        if (how == "agreed" && ranks.rank() == 1)
          throw std::invalid_argument("the part of this rank is wrong");
      });
  if (how == "abrupt" && ranks.rank() == 1)
    ranks.abort("this rank broke down");
  if (how == "shares")
    return shares_of_factor(ranks);
  const int one = 1;
  int       sum = 0;
  MPI_Reduce(&one, &sum, 1, MPI_INT, MPI_SUM, 0, ranks.comm()); // where the others wait
  return sum;
}

gestell::fem::FrameMatrices lattice_frame(double foundation = 3e6)
{
  gestell::test::Lattice lattice;
  lattice.foundation = foundation;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  return gestell::test::frame_of(lattice);
}

/// @returns the number of ranks with a share of the factor of a plate; 0 unless all eliminate in the order of rows.
int shares_of_factor(const Ranks &ranks)
{
  using namespace gestell::coupling;
  gestell::fem::petsc_session();
  gestell::test::Lattice lattice;
  lattice.nx = 60, lattice.ny = 60, lattice.nz = 1;
  const auto            frame = gestell::test::frame_of(lattice);
  const RowDistribution rows(ranks, ranks.first() ? &frame.C : nullptr, frame.interface_coordinates());
  const auto            C = rows.distributed(ranks.first() ? &frame.C : nullptr);
  const QuietPetsc      quiet;
  const auto            factor  = mumps_factor(ranks, C.get(), true, INFINITY);
  PetscInt              entries = 0, order = 0;
  MatMumpsGetInfo(factor.get(), 9, &entries);
  MatMumpsGetInfog(factor.get(), 7, &order);
  constexpr int given = 1;
  double        share = entries > 0 && order == given ? 1. : 0.;
  ranks.sum(&share, 1);
  return int(share);
}

void tell(const std::string &what, bool agrees)
{
  std::cout << what << (agrees ? " agrees" : " differs") << std::endl;
}

/// The factor of all ranks against that of this one: solutions, modes, their number, and the same after release().
void compare_with_one_process(const Ranks &ranks)
{
  using namespace gestell::coupling;
  const auto            frame  = lattice_frame();
  const auto            q1     = frame.interface_coordinates();
  const auto            alone  = petsc_stiffness_factor(Ranks::alone(), {&frame.C, &frame.M, q1});
  const auto            factor = make_factor("", {&frame.C, &frame.M, q1});
  const Eigen::MatrixXd loads  = frame.M * Eigen::MatrixXd::Random(frame.M.rows(), 21);
  Eigen::MatrixXd       X = loads, Y = loads;
  alone->factorise();
  factor->factorise();
  alone->solve_in_place(Y);
  factor->solve_in_place(X);
  tell("the regularity", std::abs(factor->regularity() / alone->regularity() - 1.) < 1e-6);
  tell("the solution", (X - Y).norm() < 1e-11 * Y.norm());

  auto search = factor->search("block-lanczos", {}, {}), lanczos = alone->search("block-lanczos", {}, {});
  search->find(12);
  lanczos->find(12);
  const LowestModes modes = search->modes(12), expected = lanczos->modes(12);
  tell("the frequencies", (modes.omega - expected.omega).norm() < 1e-9 * expected.omega.norm());
  tell("the mass of the modes",
       (modes.V.transpose() * frame.M * modes.V - Eigen::MatrixXd::Identity(12, 12)).norm() < 1e-9);
  tell("the shapes",
       (modes.V.transpose() * frame.C * modes.V).isApprox(Eigen::MatrixXd(modes.omega.cwiseAbs2().asDiagonal()), 1e-6));
  const double between = 0.5 * (modes.omega(6) + modes.omega(7));
  factor->release();
  tell("the number", factor->below(between).negative == 7);
  factor->factorise();
  const LowestModes known{modes.omega.head(7), modes.V.leftCols(7), modes.bound.head(7)};
  for (const std::string eigensolver : {"block-lanczos", "krylov-schur", "lobpcg"})
  {
    auto rest = factor->search(eigensolver, {}, known);
    rest->find(12);
    const LowestModes found = rest->modes(12);
    tell("the rest by " + eigensolver, (found.omega - expected.omega).norm() < 1e-9 * expected.omega.norm());
    tell("the mass by " + eigensolver,
         (found.V.transpose() * frame.M * found.V - Eigen::MatrixXd::Identity(12, 12)).norm() < 1e-7);
  }

  Eigen::SparseMatrix<double> given = frame.C;
  const auto                  whole = make_factor("mumps", {nullptr, nullptr, q1, &given});
  X                                 = loads;
  whole->factorise();
  whole->solve_in_place(X);
  tell("the solution with the matrix given away", given.nonZeros() == 0 && (X - Y).norm() < 1e-11 * Y.norm());

  given = frame.C;
  given.coeffRef(250, 250) *= -1.;
  try
  {
    make_factor("", {&given, nullptr, q1})->factorise();
    tell("the refusal of what is not positive", false);
  }
  catch (const NotPositiveDefinite &)
  {
    tell("the refusal of what is not positive", true);
  }
  try
  {
    make_factor("cholmod", {&frame.C, nullptr, q1});
    tell("the refusal of a factor of one process", false);
  }
  catch (const std::invalid_argument &)
  {
    tell("the refusal of a factor of one process", ranks.size() > 1);
  }
}

/// Reductions with M and C on all ranks against those with M and C on rank 0.
void give_matrices_away()
{
  using namespace gestell::coupling;
  ReductionOptions counted, chosen, free, guyan;
  counted.n_modes  = 12;
  chosen.frequency = 30.;
  free.n_modes = 8, free.method = "free-interface";
  guyan.method     = "guyan";
  const auto close = [](const Eigen::MatrixXd &A, const Eigen::MatrixXd &B)
  { return (A - B).norm() <= 1e-9 * B.norm(); };
  const auto sizes = [](const Eigen::MatrixXd &A) { return Eigen::MatrixXd(A.cwiseAbs()); }; // modes have any sign
  for (const bool floats : {false, true})
    for (const auto &[options, what] :
         {std::pair(counted, "with counted modes"), std::pair(chosen, "with chosen modes"),
          std::pair(free, "by free modes"), std::pair(guyan, "by static shapes")})
    {
      auto       frame    = lattice_frame(floats ? 0. : 3e6);
      const auto expected = reduce_with_basis(frame, options).frame;
      const auto reduced  = reduce_with_basis(frame, options, {}, &frame).frame;
      tell(std::string(floats ? "a floating" : "a supported") + " frame " + what,
           close(reduced.frequencies_hz, expected.frequencies_hz) && close(sizes(reduced.M), sizes(expected.M)) &&
               close(sizes(reduced.B), sizes(expected.B)) && close(sizes(reduced.C), sizes(expected.C)) &&
               reduced.facts.free_motions == expected.facts.free_motions);
      tell(std::string("the place of M and C ") + what,
           (frame.C.nonZeros() == 0) == (!floats && options.method != "free-interface"));
    }
  auto loose = lattice_frame(0.);
  loose.interfaces.clear();
  const auto whole = loose.C;
  try
  {
    reduce_with_basis(loose, counted, {}, &loose);
  }
  catch (const std::invalid_argument &refusal)
  {
    std::cout << refusal.what() << std::endl;
  }
  tell("the matrix taken back", (loose.C - whole).norm() == 0. && loose.C.nonZeros() == whole.nonZeros());
}

/// Looks for modes up to all there are, and beyond: few points have mass.
void exhaust_modes()
{
  gestell::test::Lattice lattice;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  auto                                frame = gestell::test::frame_of(lattice);
  std::vector<Eigen::Triplet<double>> M;
  for (int p = 100; p < 108; ++p) // one of them belongs to an interface: 21 internal coordinates have mass
    for (int d = 0; d < 3; ++d)
      M.emplace_back(3 * p + d, 3 * p + d, 2. + 0.1 * p + d);
  frame.M.setFromTriplets(M.begin(), M.end());
  for (const int count : {16, 19, 21, 22})
    try
    {
      gestell::coupling::ReductionOptions options;
      options.n_modes    = count;
      const auto reduced = gestell::coupling::reduce_frame(frame, options);
      std::cout << count << " of 21 modes found: " << reduced.omega0.size() << ", " << reduced.statements.front()
                << std::endl;
    }
    catch (const gestell::coupling::ConvergenceFailure &failure)
    {
      std::cout << failure.what() << std::endl;
    }
}

/// The number of modes by tolerance, for a frequency so low that none is needed.
void reduce_without_modes()
{
  gestell::test::Lattice lattice;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  auto frame = gestell::test::frame_of(lattice);
  frame.B.setZero();
  gestell::coupling::ReductionOptions options;
  options.frequency  = 0.5;
  const auto reduced = gestell::coupling::reduce_frame(frame, options);
  std::cout << reduced.omega0.size() << " modes: " << reduced.statements.front() << std::endl;
}

int call_trial(const Ranks &ranks, const std::string &how)
{
  ranks.order(trial_order);
  return trial(ranks, how);
}

int lead(const Ranks &ranks, const std::string &how)
{
  gestell::coupling::share_factors();
  if (how == "exhaust")
    exhaust_modes();
  if (how == "none")
    reduce_without_modes();
  if (how == "give")
    give_matrices_away();
  if (how == "compare")
    compare_with_one_process(ranks);
  try
  {
    std::cout << call_trial(ranks, how) << " ranks took part" << std::endl;
  }
  catch (const gestell::fem::AgreedFailure &error)
  {
    std::cout << "told: " << error.what() << std::endl;
  }
  std::cout << "then " << call_trial(ranks, "sound") << " ranks took part" << std::endl; // none is left waiting
  ranks.order(0);
  return 0;
}

void follow(const Ranks &ranks)
{
  while (const int order = ranks.next_order())
    try
    {
      if (order == trial_order)
        trial(ranks, "");
      else
        gestell::coupling::serve_petsc_factors(order);
    }
    catch (const gestell::fem::AgreedFailure &)
    {
    }
}

} // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const Ranks ranks;
  if (ranks.first())
    lead(ranks, argc > 1 ? argv[1] : "sound");
  else
    follow(ranks);
  MPI_Finalize();
  return 0;
}
