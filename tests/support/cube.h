#pragma once

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::test
{

/// n^3 unit masses on a grid, sprung to their neighbours and, at the rim, to the ground: one displacement each.  The
/// frequencies are known, and most of them come three or six times.
inline Eigen::SparseMatrix<double> cube_stiffness(int n)
{
  std::vector<Eigen::Triplet<double>> C;
  const auto                          at   = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  const auto                          link = [&](int p, int r, bool inside)
  {
    if (inside)
      C.emplace_back(p, r, -1.);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
      {
        const int p = at(i, j, k);
        C.emplace_back(p, p, 6.);
        for (const int step : {-1, 1})
        {
          link(p, at(i + step, j, k), i + step >= 0 && i + step < n);
          link(p, at(i, j + step, k), j + step >= 0 && j + step < n);
          link(p, at(i, j, k + step), k + step >= 0 && k + step < n);
        }
      }
  Eigen::SparseMatrix<double> A(n * n * n, n * n * n);
  A.setFromTriplets(C.begin(), C.end());
  return A;
}

inline Eigen::SparseMatrix<double> unit_mass(int n)
{
  Eigen::SparseMatrix<double> M(n, n);
  M.setIdentity();
  M.makeCompressed();
  return M;
}

/// omega^2 = sum over i, j, k of 4 sin^2(pi i / (2 n + 2)), ascending.
inline std::vector<double> cube_frequencies(int n)
{
  const auto          side = [n](int i) { return 4. * std::pow(std::sin(std::acos(-1.) * i / (2. * n + 2.)), 2); };
  std::vector<double> omega;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      for (int k = 1; k <= n; ++k)
        omega.push_back(std::sqrt(side(i) + side(j) + side(k)));
  std::sort(omega.begin(), omega.end());
  return omega;
}

} // namespace gestell::test
