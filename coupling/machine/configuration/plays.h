#pragma once

#include "coupling/machine/machine.h"
#include "mechanism/structure.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// The play of an element at a state, and its gradients by the coordinates of the machine.
struct PlacedPlay
{
  std::string                 name; ///< of the element
  const mechanism::Structure *structure;
  int                         first_measure, n_measures;
  mechanism::Play             play;
  bool                        chain; ///< closures() closes it, too
  Eigen::MatrixXd             G;     ///< [play.n x n]

  Eigen::VectorXd s() const { return Eigen::VectorXd::Map(play.s, play.n); }
  Eigen::VectorXd rate() const { return Eigen::VectorXd::Map(play.rate, play.n); }
  Eigen::VectorXd bias() const { return Eigen::VectorXd::Map(play.bias, play.n); }
};

/// Of all elements with play, the tightest first: of two that the same motion closes the wider one is a stop far away.
std::vector<PlacedPlay> plays(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

/// Threshold of the pivots of P [k x f], which rows of the size `whole` leave in free directions: rounding of the whole
/// rows.  1 or more: nothing free has a part in them.
double free_threshold(const Eigen::MatrixXd &P, double whole);

/**
 * Warnings of a start that closes a play at a speed that the machine's own motion does not explain: bodies on its two
 * sides strike while the machine hardly moves.
 *
 * @param v_given  [n] coordinates whose speed a scene gives; where it gives all of both sides, the impact is meant
 */
std::vector<std::string> closing_warnings(const Machine &machine, const std::vector<char> &v_given,
                                          const Eigen::VectorXd &q, const Eigen::VectorXd &v);

} // namespace gestell::coupling
