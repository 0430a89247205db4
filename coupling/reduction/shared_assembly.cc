#include "coupling/reduction/shared_assembly.h"

#include "fem/cell_parts.h"
#include "fem/elasticity.h"
#include "fem/petsc_session.h"
#include "fem/weighing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gestell::coupling
{

namespace
{

using SparseMatrix = Eigen::SparseMatrix<double>;

/// What one rank gets, and the rows of its coordinates in the shared matrices.
struct Share
{
  fem::FramePart   part;
  std::vector<int> rows;
};

void send(const fem::Ranks &ranks, const Share &share, int to)
{
  const auto &[mesh, materials, lists] = share.part;
  std::vector<std::array<double, 3>> constants;
  for (const fem::Material &material : materials.materials)
    constants.push_back({material.E, material.nu, material.rho});
  ranks.send(mesh.points, to);
  ranks.send(mesh.cells, to);
  ranks.send(mesh.curved, to);
  ranks.send(mesh.hexahedra, to);
  ranks.send(constants, to);
  ranks.send(materials.of_cell, to);
  ranks.send(std::vector<int>{lists.n_free, lists.n_coordinates}, to);
  for (const std::vector<int> *list :
       {&lists.column, &lists.tied_row, &lists.tied, &lists.tie_begin, &lists.tie_column})
    ranks.send(*list, to);
  ranks.send(lists.tie_weight, to);
  ranks.send(share.rows, to);
}

Share receive(const fem::Ranks &ranks)
{
  Share share;
  auto &[mesh, materials, lists] = share.part;
  mesh.points                    = ranks.receive<fem::Point3>(0);
  mesh.cells                     = ranks.receive<std::array<int, 10>>(0);
  mesh.curved                    = ranks.receive<char>(0);
  mesh.hexahedra                 = ranks.receive<std::array<int, 27>>(0);
  for (const auto &[E, nu, rho] : ranks.receive<std::array<double, 3>>(0))
    materials.materials.push_back({E, nu, rho, ""});
  materials.of_cell   = ranks.receive<int>(0);
  const auto counts   = ranks.receive<int>(0);
  lists.n_free        = counts[0];
  lists.n_coordinates = counts[1];
  for (std::vector<int> *list : {&lists.column, &lists.tied_row, &lists.tied, &lists.tie_begin, &lists.tie_column})
    *list = ranks.receive<int>(0);
  lists.tie_weight = ranks.receive<double>(0);
  share.rows       = ranks.receive<int>(0);
  return share;
}

/// Rank 0: how cells, nodes and rows are divided, and the nodes of every rank.
struct Division
{
  std::vector<int>              part_of_cell;
  RowPlan                       rows;
  std::vector<std::vector<int>> nodes;
};

Division divide(const AssemblySource &source, int n_ranks)
{
  Division               division{fem::part_cells(source.mesh, n_ranks), {}, std::vector<std::vector<int>>(n_ranks)};
  const std::vector<int> part_of_node = fem::part_nodes(source.mesh, division.part_of_cell, n_ranks);
  // Coordinates that belong to no node, of interfaces mostly: to the last rank, since rank 0 has most to do.
  std::vector<int> rank_of(source.kinematics.n_coordinates(), n_ranks - 1);
  for (int i = 0; i < source.kinematics.n_displacements(); ++i)
    if (const int coordinate = source.kinematics.coordinate(i); coordinate >= 0)
      rank_of[coordinate] = part_of_node[i / 3];
  division.rows = plan_rows(rank_of, n_ranks);
  return division;
}

Share share_of(const AssemblySource &source, Division &division, int rank)
{
  Share share{fem::frame_part(source.mesh, source.materials, source.kinematics, division.part_of_cell, rank,
                              division.nodes[rank]),
              {}};
  for (const int coordinate : share.part.kinematics.coordinates)
    share.rows.push_back(division.rows.row_of[coordinate]);
  return share;
}

/// What the cells of one rank add up to.
struct PartSums
{
  SparseMatrix        C, M; // in the coordinates of the part
  fem::RigidEnergies  energies;
  Eigen::VectorXd     nodal_mass;
  fem::MassProperties whole;
};

PartSums sum_part(const fem::FramePart &part, const Eigen::Vector3d &middle)
{
  PartSums sums;
  if (part.mesh.n_cells() == 0)
    return sums;
  const fem::Kinematics kinematics(part.kinematics);
  {
    const fem::BlockMatrix C = fem::assemble_stiffness(part.mesh, part.materials);
    sums.energies            = fem::rigid_energies(part.mesh, C, middle);
    sums.C                   = kinematics.project(C);
  }
  const fem::BlockMatrix M = fem::assemble_mass(part.mesh, part.materials);
  sums.M                   = kinematics.project(M);
  sums.nodal_mass          = fem::nodal_mass(M);
  sums.whole               = fem::weigh(part.mesh, M);
  return sums;
}

/// Contributions to shared rows.
struct Entries
{
  std::vector<int>    row, column;
  std::vector<double> value;

  void add(const SparseMatrix &A, const std::vector<int> &rows)
  {
    for (int j = 0; j < A.outerSize(); ++j)
      for (SparseMatrix::InnerIterator a(A, j); a; ++a)
      {
        row.push_back(rows[a.row()]);
        column.push_back(rows[j]);
        value.push_back(a.value());
      }
  }
};

PetscOwned<Mat> sum_of(Entries entries, int n_rows, int n)
{
  const char *here = "assemble_on_ranks";
  Mat         A = nullptr, compact = nullptr;
  require_petsc(MatCreate(fem::Ranks::comm(), &A), here);
  PetscOwned<Mat> sum(A);
  require_petsc(MatSetSizes(A, n_rows, n_rows, n, n), here);
  require_petsc(MatSetType(A, MATMPIAIJ), here);
  require_petsc(MatSetPreallocationCOO(A, PetscCount(entries.row.size()), entries.row.data(), entries.column.data()),
                here);
  require_petsc(MatSetValuesCOO(A, entries.value.data(), INSERT_VALUES), here);
  entries = {};
  // A copy leaves behind what would be needed to add once more, which is larger than the matrix.
  require_petsc(MatDuplicate(A, MAT_COPY_VALUES, &compact), here);
  sum.reset(compact);
  MatSetOption(compact, MAT_SYMMETRIC, PETSC_TRUE);
  return sum;
}

/// Rows of this rank, compressed.
struct Rows
{
  std::vector<int>    begin{0}, column;
  std::vector<double> value;
};

Rows own_rows(Mat A)
{
  Rows rows;
  for_each_own_row(A, "assemble_on_ranks",
                   [&](PetscInt, PetscInt count, const PetscInt *columns, const PetscScalar *values)
                   {
                     rows.column.insert(rows.column.end(), columns, columns + count);
                     rows.value.insert(rows.value.end(), values, values + count);
                     rows.begin.push_back(int(rows.column.size()));
                   });
  return rows;
}

/// Rank 0: the whole of A in the order of q; empty on others.
SparseMatrix collect(const fem::Ranks &ranks, Mat A, const RowPlan &plan)
{
  Rows own;
  ranks.agree([&] { own = own_rows(A); });
  if (!ranks.first())
  {
    ranks.send(own.begin, 0);
    ranks.send(own.column, 0);
    ranks.send(own.value, 0);
    return {};
  }
  std::vector<std::vector<int>> begin(ranks.size());
  begin[0] = own.begin;
  for (int other = 1; other < ranks.size(); ++other)
    begin[other] = ranks.receive<int>(other);

  const int    n = int(plan.row_of.size());
  SparseMatrix whole(n, n);
  int         *outer = whole.outerIndexPtr();
  for (int rank = 0; rank < ranks.size(); ++rank)
    for (int i = plan.begin[rank]; i < plan.begin[rank + 1]; ++i)
      outer[plan.coordinate_of[i] + 1] = begin[rank][i - plan.begin[rank] + 1] - begin[rank][i - plan.begin[rank]];
  for (int i = 0; i < n; ++i)
    outer[i + 1] += outer[i];
  whole.resizeNonZeros(outer[n]);

  std::vector<std::pair<int, double>> entries;
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    if (rank > 0)
    {
      own.column = ranks.receive<int>(rank);
      own.value  = ranks.receive<double>(rank);
    }
    for (int i = plan.begin[rank]; i < plan.begin[rank + 1]; ++i)
    {
      const int local = i - plan.begin[rank];
      entries.clear();
      for (int k = begin[rank][local]; k < begin[rank][local + 1]; ++k)
        entries.emplace_back(plan.coordinate_of[own.column[k]], own.value[k]);
      std::sort(entries.begin(), entries.end());
      int at = outer[plan.coordinate_of[i]];
      for (const auto &[coordinate, value] : entries)
      {
        whole.innerIndexPtr()[at] = coordinate;
        whole.valuePtr()[at++]    = value;
      }
    }
  }
  return whole;
}

using Weights = std::array<double, 13>; // mass, centre, inertia

Weights plain(const fem::MassProperties &of)
{
  Weights weights{of.mass};
  std::copy_n(of.centre.data(), 3, weights.begin() + 1);
  std::copy_n(of.inertia.data(), 9, weights.begin() + 4);
  return weights;
}

fem::MassProperties properties(const Weights &weights)
{
  return {weights[0], Eigen::Vector3d(weights.data() + 1), Eigen::Matrix3d(weights.data() + 4)};
}

/// Rank 0: masses of nodes and of the whole, and the energies.
void collect(const fem::Ranks &ranks, const PartSums &own, const std::vector<std::vector<int>> &nodes, int n_nodes,
             fem::CellSums &sums)
{
  fem::RigidEnergies all;
  MPI_Reduce(own.energies.energy.data(), all.energy.data(), 6, MPI_DOUBLE, MPI_SUM, 0, fem::Ranks::comm());
  MPI_Reduce(own.energies.cancelling.data(), all.cancelling.data(), 6, MPI_DOUBLE, MPI_SUM, 0, fem::Ranks::comm());
  if (!ranks.first())
  {
    ranks.send(std::vector<double>(own.nodal_mass.begin(), own.nodal_mass.end()), 0);
    ranks.send(std::vector<Weights>{plain(own.whole)}, 0);
    return;
  }
  sums.rigid_energy = all.share();
  sums.whole        = own.whole;
  sums.nodal_mass   = Eigen::VectorXd::Zero(n_nodes);
  sums.nodal_mass(nodes[0]) += own.nodal_mass;
  for (int other = 1; other < ranks.size(); ++other)
  {
    const std::vector<double> mass = ranks.receive<double>(other);
    for (std::size_t k = 0; k < mass.size(); ++k)
      sums.nodal_mass(nodes[other][k]) += mass[k];
    sums.whole.add(properties(ranks.receive<Weights>(other).front()));
  }
}

} // namespace

