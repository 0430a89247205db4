// Frequencies of a clamped CAD frame and the CPU time they took; with --deck the same mesh as an input file of
// CalculiX, with --eigensolvers by factors and eigensolvers of ours and of PETSc and SLEPc in turn.
#include "coupling/algebra/openblas.h"
#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/supports.h"
#include "fem/mesh/mesher.h"
#include "fem/parallel/petsc_session.h"
#include "fem/recovery/discretisation.h"

#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>

namespace
{

using namespace gestell;

double cpu_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Steel, clamped at all plane faces that look down at z = 0.
fem::FrameSpecification steel_frame(const std::string &cad, double size)
{
  fem::FrameSpecification frame;
  frame.cad       = cad;
  frame.mesh.size = size;
  frame.material  = {210e9, 0.3, 7850., "", "steel"};
  fem::SurfaceSelector feet;
  feet.plane             = fem::SurfaceSelector::Plane{{0, 0, -1}, {0, 0, 0}};
  feet.faces             = 0; // any number
  frame.surfaces["feet"] = feet;
  fem::Support held;
  held.name      = "feet";
  held.surfaces  = {"feet"};
  frame.supports = {held};
  return frame;
}

/// C3D10 counts the middles of 12, 23, 31, 14, 24, 34; which local nodes those are is asked of the positions.
std::array<int, 10> order_of_calculix(const fem::QuadraticMesh &mesh)
{
  constexpr int       ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  const auto         &cell       = mesh.cells.front();
  const auto          at         = [&](int a, int d) { return mesh.points[cell[a]][d]; };
  std::array<int, 10> order{0, 1, 2, 3};
  for (int edge = 0; edge < 6; ++edge)
  {
    double nearest = INFINITY;
    for (int a = 4; a < 10; ++a)
    {
      double distance = 0.;
      for (int d = 0; d < 3; ++d)
        distance += std::pow(at(a, d) - 0.5 * (at(ends[edge][0], d) + at(ends[edge][1], d)), 2);
      if (distance < nearest)
        nearest = distance, order[4 + edge] = a;
    }
  }
  return order;
}

void write_deck(const std::string &file, const fem::Mesh &mesh, const fem::FrameSpecification &frame, int n_modes)
{
  const fem::QuadraticMesh quadratic = fem::quadratic_mesh(mesh);
  const auto               order     = order_of_calculix(quadratic);
  std::ofstream            deck(file);
  deck.precision(13);
  deck << "*NODE, NSET=ALL\n";
  for (int i = 0; i < quadratic.n_nodes(); ++i)
    deck << i + 1 << ", " << quadratic.points[i][0] << ", " << quadratic.points[i][1] << ", " << quadratic.points[i][2]
         << '\n';
  deck << "*ELEMENT, TYPE=C3D10, ELSET=SOLID\n";
  for (std::size_t cell = 0; cell < quadratic.cells.size(); ++cell)
  {
    deck << cell + 1;
    for (const int a : order)
      deck << ", " << quadratic.cells[cell][a] + 1;
    deck << '\n';
  }
  deck << "*NSET, NSET=FEET\n";
  for (const auto &support : fem::find_supports(mesh, quadratic, frame.supports))
    for (const int node : support.patch.nodes)
      deck << node + 1 << '\n';
  deck << "*BOUNDARY\nFEET, 1, 3\n*MATERIAL, NAME=STEEL\n*ELASTIC\n"
       << frame.material.E << ", " << frame.material.nu << "\n*DENSITY\n"
       << frame.material.rho << "\n*SOLID SECTION, ELSET=SOLID, MATERIAL=STEEL\n*STEP\n*FREQUENCY\n"
       << n_modes << "\n*END STEP\n";
  if (!deck.flush())
    throw std::runtime_error(file + ": cannot be written");
}

void solve(const fem::Mesh &mesh, const fem::FrameSpecification &frame, int n_modes, double meshing)
{
  const double               start    = cpu_seconds();
  const fem::FrameMatrices   matrices = fem::discretise(mesh, frame);
  const double               assembly = cpu_seconds() - start;
  coupling::ReductionOptions options;
  options.n_modes             = n_modes;
  double      began           = cpu_seconds();
  std::string phase           = "";
  const auto  tell_phase_ends = [&](const std::string &next, double)
  {
    if (!phase.empty())
      std::cout << "cpu " << phase << " [s] " << cpu_seconds() - began << '\n';
    phase = next;
    began = cpu_seconds();
  };
  const coupling::ReducedFrame reduced = coupling::reduce_frame(matrices, options, tell_phase_ends);
  tell_phase_ends("", 0.);
  std::cout << "coordinates " << matrices.C.rows() << "\ncpu mesh [s] " << meshing << "\ncpu assembly [s] " << assembly
            << "\ncpu without mesh [s] " << cpu_seconds() - start << '\n';
  for (const std::string &note : reduced.notes)
    std::cout << "note " << note << '\n';
  for (const std::string &statement : reduced.statements)
    std::cout << statement << '\n';
  std::cout.precision(12);
  for (Eigen::Index j = 0; j < reduced.omega0.size(); ++j)
    std::cout << "frequency " << j + 1 << " [Hz] " << reduced.omega0(j) / 6.283185307179586 << '\n';
}

/// CPU seconds of `work`, told with its name.
template <typename Work>
double tell_time(const std::string &name, const Work &work)
{
  const double began = cpu_seconds();
  work();
  const double seconds = cpu_seconds() - began;
  std::cout << "cpu " << name << " [s] " << seconds << std::endl;
  return seconds;
}

/// Factor of C by a solver of PETSc, and solutions one by one and eight at once.
void time_factor(Mat C, const std::string &solver)
{
  using coupling::require_petsc;
  coupling::PetscOwned<Mat> factor;
  tell_time(solver + ": factor",
            [&]
            {
              Mat           F = nullptr;
              MatFactorInfo info;
              MatFactorInfoInitialize(&info);
              require_petsc(MatGetFactor(C, solver.c_str(), MAT_FACTOR_CHOLESKY, &F), "bench");
              factor.reset(F);
              require_petsc(MatCholeskyFactorSymbolic(F, C, nullptr, &info), "bench");
              require_petsc(MatCholeskyFactorNumeric(F, C, &info), "bench");
            });
  for (const int columns : {1, 8})
  {
    PetscInt n = 0;
    MatGetSize(C, &n, nullptr);
    Mat f = nullptr, x = nullptr;
    MatCreateSeqDense(PETSC_COMM_SELF, n, columns, nullptr, &f);
    MatDuplicate(f, MAT_DO_NOT_COPY_VALUES, &x);
    const coupling::PetscOwned<Mat> loads(f), motions(x);
    MatSetRandom(f, nullptr);
    tell_time(solver + ": solution for " + std::to_string(columns),
              [&] { require_petsc(MatMatSolve(factor.get(), f, x), "bench"); });
  }
}

void compare_eigensolvers(const fem::FrameMatrices &frame, int n_modes)
{
  fem::petsc_session();
  coupling::register_own_types();
  const int n     = int(frame.C.rows());
  auto     &whole = const_cast<fem::SparseMatrix &>(frame.C); // PETSc promises not to change it
  Mat       C     = nullptr;
  MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, whole.outerIndexPtr(), whole.innerIndexPtr(), whole.valuePtr(), &C);
  const coupling::PetscOwned<Mat> owned(C);
  MatSetOption(C, MAT_SYMMETRIC, PETSC_TRUE);
  for (const char *solver : {coupling::own_factor, "cholmod"})
    time_factor(C, solver);

