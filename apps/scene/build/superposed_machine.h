#pragma once

#include "apps/scene/scene.h"
#include "coupling/modes/superposition.h"

namespace gestell::apps
{

/// A machine in modes p, and its relation q = V p to the original machine.
struct SuperposedMachine
{
  coupling::Machine        machine;
  Eigen::MatrixXd          V;              ///< [n x m]
  Eigen::MatrixXd          projection;     ///< [m x n] V^T M
  double                   largest_step;   ///< [s] 2 / omega_max with all elements in the stiffest branch of their laws
  double                   shortest_decay; ///< [s] of overdamped motions, 1 / lambda_max of V^T B V
  std::vector<std::string> statements, notes;
};

/// The machine in the modes requested by the scene, see coupling::superpose().
/// @param q  [n] configuration whose engaged elements are included in the averaged system
SuperposedMachine superposed(const Scene &scene, const coupling::Machine &whole, const Eigen::VectorXd &q);

/// Converts an initial state of the whole machine to the machine in modes; a state at rest becomes its equilibrium.
/// @param projection  of SuperposedMachine
coupling::InitialState start_in_modes(const Scene &scene, coupling::Machine &machine, const coupling::Machine &whole,
                                      const Eigen::MatrixXd &projection, const coupling::InitialState &start);

/// Limits the step of central differences to omega_max h <= 2, if the scene gives a longer one or none.
/// @param largest,  decay  [s] of the machine
/// @return a note for the user; empty: none
std::string keep_stable_step(double largest, double decay, RunRequest &run);

/// Rejects a steady initial state with rotating rotors.
void refuse_turning(const Scene &scene);

} // namespace gestell::apps
