// The frame of a scene once by rank 0 alone and once by all ranks: the same numbers to the last bit, or a message and
// exit code 1.  Arguments: the scene, and entries to set.  Called by mpi_test.

#include "apps/scene/scene.h"
#include "coupling/reduction/shared_assembly.h"
#include "coupling/reduction/team.h"
#include "fem/discretisation.h"
#include "fem/mesher.h"

#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using gestell::coupling::Order;
using gestell::coupling::SharedMatrices;
using gestell::coupling::Team;
using gestell::fem::Ranks;
using SparseMatrix = Eigen::SparseMatrix<double>;

/// Rank 0: the matrix whose rows lie on all ranks.
SparseMatrix whole_of(const SharedMatrices &shared, Mat A)
{
  const Ranks               &ranks = shared.ranks();
  gestell::coupling::RowPlan plan{std::vector<int>(ranks.size() + 1, 0), shared.row_of(), shared.row_of()};
  const int                  last = shared.last_row();
  MPI_Gather(&last, 1, MPI_INT, plan.begin.data() + 1, 1, MPI_INT, 0, Ranks::comm());
  for (std::size_t i = 0; i < plan.row_of.size(); ++i)
    plan.coordinate_of[plan.row_of[i]] = int(i);
  return collected(ranks, gestell::coupling::own_rows(A), plan);
}

struct Assemble
{
  static constexpr Order                   order  = Order(1000);
  const gestell::coupling::AssemblySource *source = nullptr;
  gestell::fem::CellSums                   sums;
  SparseMatrix                             C, M; // of the rows that the ranks keep

  void run(const Ranks &ranks)
  {
    const auto shared = assemble_on_ranks(ranks, source, sums);
    C                 = whole_of(*shared, shared->C());
    M                 = whole_of(*shared, shared->M());
    std::vector<int> rows(ranks.size());
    const int        own = shared->last_row() - shared->first_row();
    MPI_Gather(&own, 1, MPI_INT, rows.data(), 1, MPI_INT, 0, Ranks::comm());
    for (int rank = 0; ranks.first() && rank < ranks.size(); ++rank)
      std::cout << "rank " << rank << " has " << rows[rank] << " rows\n";
  }
};

class Assembly final : public gestell::fem::CellAssembly
{
public:
  gestell::fem::CellSums sum(const gestell::fem::QuadraticMesh &mesh, const gestell::fem::CellMaterials &materials,
                             const gestell::fem::Kinematics &kinematics, const SparseMatrix &C_beside,
                             const SparseMatrix &M_beside) const override
  {
    const gestell::coupling::AssemblySource source{mesh, materials, kinematics, C_beside, M_beside};
    Assemble                                task;
    task.source = &source;
    Team::of_this_run()->together(task);
    C = task.C;
    M = task.M;
    return task.sums;
  }
  mutable SparseMatrix C, M;
};

bool same(const SparseMatrix &A, const SparseMatrix &B)
{
  if (A.rows() != B.rows() || A.nonZeros() != B.nonZeros())
    return false;
  for (int j = 0; j < B.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(A, j), b(B, j); b; ++a, ++b)
      if (a.row() != b.row() || a.value() != b.value())
        return false;
  return true;
}

/// Number of differences.
int compare(const gestell::fem::FrameMatrices &ranks, const gestell::fem::FrameMatrices &alone, const Assembly &rows)
{
  int        differences = 0;
  const auto tell        = [&](const char *what, bool equal)
  {
    differences += !equal;
    std::cout << what << (equal ? " is the same" : " differs") << std::endl;
  };
  tell("C", same(ranks.C, alone.C));
  tell("M", same(ranks.M, alone.M));
  tell("B", same(ranks.B, alone.B));
  tell("C on the ranks", same(rows.C, alone.C));
  tell("M on the ranks", same(rows.M, alone.M));
  tell("load", ranks.acceleration_load == alone.acceleration_load);
  tell("mass", ranks.mass == alone.mass && ranks.centre == alone.centre);
  tell("inertia", ranks.facts.whole.inertia == alone.facts.whole.inertia);
  return differences;
}

int lead(const std::string &path, const std::vector<std::string> &overrides)
{
  Team::use();
  const auto specification = gestell::apps::read_scene(path, overrides).frame.geometry;
  const auto mesh          = gestell::fem::make_mesh(specification);
  const auto alone         = discretise(mesh, specification);
  Assembly   rows;
  const auto ranks = discretise(mesh, specification, &rows);
  Team::of_this_run()->ranks().order(0);
  std::cout << alone.C.rows() << " coordinates" << std::endl;
  return compare(ranks, alone, rows) > 0;
}

} // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const Ranks ranks;
  int         code = 0;
  if (ranks.first())
    try
    {
      code = lead(argv[1], std::vector<std::string>(argv + 2, argv + argc));
    }
    catch (const std::exception &error)
    {
      ranks.abort(error.what());
    }
  else
    while (ranks.next_order() != 0)
    {
      Assemble task;
      Team::carry_out(task, ranks);
    }
  MPI_Finalize();
  return code;
}