  std::cout << "coordinates " << n << '\n';
  const auto search = [&](std::shared_ptr<const coupling::InverseStiffness> inverse, const std::string &eigensolver)
  {
    const auto modes =
        coupling::search_modes(MPI_COMM_SELF, {std::move(inverse), &frame.M, &frame.C}, eigensolver, {}, {});
    modes->find(n_modes);
    std::cout << "highest frequency [Hz] " << modes->modes(n_modes).omega(n_modes - 1) / 6.283185307179586 << '\n';
  };
  const coupling::SparseCholesky factor(frame.C, {});
  for (const char *eigensolver : {"block-lanczos", "krylov-schur"})
    tell_time(std::string("gestell's factor, without it: ") + eigensolver,
              [&] { search(std::make_shared<coupling::InverseByFactor>(factor), eigensolver); });
  PetscOptionsSetValue(nullptr, "-reduction_st_pc_factor_mat_solver_type", "cholmod");
  for (const char *eigensolver : {"block-lanczos", "krylov-schur"})
    tell_time(std::string("cholmod, with its factor: ") + eigensolver,
              [&] { search(std::make_shared<coupling::InverseByFactor>(factor), eigensolver); });
}

} // namespace

int main(int n_arguments, char **arguments)
{
  const std::string wish = n_arguments > 4 ? arguments[4] : "";
  if (n_arguments != 4 && !(n_arguments == 6 && wish == "--deck") && !(n_arguments == 5 && wish == "--eigensolvers"))
  {
    std::cerr << "usage: gestell_frame_bench CAD SIZE_IN_M MODES [--deck FILE.inp | --eigensolvers]\n";
    return 2;
  }
  try
  {
    coupling::use_one_blas_thread();
    const fem::FrameSpecification frame   = steel_frame(arguments[1], std::stod(arguments[2]));
    const int                     n_modes = std::stoi(arguments[3]);
    const fem::Mesh               mesh    = fem::make_mesh(frame);
    const double                  meshing = cpu_seconds();
    if (n_arguments == 6)
      write_deck(arguments[5], mesh, frame, n_modes);
    else if (!wish.empty())
      compare_eigensolvers(fem::discretise(mesh, frame), n_modes);
    else
      solve(mesh, frame, n_modes, meshing);
  }
  catch (const std::exception &error)
  {
    std::cerr << "gestell_frame_bench: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
