#pragma once

#include <cstddef>

namespace gestell::coupling
{

constexpr int tile_rows = 8; ///< rows of L that lie together

/**
 * L in tiles: the rows of a front's panel (its own columns' rows first, ascending) are cut into tiles of eight, the
 * last one filled up with zeros.  Tile t holds, column by column, the eight entries of the columns 0 .. min(w, 8 t + 8)
 * - 1 of the front; what lies above the diagonal is zero.  A sweep through L reads these numbers from end to end.
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

/// One way through L for a number of right-hand sides at once: X is [columns x (n + 1)], a row of the right-hand sides
/// together, in the order of elimination; what lies in the last row is of no meaning.
struct TileSweeps
{
  int columns;
  void (*forward)(const TiledFactor &, double *X);  ///< X <- L^-1 X
  void (*backward)(const TiledFactor &, double *X); ///< X <- L^-T X
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
  /// Y = A X, A [n x n] by rows: those of row i lie at begin[i] .. begin[i + 1] - 1.
  void (*sparse_product)(const int *begin, const int *column, const double *value, int n, const double *X, double *Y);
};

/// For 1, a few and many right-hand sides, with columns ascending, as the processor at hand does them best.
const TileSweeps (&tile_sweeps())[3];

/// For blocks of as many columns as the last of tile_sweeps() takes.
const BlockAlgebra &block_algebra();

} // namespace gestell::coupling
