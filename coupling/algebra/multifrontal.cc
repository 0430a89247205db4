#include "coupling/algebra/multifrontal.h"

#include "coupling/algebra/large_array.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

extern "C"
{
  void dpotrf_(const char *uplo, const int *n, double *A, const int *lda, int *info);
  void dtrmm_(const char *side, const char *uplo, const char *trans, const char *diag, const int *m, const int *n,
              const double *alpha, const double *A, const int *lda, double *B, const int *ldb);
  void dtrtri_(const char *uplo, const char *diag, const int *n, double *A, const int *lda, int *info);
  void dsyrk_(const char *uplo, const char *trans, const int *n, const int *k, const double *alpha, const double *A,
              const int *lda, const double *beta, double *C, const int *ldc);
  void dgemm_(const char *transa, const char *transb, const int *m, const int *n, const int *k, const double *alpha,
              const double *A, const int *lda, const double *B, const int *ldb, const double *beta, double *C,
              const int *ldc);
}

namespace gestell::coupling
{

namespace
{

using std::ptrdiff_t;

constexpr int    block = 64; ///< columns factored or divided by at once: 64 x 64 doubles fill a first-level cache
constexpr int    small = 32; // the same for fronts that are not wide
constexpr int    wide  = 4 * small; // columns
constexpr int    slice = 256;       // columns of a triangle that are treated as a rectangle
constexpr double one = 1., minus_one = -1., two = 2., zero = 0.; ///< BLAS takes their addresses

/// X <- X L^-T, X [rows x w] below L [w x w], both with columns h apart: as products with the inverses of blocks on the
/// diagonal, for OpenBLAS divides by narrow L at half the speed of a product.
class Division
{
public:
  void operator()(const double *L, int h, int w, int rows, double *X)
  {
    const int step = w <= wide ? small : block;
    for (int k = 0; k < w; k += step)
    {
      const int columns = std::min(step, w - k);
      double   *x       = X + ptrdiff_t(k) * h;
      if (k > 0)
        dgemm_("N", "T", &rows, &columns, &k, &minus_one, X, &h, L + k, &h, &one, x, &h);
      for (int j = 0; j < columns; ++j)
        std::copy_n(L + (k + j) + ptrdiff_t(k + j) * h, columns - j, inverse_ + j + j * columns);
      int info = 0;
      dtrtri_("L", "N", &columns, inverse_, &columns, &info);
      dtrmm_("R", "L", "T", "N", &rows, &columns, &one, inverse_, &columns, x, &h);
    }
  }

private:
  double inverse_[block * block];
};

/// The rows of a contribution, as places in the front that takes it, cut into runs without gaps.
struct Run
{
  int from, to, length;
};

/// Which front passes its contribution on to which, and what that takes.
class Fall
{
public:
  explicit Fall(const Fronts &fronts) : fronts_(fronts), parent_(fronts.count, -1)
  {
    std::vector<int> front_of(fronts.n, -1);
    for (int s = 0; s < fronts.count; ++s)
      for (int k = fronts.first[s]; k < fronts.first[s + 1]; ++k)
        front_of[k] = s;
    for (int s = 0; s < fronts.count; ++s)
      if (below(s) > 0)
        parent_[s] = front_of[fronts.rows[fronts.begin[s] + width(s)]];
  }

  int width(int s) const { return fronts_.first[s + 1] - fronts_.first[s]; }
  int height(int s) const { return fronts_.begin[s + 1] - fronts_.begin[s]; }
  int below(int s) const { return height(s) - width(s); }
  int parent(int s) const { return parent_[s]; } // or -1

  ptrdiff_t contribution_size(int s) const { return ptrdiff_t(below(s)) * below(s); }

  /// Largest number of values on the stack: waiting contributions and the new one above them.
  ptrdiff_t stack_size() const
  {
    ptrdiff_t              now = 0, most = 1;
    std::vector<ptrdiff_t> waiting(fronts_.count, 0);
    for (int s = 0; s < fronts_.count; ++s)
    {
      most = std::max(most, now + contribution_size(s));
      now -= waiting[s];
      if (parent_[s] < 0)
        continue;
      now += contribution_size(s);
      waiting[parent_[s]] += contribution_size(s);
    }
    return most;
  }

  /// Numbers of the largest panel.
  ptrdiff_t panel_size() const
  {
    ptrdiff_t most = 1;
    for (int s = 0; s < fronts_.count; ++s)
      most = std::max(most, ptrdiff_t(height(s)) * width(s));
    return most;
  }

protected:
  const Fronts &fronts_;

private:
  std::vector<int> parent_;
};

class Elimination : Fall
{
public:
  Elimination(const Fronts &fronts, const HeldMatrix &A, const Border &border)
      : Fall(fronts), A_(A), border_(border), place_of_(A.C.rows(), -1), local_(fronts.n), stack_(stack_size()),
        panel_(panel_size())
  {
    for (int k = 0; k < fronts.n; ++k)
      place_of_[fronts.order[k]] = k;
  }

