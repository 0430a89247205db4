#pragma once

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Two modes that are taken to be the same one.
struct ModePair
{
  int    a = -1, b = -1;    ///< columns
  double assurance = 0.;    ///< MAC
  bool   reversed  = false; ///< the shapes have opposite signs
};

/**
 * Modes of two machines by what both tell of them: k measures (displacements, angles) of mass-normalised shapes,
 * A [k x a], B [k x b].  The apparent mass of a measure in the modes of A is that of its sum over these,
 *
 *     m_A,k = 1 / sum_j A_kj^2,     m_k = sqrt(m_A,k m_B,k),
 *
 * kg or kg m^2, so that metres and radians weigh as they do in the kinetic energy; with all modes and coordinates of
 * a diagonal M these are its masses.  Then
 *
 *     MAC_ij = (sum_k m_k A_ki B_kj)^2 / (sum_k m_k A_ki^2  sum_k m_k B_kj^2),     seen_i = sum_k m_A,k A_ki^2.
 *
 * With all modes, and measures that are the coordinates of a diagonal M, `seen` is the part of a mode's kinetic energy
 * that the measures tell.  Otherwise it is a weight, not a part: modes that are left out make masses too large.  Always
 *
 *     sum_i seen_i = number of measures that move,     0 <= seen_i <= that number,
 *
 * so that it exceeds 1 where modes are fewer than measures; a single mode seen by k measures has k.  A mode of which
 * they tell less than `least_seen` has no partner.  Partners are chosen, best for all pairs together, by MAC_ij seen_i
 * seen_j.
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

/// smallest share of a mode in the measured points by which it is compared; assurance from which two are one mode
constexpr double least_seen = 0.05, least_assurance = 0.5;

/// A measure that moves in no mode of either, or in those of one alone, does not count.
ModeComparison compare_modes(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);

} // namespace gestell::coupling
