#pragma once

#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/// Closed elements linearised at q: g + J dq = 0, and the acceleration of the closure along v, v^T g'' v.
struct Closures
{
  Eigen::VectorXd g, curvature; // [n_c]
  Eigen::MatrixXd J;            // [n_c x n]
};
Closures closures(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

/// Smallest change x [n] of the sliders alone that satisfies J x = b.
Eigen::VectorXd slider_solution(const Machine &machine, const Eigen::MatrixXd &J, const Eigen::VectorXd &b);

/// q with the sliders moved until the chains of closed elements just touch, g(q) = 0: a rod without force.
void close_chains(const Machine &machine, Eigen::VectorXd &q);

} // namespace gestell::coupling
