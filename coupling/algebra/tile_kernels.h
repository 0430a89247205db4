// Included by sources compiled for different processors: everything here is local to each.
#pragma once

#include "coupling/algebra/kernel_types.h"

namespace gestell::coupling
{

namespace
{

using std::ptrdiff_t;

/// Prefetch distance in numbers of L: about 4 KB, the time of a few hundred products.
constexpr int ahead = 512;

inline int least(int a, int b)
{
  return a < b ? a : b;
}

/// A front, and the addresses of its rows of X.
struct FrontAt
{
  int        first, width, height;
  const int *rows;

  FrontAt(const TiledFactor &L, int s)
      : first(L.first[s]), width(L.first[s + 1] - first), height(L.begin[s + 1] - L.begin[s]), rows(L.rows + L.begin[s])
  {
  }
  int length(int tile) const { return least(width, tile + tile_rows); } // for the tile whose first row is given
};

/// Numbers that a processor takes together.
struct Four
{
  typedef double Vector __attribute__((vector_size(32), aligned(8), may_alias));
};
struct Eight
{
  typedef double Vector __attribute__((vector_size(64), aligned(8), may_alias));
};

/// `columns` right-hand sides as V vectors; R rows of a tile are kept in registers.
template <typename Lanes, int V, int R>
struct Block
{
  using Vector               = typename Lanes::Vector;
  static constexpr int lanes = sizeof(Vector) / sizeof(double), columns = V * lanes, rows = R;

  static Vector load(const double *x) { return *reinterpret_cast<const Vector *>(x); }
  static void   store(double *x, const Vector &v) { *reinterpret_cast<Vector *>(x) = v; }

  __attribute__((always_inline)) static inline void load_rows(const double *const *row, Vector (&values)[R][V])
  {
#pragma GCC unroll 8
    for (int i = 0; i < R; ++i)
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        values[i][v] = load(row[i] + v * lanes);
  }

  /// row[i] -= sum_k l(i, k) x[k] over the first `length` columns; l(i, k) lies at i row_step + k column_step.
  template <int row_step, int column_step>
  static void subtract_products(const double *l, int length, const double *x, double *const *row)
  {
    Vector sum[R][V];
    load_rows(row, sum);
    for (int k = 0; k < length; ++k, x += columns, l += column_step)
    {
      __builtin_prefetch(l + ahead);
      Vector xk[V];
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        xk[v] = load(x + v * lanes);
#pragma GCC unroll 8
      for (int i = 0; i < R; ++i)
#pragma GCC unroll 3
        for (int v = 0; v < V; ++v)
          sum[i][v] -= l[i * row_step] * xk[v];
    }
#pragma GCC unroll 8
    for (int i = 0; i < R; ++i)
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        store(row[i] + v * lanes, sum[i][v]);
  }

  /// x[k] -= sum_i l(i, k) row[i] for the first `length` columns.
  template <int row_step, int column_step>
  static void subtract_transposed(const double *l, int length, double *x, const double *const *row)
  {
    Vector z[R][V];
    load_rows(row, z);
    const ptrdiff_t before = ahead < length * column_step ? length * column_step : ahead; // a tile, or more small ones
    for (int k = 0; k < length; ++k, x += columns, l += column_step)
    {
      __builtin_prefetch(l - before, 0, 2);
      Vector xk[V];
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        xk[v] = load(x + v * lanes);
#pragma GCC unroll 8
      for (int i = 0; i < R; ++i)
#pragma GCC unroll 3
        for (int v = 0; v < V; ++v)
          xk[v] -= l[i * row_step] * z[i][v];
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        store(x + v * lanes, xk[v]);
    }
  }

  /// to += factor * from
  static void add(double factor, const double *from, double *to)
  {
#pragma GCC unroll 3
    for (int v = 0; v < V; ++v)
      store(to + v * lanes, load(to + v * lanes) + factor * load(from + v * lanes));
  }
  static void scale(double factor, double *x)
  {
#pragma GCC unroll 3
    for (int v = 0; v < V; ++v)
      store(x + v * lanes, factor * load(x + v * lanes));
  }

