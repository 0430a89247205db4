// A team of ranks with a task that fails, or does not, in the way the one argument says.  Called by team_test.

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/parallel/obey.h"
#include "coupling/parallel/team.h"
#include "coupling/parallel/team_factor.h"
#include "coupling/reduction/reduce_frame.h"
#include "tests/support/lattice.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{

using gestell::coupling::RankTask;
using gestell::coupling::Team;
using gestell::fem::Ranks;

struct Trial
{
  static constexpr RankTask order = RankTask(1000);
  std::string               how;
  int                       sum = 0;

  void run(const Ranks &ranks)
  {
    ranks.broadcast(how);
    ranks.agree(
        [&]
        {
          if (how == "agreed" && ranks.rank() == 1)
            throw std::invalid_argument("the part of this rank is wrong");
        });
    if (how == "abrupt" && ranks.rank() == 1)
      throw std::runtime_error("this rank broke down");
    MPI_Reduce(&ranks_of_one, &sum, 1, MPI_INT, MPI_SUM, 0, Ranks::comm()); // where the others wait
  }
  static constexpr int ranks_of_one = 1;
};

gestell::fem::FrameMatrices lattice_frame()
{
  gestell::test::Lattice lattice;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  return gestell::test::frame_of(lattice);
}

void tell(const std::string &what, bool agrees)
{
  std::cout << what << (agrees ? " agrees" : " differs") << std::endl;
}

/// The factor of all ranks against that of this one: solutions, modes, their number, and the same after its numbers
/// were released.
void compare_with_one_process(const Team &team)
{
  using namespace gestell::coupling;
  const auto            frame = lattice_frame();
  const auto            q1    = frame.interface_coordinates();
  const SparseCholesky  alone(frame.C, q1);
  TeamFactor            factor(team, {&frame.C, &frame.M, q1});
  const Eigen::MatrixXd loads = frame.M * Eigen::MatrixXd::Random(frame.M.rows(), 21);
  Eigen::MatrixXd       X = loads, Y = loads;
  Y(q1, Eigen::all).setZero();
  alone.solve_in_place(Y);
  tell("the factor", factor.factorise() && std::abs(factor.pivot_ratio() / alone.pivot_ratio() - 1.) < 1e-9);
  factor.solve_in_place(X);
  tell("the solution", (X - Y).norm() < 1e-11 * Y.norm());

  auto         search = factor.search("block-lanczos", {}, {});
  BlockLanczos lanczos(frame.M, std::make_unique<InverseByFactor>(alone, q1), {});
  search->find(12);
  lanczos.find(12);
  const LowestModes modes = search->modes(12), expected = lanczos.modes(12);
  tell("the frequencies", (modes.omega - expected.omega).norm() < 1e-9 * expected.omega.norm());
  tell("the mass of the modes",
       (modes.V.transpose() * frame.M * modes.V - Eigen::MatrixXd::Identity(12, 12)).norm() < 1e-9);
  tell("the shapes",
       (modes.V.transpose() * frame.C * modes.V).isApprox(Eigen::MatrixXd(modes.omega.cwiseAbs2().asDiagonal()), 1e-6));
  const double between = 0.5 * (modes.omega(6) + modes.omega(7));
  factor.release();
  tell("the number", factor.below(between).negative == 7);
  factor.factorise();
  auto rest = factor.search("block-lanczos", {}, {modes.omega.head(7), modes.V.leftCols(7), modes.bound.head(7)});
  rest->find(12);
  tell("the rest", (rest->modes(12).omega - expected.omega).norm() < 1e-9 * expected.omega.norm());
  for (const std::string eigensolver : {"krylov-schur", "lobpcg"})
  {
    auto other = factor.search(eigensolver, {}, {modes.omega.head(7), modes.V.leftCols(7), modes.bound.head(7)});
    other->find(12);
    const LowestModes others = other->modes(12);
    tell("the rest by " + eigensolver, (others.omega - expected.omega).norm() < 1e-9 * expected.omega.norm());
    tell("the mass by " + eigensolver,
         (others.V.transpose() * frame.M * others.V - Eigen::MatrixXd::Identity(12, 12)).norm() < 1e-7);
  }

  Eigen::SparseMatrix<double> given = frame.C;
  TeamFactor                  whole(team, {nullptr, nullptr, q1, &given});
  X = loads;
  whole.factorise();
  whole.solve_in_place(X);
  tell("the solution with the matrix given away", given.size() == 0 && (X - Y).norm() < 1e-11 * Y.norm());

  given = frame.C;
  given.coeffRef(250, 250) *= -1.;
  TeamFactor indefinite(team, {&given, nullptr, q1});
  tell("the place of what is not positive", !indefinite.factorise() && indefinite.failed() >= 0);
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

int lead(const std::string &how)
{
  Team::use();
  const Team *team = Team::of_this_run();
  if (how == "exhaust")
    exhaust_modes();
  if (how == "none")
    reduce_without_modes();
  if (how == "compare")
    compare_with_one_process(*team);
  try
  {
    std::cout << team->together(Trial{how}).sum << " ranks took part" << std::endl;
  }
  catch (const std::invalid_argument &error)
  {
    std::cout << "told: " << error.what() << std::endl;
  }
  const Trial next = team->together(Trial{"sound"}); // after a failure all are on speaking terms
  std::cout << "then " << next.sum << " ranks took part" << std::endl;
  team->ranks().order(0);
  return 0;
}

void follow(const Ranks &ranks)
{
  while (const int order = ranks.next_order())
    try
    {
      Trial trial;
      if (RankTask(order) == Trial::order)
        Team::carry_out(trial, ranks);
      else
        gestell::coupling::obey(order);
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
    lead(argc > 1 ? argv[1] : "sound");
  else
    follow(ranks);
  MPI_Finalize();
  return 0;
}
