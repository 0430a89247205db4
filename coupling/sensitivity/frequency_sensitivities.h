#pragma once

#include "coupling/modes/modes.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <vector>

namespace gestell::coupling
{

/// Where a machine is linearised: q, and the elements that are not engaged.
struct LinearisedAt
{
  const Machine                  *machine = nullptr;
  Eigen::VectorXd                 q;
  const std::vector<std::string> *open = nullptr;
};

/// The two machines of a parameter, step away on either side.
struct FrequencyTwins
{
  LinearisedAt minus, plus;
  double       step = 0.;
};

/**
 * Derivatives of the natural frequencies [Hz] of a linearised machine by parameters [modes x K], from its eigenvectors
 * v,
 *
 *     8 pi^2 f df/dx = v^T (K_x - omega^2 M_x) v + 2 v^T G_x^T mu,     K v - omega^2 M v + G^T mu = 0,
 *
 * G of the joints in the coordinates of the machine; matrices by x are central quotients, with the configuration that
 * belongs to each value.  nan: of frequencies that are zero, or that meet others.
 *
 * Source: Fox, Kapoor, AIAA Journal 6(12), 1968, 2426-2429, with constraints; docs/sensitivities.md (12).
 */
Eigen::MatrixXd frequency_sensitivities(const LinearisedAt &at, const std::vector<Mode> &modes,
                                        const std::vector<FrequencyTwins> &twins);

} // namespace gestell::coupling