std::shared_ptr<const SharedMatrices> assemble_on_ranks(const fem::Ranks &ranks, const AssemblySource *source,
                                                        fem::CellSums &sums)
{
  fem::petsc_session();
  Division              division;
  std::array<double, 3> middle{};
  ranks.agree(
      [&]
      {
        if (!source)
          return;
        division                                   = divide(*source, ranks.size());
        Eigen::Map<Eigen::Vector3d>(middle.data()) = fem::middle_of_nodes(source->mesh);
      });
  ranks.broadcast(middle);
  std::vector<int> begin = division.rows.begin;
  begin.resize(ranks.size() + 1);
  for (int &first : begin)
    ranks.broadcast(first);

  if (source)
    for (int other = 1; other < ranks.size(); ++other)
      send(ranks, share_of(*source, division, other), other);
  const Share share = source ? share_of(*source, division, 0) : receive(ranks);

  PartSums own;
  Entries  of_C, of_M;
  ranks.agree(
      [&]
      {
        own = sum_part(share.part, Eigen::Vector3d(middle.data()));
        of_C.add(own.C, share.rows);
        of_M.add(own.M, share.rows);
        own.C = own.M = {};
        if (!source)
          return;
        of_C.add(source->C_beside, division.rows.row_of);
        of_M.add(source->M_beside, division.rows.row_of);
      });
  const int       n_rows = begin[ranks.rank() + 1] - begin[ranks.rank()];
  PetscOwned<Mat> C = sum_of(std::move(of_C), n_rows, begin.back()), M = sum_of(std::move(of_M), n_rows, begin.back());
  collect(ranks, own, division.nodes, source ? source->mesh.n_nodes() : 0, sums);
  sums.C = collect(ranks, C.get(), division.rows);
  sums.M = collect(ranks, M.get(), division.rows);
  return std::make_shared<const SharedMatrices>(ranks, std::move(begin), std::move(division.rows.row_of), std::move(C),
                                                std::move(M));
}

} // namespace gestell::coupling
