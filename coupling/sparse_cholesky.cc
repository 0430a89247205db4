#include "coupling/sparse_cholesky.h"

#include <suitesparse/cholmod.h>

#include <cmath>
#include <cstring>
#include <new>

extern "C" void openblas_set_num_threads(int n);

namespace gestell::coupling
{

struct SparseCholesky::Factor
{
  cholmod_common  common;
  cholmod_factor *L = nullptr;
  int             n = 0;

  // workspaces that CHOLMOD keeps from call to call
  cholmod_dense *X = nullptr, *Y = nullptr, *E = nullptr;

  Factor()
  {
    openblas_set_num_threads(1);
    cholmod_start(&common);
    common.print              = 0;
    common.supernodal         = CHOLMOD_SUPERNODAL;
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder          = 1;
  }
  ~Factor()
  {
    cholmod_free_dense(&X, &common);
    cholmod_free_dense(&Y, &common);
    cholmod_free_dense(&E, &common);
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor &)            = delete;
  Factor &operator=(const Factor &) = delete;
};

namespace
{

constexpr int block_width = 32; // right-hand sides at once: wider gains little and needs more workspace

/// CHOLMOD's view of the lower triangle of A; nothing is copied.
cholmod_sparse lower_triangle_of(const Eigen::SparseMatrix<double> &A)
{
  cholmod_sparse view{};
  view.nrow   = A.rows();
  view.ncol   = A.cols();
  view.nzmax  = A.nonZeros();
  view.p      = const_cast<int *>(A.outerIndexPtr());
  view.i      = const_cast<int *>(A.innerIndexPtr());
  view.x      = const_cast<double *>(A.valuePtr());
  view.stype  = -1;
  view.itype  = CHOLMOD_INT;
  view.xtype  = CHOLMOD_REAL;
  view.dtype  = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

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

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double> &A) : factor_(std::make_unique<Factor>())
{
  if (A.rows() != A.cols())
    throw std::invalid_argument("SparseCholesky: the matrix has " + std::to_string(A.rows()) + " rows and " +
                                std::to_string(A.cols()) + " columns; it must be square");
  if (!A.isCompressed())
  {
    Eigen::SparseMatrix<double> compressed = A;
    compressed.makeCompressed();
    *this = SparseCholesky(compressed);
    return;
  }
  Factor        &f    = *factor_;
  cholmod_sparse view = lower_triangle_of(A);
  f.n                 = int(A.rows());
  f.L                 = cholmod_analyze(&view, &f.common);
  if (f.L)
    cholmod_factorize(&view, f.L, &f.common);
  if (!f.L || f.common.status == CHOLMOD_OUT_OF_MEMORY || f.common.status == CHOLMOD_TOO_LARGE)
    throw std::bad_alloc();
  if (f.L->minor < std::size_t(f.n))
    throw NotPositiveDefinite(static_cast<const int *>(f.L->Perm)[f.L->minor]);
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
  eigen_assert(X.rows() == f.n);
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

} // namespace gestell::coupling
