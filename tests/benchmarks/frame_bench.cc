// Frequencies of a clamped CAD frame and the CPU time they took; with --deck the same mesh as an input file of
// CalculiX, with --factors by each factor and eigensolver in turn; likewise for a grid of hexahedra.
#include "coupling/algebra/openblas.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/factors/make_factor.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/supports.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"

#include <cmath>
#include <cstdio>
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

/// Trilinear hexahedra of steel, 10 mm wide, clamped at x = 0; lumped masses: 81 entries in a row of C.
fem::FrameMatrices grid(int nx, int ny, int nz)
{
  constexpr double            h = 0.01, E = 210e9, nu = 0.3, rho = 7850.;
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  D.topLeftCorner<3, 3>().setConstant(nu);
  D.topLeftCorner<3, 3>().diagonal().setConstant(1. - nu);
  D.bottomRightCorner<3, 3>().diagonal().setConstant(0.5 - nu);
  D *= E / ((1. + nu) * (1. - 2. * nu));
  Eigen::Matrix<double, 24, 24> K = Eigen::Matrix<double, 24, 24>::Zero();
  for (int g = 0; g < 8; ++g) // Gauss points
  {
    Eigen::Matrix<double, 6, 24> strain = Eigen::Matrix<double, 6, 24>::Zero();
    for (int a = 0; a < 8; ++a)
    {
      double gradient[3];
      for (int d = 0; d < 3; ++d)
      {
        gradient[d] = 2. / h * ((a >> d & 1) ? 0.5 : -0.5);
        for (int e = 0; e < 3; ++e)
          if (e != d)
            gradient[d] *= 0.5 * (1. + ((a >> e & 1) == (g >> e & 1) ? 1. : -1.) / std::sqrt(3.));
      }
      for (int d = 0; d < 3; ++d)
      {
        const int e              = (d + 1) % 3;
        strain(d, 3 * a + d)     = gradient[d];
        strain(3 + d, 3 * a + d) = gradient[e];
        strain(3 + d, 3 * a + e) = gradient[d];
      }
    }
    K += strain.transpose() * D * strain * (h * h * h / 8.);
  }
  const auto node = [&](int i, int j, int k) { return (i - 1) + nx * (j + (ny + 1) * k); }; // negative: clamped
  const int  n    = 3 * nx * (ny + 1) * (nz + 1);
  // entries by rows: couplings of a node to those around it
  std::vector<Eigen::Triplet<double>> C, M;
  C.reserve(std::size_t(nx) * ny * nz * 576);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (int a = 0; a < 8; ++a)
        {
          if (i + (a & 1) == 0)
            continue;
          const int p = node(i + (a & 1), j + (a >> 1 & 1), k + (a >> 2 & 1));
          for (int d = 0; d < 3; ++d)
            M.emplace_back(3 * p + d, 3 * p + d, rho * h * h * h / 8.);
          for (int b = 0; b < 8; ++b)
            if (i + (b & 1) > 0)
              for (int d = 0; d < 9; ++d)
                C.emplace_back(3 * p + d / 3, 3 * node(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2 & 1)) + d % 3,
                               K(3 * a + d / 3, 3 * b + d % 3));
        }
  fem::FrameMatrices frame;
  frame.C.resize(n, n);
  frame.M.resize(n, n);
  frame.C.setFromTriplets(C.begin(), C.end());
  frame.M.setFromTriplets(M.begin(), M.end());
  return frame;
}

/// Each factor: its time, solutions of 1, 8 and 16 columns, the modes by each eigensolver, their number by inertia.
void compare_factors(const fem::FrameMatrices &frame, int n_modes)
{
  const int n = int(frame.C.rows());
  std::cout << "coordinates " << n << '\n';
  for (const std::string name : {"gestell", "cholmod", "mumps"})
  {
    const auto factor = coupling::make_factor(name, {&frame.C, &frame.M});
    tell_time(name + ": factor", [&] { factor->factorise(); });
    for (const int columns : {1, 8, 16})
    {
      Eigen::MatrixXd X = Eigen::MatrixXd::Random(n, columns);
      tell_time(name + ": solution for " + std::to_string(columns), [&] { factor->solve_in_place(X); });
    }
    double between = 0.;
    for (const char *eigensolver : {"block-lanczos", "krylov-schur"})
      tell_time(name + ": " + eigensolver,
                [&]
                {
                  const auto search = factor->search(eigensolver, {}, {});
                  search->find(n_modes);
                  const auto gap = search->gap_above(n_modes);
                  between        = 0.5 * (gap.low + gap.high);
                  std::cout << "highest frequency [Hz] "
                            << search->modes(n_modes).omega(n_modes - 1) / 6.283185307179586 << ", modes below the gap "
                            << gap.below << '\n';
                });
    factor->release();
    tell_time(name + ": number of modes", [&] { std::cout << "counted " << factor->below(between).negative << '\n'; });
  }
}

/// Size of the factor by its analysis alone.
void analyse(const fem::FrameMatrices &frame)
{
  tell_time("analysis of " + std::to_string(frame.C.rows()) + " coordinates",
            [&]
            {
              const auto factor = coupling::SparseCholesky::without_numbers(frame.C, {});
              std::cout << "entries of the factor " << factor.entries() << '\n';
            });
}

} // namespace

int main(int n_arguments, char **arguments)
{
  const std::string wish = n_arguments > 4 ? arguments[4] : "";
  int               nx = 0, ny = 0, nz = 0;
  const bool        is_grid = n_arguments == 4 && std::sscanf(arguments[1], "grid:%dx%dx%d", &nx, &ny, &nz) == 3;
  if (n_arguments != 4 && !(n_arguments == 6 && wish == "--deck") && !(n_arguments == 5 && wish == "--factors"))
  {
    std::cerr << "usage: gestell_frame_bench CAD SIZE_IN_M MODES [--deck FILE.inp | --factors]\n"
                 "       gestell_frame_bench grid:NXxNYxNZ factors|analysis MODES\n";
    return 2;
  }
  try
  {
    coupling::use_one_blas_thread();
    if (is_grid)
    {
      if (arguments[2] == std::string("analysis"))
        analyse(grid(nx, ny, nz));
      else
        compare_factors(grid(nx, ny, nz), std::stoi(arguments[3]));
      return 0;
    }
    const fem::FrameSpecification frame   = steel_frame(arguments[1], std::stod(arguments[2]));
    const int                     n_modes = std::stoi(arguments[3]);
    const fem::Mesh               mesh    = fem::make_mesh(frame);
    const double                  meshing = cpu_seconds();
    if (n_arguments == 6)
      write_deck(arguments[5], mesh, frame, n_modes);
    else if (!wish.empty())
      compare_factors(fem::discretise(mesh, frame), n_modes);
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
