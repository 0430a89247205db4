#pragma once

#include "coupling/integration/integration_method.h"
#include "coupling/integration/propagation/force_rule.h"

namespace gestell::coupling
{

/// Modal propagation, "exact" in scenes: exact for the base system, with a ForceRule for the elements.
const IntegrationMethod &propagation_method();

using LongMatrix2 = Eigen::Matrix<long double, 2, 2>;

/// Step (x, h x') of a free mass with the spring and damper of an element under exact propagation, where the element's
/// force is the polynomial through its values at Gauss points c_i:
///
///     p_i = -(Omega^2 u_i + 2 zeta Omega h u'_i),   u_i = u_0 + c_i h u'_0 + sum_j p_j int_0^c_i (c_i - s) L_j(s) ds.
LongMatrix2 contact_step(int order, const TestOscillator &oscillator);

} // namespace gestell::coupling
