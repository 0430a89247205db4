#include "coupling/algebra/sparse_cholesky.h"

#include "coupling/algebra/node_ordering.h"
#include "coupling/algebra/openblas.h"
#include "coupling/algebra/tiled_panels.h"
#include "coupling/algebra/triangular_solve_kernels.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>
#include <new>
#include <sstream>

extern "C" void openblas_set_num_threads(int n);

namespace gestell::coupling
{

namespace
{

/// The result of an analysis: order of the coordinates and fronts.
struct Analysis
{
  std::vector<int> first, begin, rows, order;
};

/// Symbolic analysis by CHOLMOD from the pattern of A.
Analysis analysed(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held)
{
  cholmod_common  common;
  LowerPattern    lower(A, held);
  cholmod_factor *L = lower.analysed(node_ordering(A, held), common);
  Analysis        result;
  const bool      done = L && common.status >= CHOLMOD_OK && L->ssize <= std::size_t(INT_MAX);
  if (done)
  {
    const auto ints = [](const void *p, std::size_t count)
    {
      const auto *values = static_cast<const SuiteSparse_long *>(p);
      return std::vector<int>(values, values + count);
    };
    result = {ints(L->super, L->nsuper + 1), ints(L->pi, L->nsuper + 1), ints(L->s, L->ssize), ints(L->Perm, L->n)};
  }
  cholmod_l_free_factor(&L, &common);
  cholmod_l_finish(&common);
  if (!done)
    throw std::bad_alloc();
  return result;
}

} // namespace

struct SparseCholesky::Factor
{
  Analysis            analysis; // without numbers
  int                 n = 0;
  std::vector<int>    held; // ascending
  TiledPanels         L;
  std::vector<double> single; // right-hand side in the order of elimination

  Factor()
  {
    use_fitting_blas_kernels();
    openblas_set_num_threads(1);
  }

  std::vector<char> held_marks() const
  {
    std::vector<char> marks(held.empty() ? 0 : n, 0);
    for (const int i : held)
      marks[i] = 1;
    return marks;
  }

  Fronts fronts() const
  {
    const auto &[first, begin, rows, order] = analysis;
    return {n, int(first.size()) - 1, first.data(), begin.data(), rows.data(), order.data()};
  }

