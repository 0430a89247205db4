#pragma once

#include "apps/scene/scene.h"
#include "coupling/modes/superposition.h"

namespace gestell::apps
{

/// A machine in modes p, and how it relates to the one it is made of, q = V p.
struct SuperposedMachine
{
  coupling::Machine        machine;
  Eigen::MatrixXd          V;              ///< [n x m]
  Eigen::MatrixXd          projection;     ///< [m x n] V^T M
  double                   largest_step;   ///< [s] 2 / omega_max with all elements in the stiffest branch of their laws
  double                   shortest_decay; ///< [s] of motions that dampers end alone, 1 / lambda_max of V^T B V
  std::vector<std::string> statements, notes;
};

/// The machine in the modes that the scene asks for, see coupling::superpose().
/// @param q  [n] configuration whose engaged elements are averaged
SuperposedMachine superposed(const Scene &scene, const coupling::Machine &whole, const Eigen::VectorXd &q);

/// A start of the whole machine in the modes of the other; at rest, in the equilibrium that these have.
/// @param projection  of SuperposedMachine
coupling::InitialState start_in_modes(const Scene &scene, coupling::Machine &machine, const coupling::Machine &whole,
                                      const Eigen::MatrixXd &projection, const coupling::InitialState &start);

/// A step of central differences that keeps omega_max h <= 2, where the scene gives a longer one or none.
/// @param largest, decay  [s] of the machine
/// @return what is to be said of it; empty: nothing
std::string keep_stable_step(double largest, double decay, RunRequest &run);

/// Refuses a steady start with rotors that turn.
void refuse_turning(const Scene &scene);

} // namespace gestell::apps
