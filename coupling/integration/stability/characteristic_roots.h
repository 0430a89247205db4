#pragma once

#include "coupling/integration/stability/polynomial_roots.h"
#include "coupling/integration/stability/test_oscillator.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// A root r of a characteristic polynomial; log_abs = ln|r| keeps its digits where |r| is close to 1.
struct CharacteristicRoot
{
  LongComplex r;
  long double log_abs;
};

/// Roots, and a margin that is negative if none of them grows and positive if one does.  It lacks the rounding noise
/// that |r| - 1 has along an axis of neutral stability.
struct CharacteristicRoots
{
  std::vector<CharacteristicRoot> all;
  long double                     margin;
};

/// mu = (-zeta + i sqrt(1 - zeta^2)) omega h: the exact solution is multiplied by exp(mu) in a step.
LongComplex exponent(const TestOscillator &o);

/// Roots from z = (r - 1)/(r + 1), zeros of a polynomial: |r| > 1 if Re z > 0.  Growth of |r| within the relative
/// rounding 1e-18 of z is ignored.
CharacteristicRoots roots_of_z(const std::vector<LongComplex> &polynomial);

/// Roots of a 2 x 2 map with det <= 1 up to rounding: stable while |trace| <= 1 + det.
CharacteristicRoots roots_of_map(const Eigen::Matrix<long double, 2, 2> &A);

/// Eigenvalues of an amplification matrix; growth below 1e-13, the rounding of simple ones, is ignored.
CharacteristicRoots roots_of_matrix(const Eigen::MatrixXd &A);

} // namespace gestell::coupling
