#pragma once

#include <Eigen/SparseCore>

#include <cstddef>
#include <functional>
#include <vector>

namespace gestell::coupling
{

/// Fronts of a symmetric matrix: groups of columns of its factor L that share their rows (CHOLMOD's supernodes), every
/// one after those that contribute to it (postorder).
struct Fronts
{
  int        n = 0, count = 0; // rows; columns may be the first of them only, the rest belongs to other fronts
  const int *first = nullptr;  // [count + 1] columns of front s are first[s] .. first[s + 1] - 1
  const int *begin = nullptr;  // [count + 1] into rows
  const int *rows  = nullptr;  // of front s: ascending, its own columns first
  const int *order = nullptr;  // [n] coordinate of the matrix at place k
};

/// Some of the fronts of an elimination, with rows of their own numbering.
struct FrontSelection
{
  std::vector<int> first{0}, begin{0}, rows; // as Fronts
  std::vector<int> order;                    // coordinate of every row

  int    columns() const { return first.back(); }
  Fronts fronts() const
  {
    return {int(order.size()), int(begin.size()) - 1, first.data(), begin.data(), rows.data(), order.data()};
  }
};

/// A = C - sigma M with the coordinates `held` fixed: their rows and columns are zero except for the diagonal.
struct HeldMatrix
{
  const Eigen::SparseMatrix<double> &C;               // both triangles stored
  const Eigen::SparseMatrix<double> *M     = nullptr; // the same; none: A = C
  double                             sigma = 0.;
  std::vector<char>                  held; // [n] or empty
  double                             held_diagonal = 1.;
};

/// Interface between eliminations of different fronts.  A contribution is [k x k] for the k rows below a front's
/// own columns; its lower triangle counts.
struct Border
{
  /// Receives the contribution of a front with rows below, none of which is a column of these fronts.
  std::function<void(int front, const double *contribution)> left;
};

/**
 * Cholesky factor A = L L^T by the multifrontal method: each front collects the entries of A and the contributions of
 * the fronts before it, is factored densely, and passes its contribution on.
 *
 * @param take  receives the panel of every front in turn: L's columns [rows x columns], lower triangle.
 * @return      -1, or the coordinate whose pivot is not positive.
 *
 * Source: Duff & Reid, ACM Trans. Math. Software 9 (1983) 302-325.
 */
int multifrontal_cholesky(const Fronts &fronts, const HeldMatrix &A,
                          const std::function<void(int front, const double *panel)> &take, const Border &border = {});

/// Upper bound of numbers that either elimination needs in addition to L.
std::ptrdiff_t multifrontal_workspace(const Fronts &fronts);

/// Signs of D in A = L D L^T, D diagonal.
struct Inertia
{
  int negative = 0; ///< eigenvalues of A below zero (Sylvester)
  /// Largest diagonal entry of L |D| L^T over that of C: amplification of rounding, since there is no pivoting.
  double growth = 1.;
};

/**
 * Inertia of an indefinite A by the same method with pivots of any sign, without storing L. The result is the inertia
 * of A + E, |E| ~ growth * eps * diag(C).  Where growth is far beyond 1 / sqrt(eps) a pivot was close to zero; use
 * another sigma.
 */
Inertia multifrontal_inertia(const Fronts &fronts, const HeldMatrix &A, const Border &border = {});

} // namespace gestell::coupling
