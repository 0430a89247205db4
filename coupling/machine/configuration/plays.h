#pragma once

#include "coupling/machine/machine.h"
#include "mechanism/structure.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The clearance of an element at a state, and its gradients with respect to the coordinates of the machine.
struct PlacedPlay
{
  std::string                 name; ///< of the element
  const mechanism::Structure *structure;
  int                         first_measure, n_measures;
  mechanism::Play             play;
  bool                        chain; ///< closures() also closes it
  Eigen::MatrixXd             G;     ///< [play.n x n]

  Eigen::VectorXd s() const { return Eigen::VectorXd::Map(play.s, play.n); }
  Eigen::VectorXd rate() const { return Eigen::VectorXd::Map(play.rate, play.n); }
  Eigen::VectorXd bias() const { return Eigen::VectorXd::Map(play.bias, play.n); }
};

/// Clearances of all elements, the tightest first: if the same motion closes two, the wider one is a distant stop.
std::vector<PlacedPlay> plays(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

/// Threshold for the pivots of P [k x f], the part of rows of the size `whole` in free directions: the rounding of the
/// whole rows.  1 or more: they have no part in free directions.
double free_threshold(const Eigen::MatrixXd &P, double whole);

/**
 * Warnings of an initial state that closes a clearance at a speed that the machine's motion does not explain: an impact
 * although the machine barely moves.
 *
 * @param v_given  [n] coordinates whose speed the scene gives; if it gives all of both sides, the impact is intended
 */
std::vector<std::string> closing_warnings(const Machine &machine, const std::vector<char> &v_given,
                                          const Eigen::VectorXd &q, const Eigen::VectorXd &v);

} // namespace gestell::coupling
