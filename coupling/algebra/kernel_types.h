#pragma once

#include <array>
#include <cstddef>

namespace gestell::coupling
{

constexpr int tile_rows = 8; ///< rows of L stored together: a cache line of doubles

/**
 * L in tiles: the rows of a front's panel (its own columns' rows first, ascending) are cut into tiles of eight, the
 * last padded with zeros. Tile t contains, by columns, the eight entries of the columns 0 .. min(w, 8 t + 8)
 * - 1 of the front; entries above the diagonal are zero. A sweep through L reads these numbers sequentially.
 */
struct TiledFactor
{
  int                   n     = 0;
  int                   count = 0;       ///< of fronts
  const int            *first = nullptr; ///< [count + 1] columns of front s are first[s] .. first[s + 1] - 1
  const int            *begin = nullptr; ///< [count + 1] into rows
  const int            *rows  = nullptr; ///< of front s, its own columns first
  const std::ptrdiff_t *place = nullptr; ///< [count + 1] of its tiles in L
  const double         *L     = nullptr;
};

/// A solver for a number of right-hand sides at once: X is [columns x (n + 1)], a row of the right-hand sides
/// together, in the order of elimination; the last row is unused.
struct TriangularSolve
{
  int columns;
  void (*forward)(const TiledFactor &, double *X);  ///< X <- L^-1 X
  void (*backward)(const TiledFactor &, double *X); ///< X <- L^-T X
};

/**
 * A sparse matrix in groups of one row, or of three rows that are shifted copies: group g has the rows first[g] ..
 * first[g + 1] - 1, and the entries begin[g] .. begin[g + 1] - 1 of its first row.  Row d of a group has the same
 * values d columns further to the right, as for masses that act equally along x, y and z.
 */
struct SparseRows
{
  int           groups = 0;
  const int    *first  = nullptr; ///< [groups + 1]
  const int    *begin  = nullptr; ///< [groups + 1]
  const int    *column = nullptr;
  const double *value  = nullptr;
};

/// Algebra with blocks X [columns x (8 n_tiles)], a row of the columns together, and with Q in tiles of eight rows and
/// `length` columns; small matrices H, F, G [length or columns x columns] by rows.
struct BlockAlgebra
{
  int columns;
  void (*subtract_product)(const double *Q, int length, int n_tiles, const double *H, double *X);    ///< X -= Q H
  void (*subtract_projection)(const double *Q, int length, int n_tiles, const double *X, double *H); ///< H -= Q^T X
  void (*subtract_gram)(int n_tiles, const double *X, const double *Y, double *G);                   ///< G -= X^T Y
  void (*subtract_transform)(int n_tiles, const double *Y, const double *F, double *X);              ///< X -= Y F
  void (*sparse_product)(const SparseRows &A, const double *X, double *Y);                           ///< Y = A X
};

/// For 1, a few, many and most right-hand sides, with columns ascending.
using TriangularSolveKernels = std::array<TriangularSolve, 4>;

/// For few and for many columns.
using AlgebraKernels = std::array<BlockAlgebra, 2>;

} // namespace gestell::coupling
