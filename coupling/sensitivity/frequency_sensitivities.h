#pragma once

#include "coupling/modes/modes.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Linearisation point of a machine: q, and the elements that are not engaged.  It is independent of any run: modes use
/// the laws for the motion, not the branches of a run.
struct LinearisedAt
{
  const Machine                  *machine = nullptr;
  Eigen::VectorXd                 q;
  const std::vector<std::string> *open = nullptr;
};

/// The two machines of a parameter, at -step and +step.
struct FrequencyTwins
{
  LinearisedAt minus, plus;
  double       step = 0.;
};

/// Why the frequency of mode j has no derivative; empty if it has one.
std::string without_derivative(const std::vector<Mode> &modes, std::size_t j);

/**
 * Derivatives of the natural frequencies [Hz] of a linearised machine by parameters [modes x K], from its eigenvectors
 * v,
 *
 *     8 pi^2 f df/dx = w^T (K_x - omega^2 M_x) v + w^T G_x^T mu + v^T G_x^T mu_w,     K v - omega^2 M v + G^T mu = 0,
 *
 * with G of the joints in the coordinates of the machine; w is v, or if K is not symmetric the left eigenvector, w^T M
 * v = 1, with its own multipliers mu_w.  Derivatives of matrices are central quotients, with the configuration for each
 * value; K, M and G are their means.  nan for those with without_derivative().
 *
 * Source: Fox, Kapoor, AIAA Journal 6(12), 1968, 2426-2429, with constraints; docs/theory/sensitivities.md (12).
 */
Eigen::MatrixXd frequency_sensitivities(const std::vector<Mode> &modes, const std::vector<FrequencyTwins> &twins);

} // namespace gestell::coupling
