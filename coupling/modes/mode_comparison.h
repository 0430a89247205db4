#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Two matching modes.
struct ModePair
{
  int    a = -1, b = -1;    ///< columns
  double assurance = 0.;    ///< MAC
  bool   reversed  = false; ///< the shapes have opposite signs
};

/**
 * Comparison of the modes of two machines in k common measures (displacements, angles) of mass-normalised shapes, A [k
 * x a], B [k x b].  The apparent mass of a measure follows from the sum over the modes of A,
 *
 *     m_A,k = 1 / sum_j A_kj^2,     m_k = sqrt(m_A,k m_B,k),
 *
 * in kg or kg m^2, so that metres and radians have the weights of the kinetic energy; with all modes and coordinates of
 * a diagonal M these are its masses.  Then
 *
 *     MAC_ij = (sum_k m_k A_ki B_kj)^2 / (sum_k m_k A_ki^2  sum_k m_k B_kj^2),     seen_i = sum_k m_A,k A_ki^2.
 *
 * With all modes, and measures that are the coordinates of a diagonal M, `seen` is the share of a mode's kinetic energy
 * in the measures.  Otherwise it is a weight, not a share: omitted modes make the masses too large.  In any case
 *
 *     sum_i seen_i = number of measures that move,     0 <= seen_i <= that number,
 *
 * so that it exceeds 1 if there are fewer modes than measures; a single mode in k measures has k.  A mode below
 * `least_seen` is not matched.  The matching maximises the sum of MAC_ij seen_i seen_j over all pairs.
 *
 * Source: docs/theory/modes_along.md (7), (8).
 */
struct ModeComparison
{
  Eigen::VectorXd       mass;           ///< [k] m_k
  Eigen::MatrixXd       mac;            ///< [a x b]
  Eigen::VectorXd       seen_a, seen_b; ///< [a], [b]
  std::vector<ModePair> pairs;          ///< by a, ascending
};

/// Smallest observability of a mode for a comparison; MAC above which two modes are the same.
constexpr double least_seen = 0.05, least_assurance = 0.5;

/// A measure that moves in no mode, or only in the modes of one machine, is ignored.
ModeComparison compare_modes(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);

} // namespace gestell::coupling
