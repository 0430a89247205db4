#pragma once

#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Stiffness k, damping d and mass m of one element along its stiffest direction, as if it were the only connection
 * between its two bodies: scales for the magnitudes of its parameters.
 */
struct ElementScale
{
  std::string name;
  double      stiffness = 0., damping = 0., mass = 0.; ///< N/m, N s/m, kg, or N m/rad, N m s/rad, kg m^2

  double frequency_hz() const; ///< sqrt(k / m) / 2 pi; 0: no mass or no stiffness
  double ratio() const;        ///< d / 2 sqrt(k m); 0: no mass or no stiffness
};

/// Effective mass for a measure u = w . q on its own, m = 1 / sum w_i^2 / M_ii; 0 if there is none or it is massless.
double mass_on(const Machine &machine, const Measure &w);

/// Scales of all elements that have stiffness when engaged at q [n].
std::vector<ElementScale> element_scales(const Machine &machine, const Eigen::VectorXd &q);

} // namespace gestell::coupling
