#pragma once

#include "coupling/periodic/response/linear_response.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// x' = A x + B u,  y = C x + D u,  with x = (r, r') and q = Z r.
struct StateSpace
{
  Eigen::MatrixXd A, B, C, D;
  Eigen::MatrixXd Z; ///< [n x m] motions allowed by joints and sticking elements; the unit matrix without constraints
  bool            bound = false;
};

/**
 * The machine of a LinearResponse as a system of first order:
 *
 *     M_r r'' + B_r r' + C_r r = Z^T F u,      M_r = Z^T (M + W M_u W^T) Z  and B_r, C_r alike,      E W^T Z = 0,
 *
 * with answers in q, q', q'' and in the forces p and multipliers, which follow from the balance of all coordinates,
 *
 *     G^T mu = M q'' + B q' + C q - F u,      G = E W^T,      p = -(K_u u + B_u u' + M_u u'') + E^T mu.
 *
 * @param forces   F [n x inputs]
 * @param answers  outputs
 * @throws std::invalid_argument if a free motion has no mass, which is not of this form
 *
 * Source: docs/theory/frequency_response.md (1), (2), (5).
 */
StateSpace state_space(const LinearResponse &machine, const Eigen::MatrixXd &forces,
                       const std::vector<LinearAnswer> &answers);

} // namespace gestell::coupling
