#include "coupling/sparse_cholesky.h"

#include "coupling/node_ordering.h"
#include "coupling/openblas.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

extern "C" void openblas_set_num_threads(int n);

namespace gestell::coupling
{

struct SparseCholesky::Factor
{
  cholmod_common   common;
  cholmod_factor  *L = nullptr;
  int              n = 0;
  std::vector<int> held; // ascending

  // workspaces that CHOLMOD keeps from call to call
  cholmod_dense *X = nullptr, *Y = nullptr, *E = nullptr;

  Factor()
  {
    use_fitting_blas_kernels();
    openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print              = 0;
    common.supernodal         = CHOLMOD_SUPERNODAL;
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder          = 1;
  }
  ~Factor()
  {
    release_numbers();
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
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
    const auto ints = [](const void *p) { return static_cast<const int *>(p); };
    return {n, int(L->nsuper), ints(L->super), ints(L->pi), ints(L->s), ints(L->px), ints(L->Perm)};
  }

  /// Room for the numbers of L, where CHOLMOD's solution expects them; release_numbers() gives it back.
  void allocate_numbers()
  {
    L->x = cholmod_malloc(L->xsize, sizeof(double), &common);
    if (!L->x)
      throw std::bad_alloc();
    L->xtype = CHOLMOD_REAL;
    L->dtype = CHOLMOD_DOUBLE;
    L->minor = L->n;
    L->is_ll = 1;
  }

  void release_numbers()
  {
    if (L && L->x)
    {
      L->x     = cholmod_free(L->xsize, sizeof(double), L->x, &common);
      L->xtype = CHOLMOD_PATTERN;
    }
    for (cholmod_dense **workspace : {&X, &Y, &E})
      cholmod_free_dense(workspace, &common);
  }

  Factor(const Factor &)            = delete;
  Factor &operator=(const Factor &) = delete;
};

namespace
{

/// What CHOLMOD knows of L from the pattern alone: the order of the coordinates and the fronts.
cholmod_factor *analysed(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held, cholmod_common &common)
{
  SparsePattern    lower = lower_triangle(A, held);
  std::vector<int> order = node_ordering(A, held, common);
  cholmod_sparse   view  = view_of(lower);
  cholmod_factor  *L     = cholmod_analyze_p(&view, order.data(), nullptr, 0, &common);
  if (!L || common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
  {
    cholmod_free_factor(&L, &common);
    throw std::bad_alloc();
  }
  return L;
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

/// Whether C has an entry wherever M has one.
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

constexpr int block_width = 16; // right-hand sides at once: wider gains little and needs more workspace

cholmod_dense columns_at(double *x, int n, int columns)
{
  cholmod_dense view{};
  view.nrow  = n;
  view.ncol  = columns;
  view.nzmax = std::size_t(n) * columns;
  view.d     = n;
  view.x     = x;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

/// Calls visit(row of A, diagonal entry of L) for every column of a supernodal factor.
template <typename Visit>
void for_each_pivot(const cholmod_factor &L, const Visit &visit)
{
  const auto *super = static_cast<const int *>(L.super), *rows = static_cast<const int *>(L.pi),
             *start = static_cast<const int *>(L.px), *order = static_cast<const int *>(L.Perm);
  const auto *x = static_cast<const double *>(L.x);
  for (std::size_t s = 0; s < L.nsuper; ++s)
    for (int k = super[s]; k < super[s + 1]; ++k)
    {
      const std::size_t height = rows[s + 1] - rows[s], column = k - super[s];
      visit(order[k], x[start[s] + column * (height + 1)]);
    }
}

} // namespace

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &A) : SparseCholesky(both_triangles(A), {}) {}

SparseCholesky::SparseCholesky() : factor_(std::make_unique<Factor>()) {}

SparseCholesky SparseCholesky::without_numbers(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held)
{
  eigen_assert(A.isCompressed() && A.rows() == A.cols());
  SparseCholesky result;
  Factor        &f = *result.factor_;
  f.n              = int(A.rows());
  f.held           = held;
  f.L              = analysed(A, f.held_marks(), f.common);
  return result;
}

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held)
    : SparseCholesky(without_numbers(A, held))
{
  Factor &f = *factor_;
  f.allocate_numbers();
  const double typical = f.n > 0 ? A.diagonal().cwiseAbs().mean() : 1.;
  const int    failed = multifrontal_cholesky(f.fronts(), {A, nullptr, 0., f.held_marks(), typical > 0. ? typical : 1.},
                                              static_cast<double *>(f.L->x));
  if (failed >= 0)
    throw NotPositiveDefinite(failed);
  for_each_pivot(*f.L,
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
  for (int first = 0; first < X.cols(); first += block_width)
  {
    const int     width   = std::min(block_width, int(X.cols()) - first);
    cholmod_dense columns = columns_at(X.col(first).data(), f.n, width);
    columns.d             = X.outerStride();
    columns.nzmax         = columns.d * width;
    if (!cholmod_solve2(CHOLMOD_A, f.L, &columns, nullptr, &f.X, nullptr, &f.Y, &f.E, &f.common))
      throw std::bad_alloc();
    const auto *solution       = static_cast<const double *>(f.X->x);
    X.middleCols(first, width) = Eigen::Map<const Eigen::MatrixXd>(solution, f.n, width);
  }
}

void SparseCholesky::solve(const double *rhs, double *x) const
{
  Factor       &f      = *factor_;
  cholmod_dense column = columns_at(const_cast<double *>(rhs), f.n, 1);
  if (!cholmod_solve2(CHOLMOD_A, f.L, &column, nullptr, &f.X, nullptr, &f.Y, &f.E, &f.common))
    throw std::bad_alloc();
  std::memcpy(x, f.X->x, f.n * sizeof(double));
}

double SparseCholesky::pivot_ratio() const
{
  return cholmod_rcond(factor_->L, &factor_->common);
}

int SparseCholesky::weakest_row() const
{
  int    weakest  = 0;
  double smallest = INFINITY;
  for_each_pivot(*factor_->L,
                 [&](int row, double pivot)
                 {
                   if (pivot < smallest)
                     smallest = pivot, weakest = row;
                 });
  return weakest;
}

double SparseCholesky::entries() const
{
  return double(factor_->L->xsize);
}

void SparseCholesky::release()
{
  factor_->release_numbers();
}

bool SparseCholesky::released() const
{
  return factor_->L->xtype == CHOLMOD_PATTERN;
}

Inertia SparseCholesky::inertia(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M,
                                double sigma) const
{
  const Factor &f = *factor_;
  eigen_assert(C.rows() == f.n && M.rows() == f.n);
  if (contains(C, M))
    return multifrontal_inertia(f.fronts(), {C, &M, sigma, f.held_marks(), 1.});
  Factor united; // masses between coordinates without a stiffness
  united.n    = f.n;
  united.held = f.held;
  united.L    = analysed(C + M, f.held_marks(), united.common);
  return multifrontal_inertia(united.fronts(), {C, &M, sigma, f.held_marks(), 1.});
}

} // namespace gestell::coupling
