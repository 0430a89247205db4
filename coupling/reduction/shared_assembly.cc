#include "coupling/reduction/shared_assembly.h"

#include "fem/part_sums.h"
#include "fem/petsc_session.h"

#include <algorithm>
#include <array>
#include <tuple>
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
  const auto &[mesh, materials, lists, own_nodes, own_coordinates] = share.part;
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
  for (const std::vector<int> *list : {&own_nodes, &own_coordinates, &share.rows})
    ranks.send(*list, to);
}

Share receive(const fem::Ranks &ranks)
{
  Share share;
  auto &[mesh, materials, lists, own_nodes, own_coordinates] = share.part;
  mesh.points                                                = ranks.receive<fem::Point3>(0);
  mesh.cells                                                 = ranks.receive<std::array<int, 10>>(0);
  mesh.curved                                                = ranks.receive<char>(0);
  mesh.hexahedra                                             = ranks.receive<std::array<int, 27>>(0);
  for (const auto &[E, nu, rho] : ranks.receive<std::array<double, 3>>(0))
    materials.materials.push_back({E, nu, rho, ""});
  materials.of_cell   = ranks.receive<int>(0);
  const auto counts   = ranks.receive<int>(0);
  lists.n_free        = counts[0];
  lists.n_coordinates = counts[1];
  for (std::vector<int> *list : {&lists.column, &lists.tied_row, &lists.tied, &lists.tie_begin, &lists.tie_column})
    *list = ranks.receive<int>(0);
  lists.tie_weight = ranks.receive<double>(0);
  for (std::vector<int> *list : {&own_nodes, &own_coordinates, &share.rows})
    *list = ranks.receive<int>(0);
  return share;
}

/// Rank 0: how nodes and rows are divided.
struct Division
{
  fem::FrameDivision frame;
  RowPlan            rows;
};

Division divide(const AssemblySource &source, int n_ranks)
{
  Division division{fem::divide(source.mesh, source.kinematics, n_ranks), {}};
  division.rows = plan_rows(division.frame.part_of_coordinate, n_ranks);
  return division;
}

Share share_of(const AssemblySource &source, const Division &division, int rank)
{
  std::vector<int> nodes;
  Share share{fem::frame_part(source.mesh, source.materials, source.kinematics, division.frame, rank, nodes), {}};
  for (const int coordinate : share.part.kinematics.coordinates)
    share.rows.push_back(division.rows.row_of[coordinate]);
  return share;
}

/// Columns numbered as shared rows, and ascending.
fem::CompressedRows renumbered(fem::CompressedRows rows, const std::vector<int> &row_of)
{
  std::vector<std::pair<int, double>> entries;
  for (int i = 0; i < rows.n_rows(); ++i)
  {
    entries.clear();
    for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
      entries.emplace_back(row_of[rows.column[k]], rows.value[k]);
    std::sort(entries.begin(), entries.end());
    for (std::size_t k = 0; k < entries.size(); ++k)
      std::tie(rows.column[rows.begin[i] + k], rows.value[rows.begin[i] + k]) = entries[k];
  }
  return rows;
}

/// Rank 0: masses of nodes and of the whole, and the energies.
void collect(const fem::Ranks &ranks, const fem::PartSums &own, const AssemblySource *source, const Division &division,
             const Eigen::Vector3d &middle, fem::CellSums &sums)
{
  fem::RigidEnergies all;
  MPI_Reduce(own.energies.energy.data(), all.energy.data(), 6, MPI_DOUBLE, MPI_SUM, 0, fem::Ranks::comm());
  MPI_Reduce(own.energies.cancelling.data(), all.cancelling.data(), 6, MPI_DOUBLE, MPI_SUM, 0, fem::Ranks::comm());
  const auto &[mass, moment] = own.masses;
  if (!ranks.first())
  {
    ranks.send(std::vector<double>(mass.data(), mass.data() + mass.size()), 0);
    ranks.send(std::vector<double>(moment.data(), moment.data() + moment.size()), 0);
    return;
  }
  const int                        n_nodes = source->mesh.n_nodes();
  fem::NodalMasses                 masses{Eigen::VectorXd(n_nodes), Eigen::Matrix3Xd(3, n_nodes)};
  std::vector<std::vector<double>> mass_of(ranks.size()), moment_of(ranks.size());
  mass_of[0].assign(mass.data(), mass.data() + mass.size());
  moment_of[0].assign(moment.data(), moment.data() + moment.size());
  for (int other = 1; other < ranks.size(); ++other)
  {
    mass_of[other]   = ranks.receive<double>(other);
    moment_of[other] = ranks.receive<double>(other);
  }
  std::vector<std::size_t> next(ranks.size(), 0); // every rank has its nodes in the order of the mesh
  for (int node = 0; node < n_nodes; ++node)
  {
    const int         rank  = division.frame.part_of_node[node];
    const std::size_t k     = next[rank]++;
    masses.mass[node]       = mass_of[rank][k];
    masses.moment.col(node) = Eigen::Map<const Eigen::Vector3d>(&moment_of[rank][3 * k]);
  }
  sums.rigid_energy = all.share();
  sums.whole        = fem::weigh(source->mesh, masses, middle);
  sums.nodal_mass   = std::move(masses.mass);
}

} // namespace

std::shared_ptr<const SharedMatrices> assemble_on_ranks(const fem::Ranks &ranks, const AssemblySource *source,
                                                        fem::CellSums &sums)
{
  fem::petsc_session();
  Division              division;
  std::array<double, 3> origin{};
  ranks.agree(
      [&]
      {
        if (!source)
          return;
        division                                   = divide(*source, ranks.size());
        Eigen::Map<Eigen::Vector3d>(origin.data()) = fem::middle_of_nodes(source->mesh);
      });
  ranks.broadcast(origin);
  const Eigen::Vector3d middle(origin.data());
  std::vector<int>      begin = division.rows.begin;
  begin.resize(ranks.size() + 1);
  for (int &first : begin)
    ranks.broadcast(first);

  if (source)
    for (int other = 1; other < ranks.size(); ++other)
      send(ranks, share_of(*source, division, other), other);
  Share         share = source ? share_of(*source, division, 0) : receive(ranks);
  fem::PartSums own;
  ranks.agree(
      [&]
      {
        own   = fem::sum_part(share.part, middle);
        own.C = renumbered(std::move(own.C), share.rows);
        own.M = renumbered(std::move(own.M), share.rows);
        share = {};
      });
  collect(ranks, own, source, division, middle, sums);
  const auto shared = [&](fem::CompressedRows rows, const SparseMatrix *beside, SparseMatrix &whole)
  {
    whole                  = collected(ranks, rows, division.rows);
    const auto rows_beside = dealt_out(ranks, beside, division.rows);
    if (!rows_beside.value.empty())
      rows = sum(rows, rows_beside);
    return shared_matrix(rows, begin.back());
  };
  PetscOwned<Mat> C = shared(std::move(own.C), source ? &source->C_beside : nullptr, sums.C);
  PetscOwned<Mat> M = shared(std::move(own.M), source ? &source->M_beside : nullptr, sums.M);
  return std::make_shared<const SharedMatrices>(ranks, std::move(begin), std::move(division.rows.row_of), std::move(C),
                                                std::move(M));
}

} // namespace gestell::coupling