  /// y[d] = sum_k a[k] X[at[k] + d], d < n
  template <int n>
  static void combine(const int *at, const double *a, int count, const double *X, double *y)
  {
    Vector sum[n][V] = {};
    for (int k = 0; k < count; ++k)
    {
      const double *const x = X + ptrdiff_t(at[k]) * columns;
#pragma GCC unroll 3
      for (int d = 0; d < n; ++d)
#pragma GCC unroll 3
        for (int v = 0; v < V; ++v)
          sum[d][v] += a[k] * load(x + d * columns + v * lanes);
    }
#pragma GCC unroll 3
    for (int d = 0; d < n; ++d)
#pragma GCC unroll 3
      for (int v = 0; v < V; ++v)
        store(y + d * columns + v * lanes, sum[d][v]);
  }

  static void forward_tile(const double *l, int length, const double *x, double *const *row)
  {
    for (int i = 0; i < tile_rows; i += R)
      subtract_products<1, tile_rows>(l + i, length, x, row + i);
  }
  static void backward_tile(const double *l, int length, double *x, const double *const *row)
  {
    for (int i = 0; i < tile_rows; i += R)
      subtract_transposed<1, tile_rows>(l + i, length, x, row + i);
  }
};

/// One right-hand side: the rows of a tile make a vector.
struct Single
{
  using Vector                 = Eight::Vector;
  static constexpr int columns = 1;

  static void forward_tile(const double *l, int length, const double *x, double *const *row)
  {
    Vector even, odd = {};
    for (int i = 0; i < tile_rows; ++i)
      even[i] = *row[i];
    int k = 0;
    for (; k + 1 < length; k += 2, l += 2 * tile_rows)
    {
      even -= *reinterpret_cast<const Vector *>(l) * x[k];
      odd -= *reinterpret_cast<const Vector *>(l + tile_rows) * x[k + 1];
    }
    if (k < length)
      even -= *reinterpret_cast<const Vector *>(l) * x[k];
    even += odd;
    for (int i = 0; i < tile_rows; ++i)
      *row[i] = even[i];
  }

  static void backward_tile(const double *l, int length, double *x, const double *const *row)
  {
    Vector z;
    for (int i = 0; i < tile_rows; ++i)
      z[i] = *row[i];
    for (int k = 0; k < length; ++k, l += tile_rows)
    {
      const Vector p = *reinterpret_cast<const Vector *>(l) * z;
      x[k] -= ((p[0] + p[4]) + (p[1] + p[5])) + ((p[2] + p[6]) + (p[3] + p[7]));
    }
  }

  static void add(double factor, const double *from, double *to) { *to += factor * *from; }
  static void scale(double factor, double *x) { *x *= factor; }
};

template <typename Columns>
class Sweep
{
public:
  static void forward(const TiledFactor &L, double *X)
  {
    for (int s = 0; s < L.count; ++s)
    {
      const FrontAt front(L, s);
      const double *l  = L.L + L.place[s];
      double *const x1 = at(X, front.first);
      for (int t = 0; t < front.height; t += tile_rows)
      {
        double *row[tile_rows];
        find_rows(L, front, t, X, row);
        const int before = least(front.width, t), length = front.length(t);
        if (before > 0)
          Columns::forward_tile(l, before, x1, row);
        l += ptrdiff_t(before) * tile_rows;
        for (int k = before; k < length; ++k, l += tile_rows) // the diagonal's part
        {
          double *const x = row[k - t];
          Columns::scale(1. / l[k - t], x);
          for (int i = k - t + 1; i < tile_rows; ++i)
            Columns::add(-l[i], x, row[i]);
        }
      }
    }
  }