  /// -1, or the coordinate of the first pivot that is not positive.
  int cholesky(const std::function<void(int, const double *)> &take)
  {
    for (int s = 0; s < fronts_.count; ++s)
    {
      assemble(s, panel_.data());
      int       info = 0;
      const int h = height(s), w = width(s);
      dpotrf_("L", &w, panel_.data(), &h, &info);
      if (info > 0)
        return fronts_.order[fronts_.first[s] + info - 1];
      divide_and_pass_on(s, panel_.data());
      take(s, panel_.data());
    }
    return -1;
  }

  Inertia inertia()
  {
    Inertia             result;
    std::vector<double> kept;
    growth_.assign(fronts_.n, 0.);
    for (int s = 0; s < fronts_.count; ++s)
    {
      const int h = height(s), w = width(s);
      assemble(s, panel_.data());
      int info = 0;
      kept.resize(ptrdiff_t(w) * w);
      copy_block(panel_.data(), h, kept.data(), w, w);
      dpotrf_("L", &w, panel_.data(), &h, &info);
      if (info == 0)
      {
        divide_and_pass_on(s, panel_.data());
        continue;
      }
      copy_block(kept.data(), w, panel_.data(), h, w);
      result.negative += factor_with_signs(s, panel_.data());
    }
    for (int k = 0; k < fronts_.n; ++k)
    {
      const int i = fronts_.order[k];
      if (growth_[k] > 0.)
        result.growth = std::max(result.growth, 1. + growth_[k] / std::abs(A_.C.coeff(i, i)));
    }
    return result;
  }

private:
  struct Waiting
  {
    int     front;
    double *begin, *end;
  };

  static void copy_block(const double *from, int from_height, double *to, int to_height, int w)
  {
    for (int j = 0; j < w; ++j)
      std::copy_n(from + ptrdiff_t(j) * from_height + j, w - j, to + ptrdiff_t(j) * to_height + j);
  }

  /// Entries of A in the columns of a front, and what earlier fronts pass on to it.
  void assemble(int s, double *panel)
  {
    const int h = height(s), w = width(s);
    std::fill_n(panel, ptrdiff_t(h) * w, 0.);
    for (int i = 0; i < h; ++i)
      local_[fronts_.rows[fronts_.begin[s] + i]] = i;
    for (int k = fronts_.first[s]; k < fronts_.first[s + 1]; ++k)
      add_column(k, panel + ptrdiff_t(k - fronts_.first[s]) * h);

    contribution_ = waiting_.empty() ? stack_.data() : waiting_.back().end;
    first_child_  = waiting_.size();
    while (first_child_ > 0 && parent(waiting_[first_child_ - 1].front) == s)
      add_columns(waiting_[--first_child_], 0, w, panel, h);
  }

  void add_column(int k, double *column) const
  {
    const int i = fronts_.order[k];
    if (!A_.held.empty() && A_.held[i])
    {
      column[local_[k]] = A_.held_diagonal;
      return;
    }
    add_column(A_.C, 1., i, k, column);
    if (A_.M)
      add_column(*A_.M, -A_.sigma, i, k, column);
  }

  void add_column(const Eigen::SparseMatrix<double> &X, double factor, int i, int k, double *column) const
  {
    for (Eigen::SparseMatrix<double>::InnerIterator x(X, i); x; ++x)
      if (const int row = place_of_[x.row()]; row >= k && (A_.held.empty() || !A_.held[x.row()]))
        column[local_[row]] += factor * x.value();
  }

  /// Adds the columns of a child's contribution that are columns first .. last - 1 of its parent to a matrix whose
  /// first row is `first`.
  void add_columns(const Waiting &child, int first, int last, double *matrix, ptrdiff_t height)
  {
    const int  r    = below(child.front);
    const int *rows = fronts_.rows + fronts_.begin[child.front] + width(child.front);
    runs_.clear();
    for (int i = 0; i < r; ++i)
      if (const int to = local_[rows[i]]; !runs_.empty() && runs_.back().to + runs_.back().length == to)
        ++runs_.back().length;
      else
        runs_.push_back({i, to, 1});
    std::size_t own = 0;
    for (int j = 0; j < r; ++j)
    {
      while (runs_[own].from + runs_[own].length <= j)
        ++own;
      const int column = runs_[own].to + j - runs_[own].from;
      if (column < first)
        continue;
      if (column >= last)
        break;
      double *const       to     = matrix + (column - first) * height;
      const double *const values = child.begin + ptrdiff_t(j) * r;
      for (std::size_t run = own; run < runs_.size(); ++run)
      {
        const auto &[at, place, length] = runs_[run];
        const int begin = std::max(at, j), shift = place - at - first;
        for (int i = begin; i < at + length; ++i)
          to[i + shift] += values[i];
      }
    }
  }

  /// L21 = A21 L11^-T, and the contribution -L21 L21^T.
  void divide_and_pass_on(int s, double *panel)
  {
    const int h = height(s), w = width(s), r = below(s);
    if (r > 0)
    {
      divide_(panel, h, w, r, panel + w);
      dsyrk_("L", "N", &r, &w, &minus_one, panel + w, &h, &zero, contribution_, &r);
    }
    pass_on(s);
  }

