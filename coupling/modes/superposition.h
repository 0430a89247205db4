#pragma once

#include "coupling/machine/machine.h"
#include "coupling/machine/modal_coordinates.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

struct SuperpositionOptions
{
  int                      n_modes   = -1; ///< below zero: chosen by `frequency`, the loads or `tolerance`
  double                   frequency = 0.; ///< [Hz] upper limit of the retained modes; 0: four times that of the loads
  double                   tolerance = 0.; ///< of static deflections; 0: 0.01 for forces of unknown frequency
  bool                     diagonal_damping = false; ///< couplings of modes are omitted
  std::vector<std::string> open{};                   ///< elements that the averaged system has open
  std::string              place{};                  ///< prefix of messages: "portal.toml:60: reduction"
};

/// The modes of a superposition, and their truncation error.
struct Superposition
{
  ModalCoordinates         modes;
  double                   static_residual = 0.; ///< largest missing share of a static deflection
  double                   coupling        = 0.; ///< of damping: largest |b_ij| / sqrt(b_ii b_jj), i != j
  std::vector<std::string> statements{}, notes{};
};

/// Checks that need no modes: joints, virtual coordinates, driven rotors.
/// @throws std::invalid_argument with the name of the object
void check_superposition(const Machine &machine, const std::string &place);

/**
 * Modes of the averaged system, the base with the stiffness of all elements engaged at q as in linearised_modes(),
 *
 *     (C + W K_e W^T - omega^2 M) v = 0,     q = V p,     V^T M V = E,
 *
 * up to four times the highest frequency of the loads. Their static deflections along the directions w of elements and
 * loads are short of the full ones by
 *
 *     1 - sum_j (w.v_j)^2 / omega_j^2  /  w^T (C + W K_e W^T)^-1 w,
 *
 * which `tolerance` limits; a note is added if it exceeds a twentieth.
 *
 * Source: (5.5.3/8 to 13); docs/theory/reduction.md, "Modal superposition".
 *
 * @param machine  dense or on an unreduced frame
 * @throws std::invalid_argument if the eigenproblem is singular or coordinates do not vibrate: ideal joints, virtual
 *         coordinates, coordinates without mass, rigid-body modes such as an unloaded drive, with their names; also for
 *         more modes than coordinates, or none.
 */
Superposition superpose(const Machine &machine, const Eigen::VectorXd &q, const SuperpositionOptions &options);

} // namespace gestell::coupling