  /// Calls visit(row of A, diagonal entry of L) for every column.
  template <typename Visit>
  void for_each_pivot(const Visit &visit) const
  {
    const int *order = fronts().order;
    L.for_each_pivot([&](int column, double pivot) { visit(order[column], pivot); });
  }
};

namespace
{

std::string gibibytes(double bytes)
{
  std::ostringstream text;
  text.precision(3);
  text << bytes / 1073741824. << " GiB";
  return text.str();
}

Eigen::SparseMatrix<double> both_triangles(const Eigen::SparseMatrix<double> &A)
{
  if (A.rows() != A.cols())
    throw std::invalid_argument("SparseCholesky: the matrix has " + std::to_string(A.rows()) + " rows and " +
                                std::to_string(A.cols()) + " columns; it must be square");
  Eigen::SparseMatrix<double> full = A.selfadjointView<Eigen::Lower>();
  full.makeCompressed();
  return full;
}

} // namespace

bool contains(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M)
{
  for (int j = 0; j < M.outerSize(); ++j)
  {
    const auto rows = [j](const Eigen::SparseMatrix<double> &A, int next)
    { return A.innerIndexPtr() + A.outerIndexPtr()[j + next]; };
    if (!std::includes(rows(C, 0), rows(C, 1), rows(M, 0), rows(M, 1)))
      return false;
  }
  return true;
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &A) : SparseCholesky(both_triangles(A), {}) {}

NotEnoughMemory::NotEnoughMemory(double needed, double available)
    : std::runtime_error("the factor of the stiffness needs " + gibibytes(needed) + " of memory, but only " +
                         gibibytes(available) +
                         " are available; use a coarser mesh, hexahedra in thin walls, more ranks (mpirun), or "
                         "reduction.factor = \"mumps\" with its factor on disk "
                         "(PETSC_OPTIONS=\"-reduction_mat_mumps_icntl_22 1\")")
{
}

SparseCholesky::SparseCholesky() : factor_(std::make_unique<Factor>()) {}

SparseCholesky SparseCholesky::without_numbers(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held)
{
  eigen_assert(A.isCompressed() && A.rows() == A.cols());
  SparseCholesky result;
  Factor        &f = *result.factor_;
  f.n              = int(A.rows());
  f.held           = held;
  f.analysis       = analysed(A, f.held_marks());
  f.L              = TiledPanels(f.fronts());
  return result;
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held, double available)
    : SparseCholesky(without_numbers(A, held))
{
  factorise(A, available);
}

void SparseCholesky::factorise(const Eigen::SparseMatrix<double> &A, double available)
{
  Factor      &f      = *factor_;
  const Fronts fronts = f.fronts();
  const double needed = sizeof(double) * (double(f.L.size()) + double(multifrontal_workspace(fronts)));
  if (needed > available)
    throw NotEnoughMemory(needed, available);
  f.L.reserve();
  const double typical = f.n > 0 ? A.diagonal().cwiseAbs().mean() : 1.;
  const int    failed  = multifrontal_cholesky(fronts, {A, nullptr, 0., f.held_marks(), typical > 0. ? typical : 1.},
                                               [&](int s, const double *panel) { f.L.put(s, panel); });
  if (failed >= 0)
    throw NotPositiveDefinite(failed);
  f.for_each_pivot(
      [](int row, double pivot)
      {
        if (!std::isfinite(pivot))
          throw NotPositiveDefinite(row);
      });
}

SparseCholesky::~SparseCholesky()                                     = default;
SparseCholesky::SparseCholesky(SparseCholesky &&) noexcept            = default;
SparseCholesky &SparseCholesky::operator=(SparseCholesky &&) noexcept = default;

int SparseCholesky::size() const
{
  return factor_->n;
}

void SparseCholesky::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  Factor &f = *factor_;
  eigen_assert(X.rows() == f.n && !released());
  const TiledFactor tiles       = f.L.tiles();
  const int        *order       = f.fronts().order;
  const auto        columns_for = [](int width)
  {
    return *std::find_if(triangular_solve_kernels().begin(), triangular_solve_kernels().end(),
                         [&](const TriangularSolve &sweeps) { return sweeps.columns >= width; });
  };
  const int  most = std::min(triangular_solve_kernels().back().columns, int(X.cols()));
  LargeArray several; // right-hand sides in the order of elimination; a single one has its place for the next time
  if (most > 1)
    several = LargeArray(std::size_t(columns_for(most).columns) * (f.n + 1));
  else
    f.single.resize(f.n + 1);
  double *const rhs = most > 1 ? several.data() : f.single.data();
  for (int first = 0; first < X.cols();)
  {
    const int             width   = std::min(most, int(X.cols()) - first);
    const TriangularSolve sweeps  = columns_for(width);
    const std::ptrdiff_t  columns = sweeps.columns;
    for (std::ptrdiff_t k = 0; k < f.n; ++k)
    {
      double *const x = rhs + k * columns;
      for (int j = 0; j < width; ++j)
        x[j] = X(order[k], first + j);
      std::fill(x + width, x + columns, 0.);
    }
    std::fill_n(rhs + columns * f.n, columns, 0.);
    sweeps.forward(tiles, rhs);
    sweeps.backward(tiles, rhs);
    for (std::ptrdiff_t k = 0; k < f.n; ++k)
      for (int j = 0; j < width; ++j)
        X(order[k], first + j) = rhs[k * columns + j];
    first += width;
  }
}

void SparseCholesky::solve(const double *rhs, double *x) const
{
  if (rhs != x)
    std::copy_n(rhs, size(), x);
  solve_in_place(Eigen::Map<Eigen::MatrixXd>(x, size(), 1));
}

std::vector<int> SparseCholesky::order() const
{
  const int *order = factor_->fronts().order;
  return {order, order + factor_->n};
}

void SparseCholesky::solve_in_place(MultiVector &X) const
{
  eigen_assert(X.rows() == factor_->n && !released());
  const TriangularSolve &sweeps = block_triangular_solve(X.lanes());
  const TiledFactor      tiles  = factor_->L.tiles();
  for (int p = 0; p < X.n_panels(); ++p)
  {
    sweeps.forward(tiles, X.panel(p));
    sweeps.backward(tiles, X.panel(p));
  }
}

Fronts SparseCholesky::fronts() const
{
  return factor_->fronts();
}

double SparseCholesky::pivot_ratio() const
{
  double smallest = INFINITY, largest = 0.;
  factor_->for_each_pivot([&](int, double pivot)
                          { smallest = std::min(smallest, pivot), largest = std::max(largest, pivot); });
  return largest > 0. ? smallest / largest * (smallest / largest) : 1.;
}

double SparseCholesky::entries() const
{
  return double(factor_->L.size());
}

void SparseCholesky::release()
{
  factor_->L.release();
  factor_->single = std::vector<double>();
}

bool SparseCholesky::released() const
{
  return factor_->L.released();
}

Inertia SparseCholesky::inertia(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M,
                                double sigma) const
{
  const Factor &f = *factor_;
  eigen_assert(C.rows() == f.n && M.rows() == f.n);
  if (contains(C, M))
    return multifrontal_inertia(f.fronts(), {C, &M, sigma, f.held_marks(), 1.});
  Factor united; // masses between coordinates without a stiffness
  united.n        = f.n;
  united.held     = f.held;
  united.analysis = analysed(C + M, f.held_marks());
  return multifrontal_inertia(united.fronts(), {C, &M, sigma, f.held_marks(), 1.});
}

} // namespace gestell::coupling