  /// Joins the contribution of front s with the remaining contributions of its children and moves the lower triangle to
  /// the place of the first child.
  void pass_on(int s)
  {
    const int       w  = width(s);
    const ptrdiff_t r  = below(s);
    double         *to = contribution_;
    for (; waiting_.size() > first_child_; waiting_.pop_back())
    {
      add_columns(waiting_.back(), w, height(s), contribution_, r);
      to = waiting_.back().begin;
    }
    if (r == 0)
      return;
    if (parent(s) < 0)
      return border_.left(s, contribution_);
    if (to != contribution_)
      for (ptrdiff_t j = 0; j < r; ++j)
        std::memmove(to + j * r + j, contribution_ + j * r + j, sizeof(double) * (r - j));
    waiting_.push_back({s, to, to + r * r});
  }

  /// A11 = L11 S L11^T, S = diag(+-1), by blocks; L21 and the contribution -L21 S L21^T.  Counts what is negative.
  int factor_with_signs(int s, double *panel)
  {
    const int           h = height(s), w = width(s), r = below(s);
    std::vector<double> sign(w), signed_rows;
    for (int k0 = 0; k0 < w; k0 += block)
    {
      const int k1 = std::min(w, k0 + block), columns = k1 - k0, rest = h - k1, right = w - k1;
      double   *corner = panel + k0 + ptrdiff_t(k0) * h, *lower = corner + columns;
      factor_corner(corner, h, columns, sign.data() + k0);
      if (rest == 0)
        break;
      divide_(corner, h, columns, rest, lower);
      for (int j = 0; j < columns; ++j)
        if (sign[k0 + j] < 0.)
          for (int i = 0; i < rest; ++i)
            lower[i + ptrdiff_t(j) * h] = -lower[i + ptrdiff_t(j) * h];
      if (right == 0)
        continue;
      signed_rows.resize(ptrdiff_t(right) * columns);
      for (int j = 0; j < columns; ++j)
        for (int i = 0; i < right; ++i)
          signed_rows[i + ptrdiff_t(j) * right] = sign[k0 + j] * lower[i + ptrdiff_t(j) * h];
      for (int j = 0; j < right; j += slice) // of the lower triangle
      {
        const int n = std::min(slice, right - j), m = rest - j;
        dgemm_("N", "T", &m, &n, &columns, &minus_one, lower + j, &h, signed_rows.data() + j, &right, &one,
               panel + (k1 + j) + ptrdiff_t(k1 + j) * h, &h);
      }
    }
    std::vector<double> turned; // columns of L21 whose sign is negative
    int                 negative = 0;
    for (int j = 0; j < w; ++j)
      if (sign[j] < 0.)
      {
        ++negative;
        const double *column = panel + ptrdiff_t(j) * h;
        turned.insert(turned.end(), column + w, column + h);
        for (int i = j; i < h; ++i)
          growth_[fronts_.rows[fronts_.begin[s] + i]] += 2. * column[i] * column[i];
      }
    if (r > 0)
      dsyrk_("L", "N", &r, &w, &minus_one, panel + w, &h, &zero, contribution_, &r);
    if (r > 0 && negative > 0)
      dsyrk_("L", "N", &r, &negative, &two, turned.data(), &r, &one, contribution_, &r);
    pass_on(s);
    return negative;
  }

  static void factor_corner(double *corner, int h, int columns, double *sign)
  {
    for (int j = 0; j < columns; ++j)
    {
      double      *column = corner + ptrdiff_t(j) * h;
      const double pivot  = column[j] != 0. ? column[j] : std::numeric_limits<double>::min();
      sign[j]             = pivot > 0. ? 1. : -1.;
      column[j]           = std::sqrt(std::abs(pivot));
      for (int i = j + 1; i < columns; ++i)
        column[i] *= sign[j] / column[j];
      for (int c = j + 1; c < columns; ++c)
        for (int i = c; i < columns; ++i)
          corner[i + ptrdiff_t(c) * h] -= sign[j] * column[i] * column[c];
    }
  }

  const HeldMatrix    &A_;
  const Border        &border_;
  std::vector<int>     place_of_, local_;
  LargeArray           stack_, panel_;
  Division             divide_;
  std::vector<Waiting> waiting_;
  double              *contribution_ = nullptr; // of the front at work
  std::size_t          first_child_  = 0;       // of those waiting for it
  std::vector<Run>     runs_;
  std::vector<double>  growth_;
};

} // namespace

int multifrontal_cholesky(const Fronts &fronts, const HeldMatrix &A,
                          const std::function<void(int, const double *)> &take, const Border &border)
{
  return Elimination(fronts, A, border).cholesky(take);
}

ptrdiff_t multifrontal_workspace(const Fronts &fronts)
{
  const Fall fall(fronts);
  return fall.stack_size() + fall.panel_size();
}

Inertia multifrontal_inertia(const Fronts &fronts, const HeldMatrix &A, const Border &border)
{
  return Elimination(fronts, A, border).inertia();
}

} // namespace gestell::coupling
