#include "coupling/reduction/team_assembly.h"

#include "coupling/reduction/team_tasks.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

/// Rank 0's hand on matrices that all ranks have.
class TeamMatrices final : public fem::RowsOnRanks
{
public:
  TeamMatrices(const Team &team, int number) : number(number), team_(team) {}
  ~TeamMatrices() override
  {
    ForgetTask forget;
    forget.number = number;
    team_.together(forget);
  }
  TeamMatrices(const TeamMatrices &)            = delete;
  TeamMatrices &operator=(const TeamMatrices &) = delete;

  const int number;

private:
  const Team &team_;
};

class TeamAssembly final : public fem::CellAssembly
{
public:
  explicit TeamAssembly(const Team &team) : team_(team) {}

  fem::CellSums sum(const fem::QuadraticMesh &mesh, const fem::CellMaterials &materials,
                    const fem::Kinematics &kinematics, const Eigen::SparseMatrix<double> &C_beside,
                    const Eigen::SparseMatrix<double> &M_beside) const override
  {
    require_work_for_all(team_, mesh.n_cells(), "cells");
    const AssemblySource source{mesh, materials, kinematics, C_beside, M_beside};
    AssembleTask         task;
    task.number = Team::next_number();
    task.source = &source;
    team_.together(task);
    task.sums.rows = std::make_shared<const TeamMatrices>(team_, task.number);
    return std::move(task.sums);
  }

private:
  const Team &team_;
};

} // namespace

const fem::CellAssembly *team_assembly()
{
  const Team *const team = Team::of_this_run();
  if (!team)
    return nullptr;
  static const TeamAssembly assembly(*team);
  return &assembly;
}

int number_of(const fem::RowsOnRanks *rows)
{
  const auto *const matrices = dynamic_cast<const TeamMatrices *>(rows);
  return matrices ? matrices->number : 0;
}

void require_work_for_all(const Team &team, int parts, const char *called)
{
  const int n_ranks = team.ranks().size();
  if (n_ranks > parts)
    throw std::invalid_argument(
        "mpirun: " + std::to_string(n_ranks) + " ranks for a frame of " + std::to_string(parts) + " " + called +
        ", but each rank needs at least one; start " + std::to_string(parts) +
        " at most, or mesh more finely.  Some thousand cells per rank " + "are worth the effort.");
}

} // namespace gestell::coupling