  static void backward(const TiledFactor &L, double *X)
  {
    for (int s = L.count - 1; s >= 0; --s)
    {
      const FrontAt front(L, s);
      const double *l  = L.L + L.place[s + 1];
      double *const x1 = at(X, front.first);
      for (int t = (front.height - 1) / tile_rows * tile_rows; t >= 0; t -= tile_rows)
      {
        double *row[tile_rows];
        find_rows(L, front, t, X, row);
        const int before = least(front.width, t), length = front.length(t);
        for (int k = length - 1; k >= before; --k)
        {
          l -= tile_rows;
          double *const x = row[k - t];
          for (int i = k - t + 1; i < tile_rows; ++i)
            Columns::add(-l[i], row[i], x);
          Columns::scale(1. / l[k - t], x);
        }
        l -= ptrdiff_t(before) * tile_rows;
        if (before > 0)
          Columns::backward_tile(l, before, x1, row);
      }
    }
  }

private:
  static double *at(double *X, int row) { return X + ptrdiff_t(row) * Columns::columns; }

  static void find_rows(const TiledFactor &L, const FrontAt &front, int t, double *X, double **row)
  {
    for (int i = 0; i < tile_rows; ++i)
      row[i] = at(X, t + i < front.height ? front.rows[t + i] : L.n);
  }
};

/// BlockAlgebra for blocks of B::columns columns.
template <typename B>
class Algebra
{
public:
  static void subtract_product(const double *tiles, int length, int n_tiles, const double *H, double *X)
  {
    for (int t = 0; t < n_tiles; ++t, tiles += ptrdiff_t(length) * tile_rows, X += step)
    {
      double *row[tile_rows];
      rows_of(X, row);
      B::forward_tile(tiles, length, H, row);
    }
  }

  static void subtract_projection(const double *tiles, int length, int n_tiles, const double *X, double *H)
  {
    for (int t = 0; t < n_tiles; ++t, tiles += ptrdiff_t(length) * tile_rows, X += step)
    {
      const double *row[tile_rows];
      rows_of(X, row);
      B::backward_tile(tiles, length, H, row);
    }
  }

  static void subtract_gram(int n_tiles, const double *X, const double *Y, double *G)
  {
    for (int t = 0; t < n_tiles; ++t, X += step, Y += step)
      for (int i = 0; i < tile_rows; i += B::rows)
      {
        const double *row[tile_rows];
        rows_of(Y, row);
        B::template subtract_transposed<B::columns, 1>(X + i * B::columns, B::columns, G, row + i);
      }
  }

  static void subtract_transform(int n_tiles, const double *Y, const double *F, double *X)
  {
    for (int t = 0; t < n_tiles; ++t, X += step, Y += step)
      for (int i = 0; i < tile_rows; i += B::rows)
      {
        double *row[tile_rows];
        rows_of(X, row);
        B::template subtract_products<B::columns, 1>(Y + i * B::columns, B::columns, F, row + i);
      }
  }

  static void sparse_product(const SparseRows &A, const double *X, double *Y)
  {
    for (int g = 0; g < A.groups; ++g)
    {
      const int     count = A.begin[g + 1] - A.begin[g], rows = A.first[g + 1] - A.first[g];
      const int    *column = A.column + A.begin[g];
      const double *value  = A.value + A.begin[g];
      double *const y      = Y + ptrdiff_t(A.first[g]) * B::columns;
      if (rows == 3)
        B::template combine<3>(column, value, count, X, y);
      else
        B::template combine<1>(column, value, count, X, y);
    }
  }

private:
  static constexpr int step = tile_rows * B::columns; // numbers of X in the rows of a tile

  template <typename Number>
  static void rows_of(Number *X, Number **row)
  {
    for (int i = 0; i < tile_rows; ++i)
      row[i] = X + i * B::columns;
  }
};

template <typename B>
constexpr BlockAlgebra algebra_of = {B::columns,
                                     Algebra<B>::subtract_product,
                                     Algebra<B>::subtract_projection,
                                     Algebra<B>::subtract_gram,
                                     Algebra<B>::subtract_transform,
                                     Algebra<B>::sparse_product};

template <typename Columns>
constexpr TriangularSolve sweeps_of = {Columns::columns, Sweep<Columns>::forward, Sweep<Columns>::backward};

} // namespace

} // namespace gestell::coupling
