#pragma once

#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/newmark/one_step.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>

namespace gestell::tests
{

/// The method that a reference table calls so; none for one that Gestell has not.
std::optional<coupling::MethodOptions> named_method(const std::string &name);

/// The same as an integrator with steps h.
std::unique_ptr<coupling::OneStep> one_step_method(const std::string &name, const coupling::SecondOrderSystem &system,
                                                   double h);

/// Order of "bdf3", "bdf3(order ramp 1..3)"; 0 if it is no BDF.
int bdf_order(const std::string &name);

/**
 * What one step of size h of the integrator does to the oscillator x'' + 2 zeta omega x' + omega^2 x = 0: column j is
 * the state that the integrator itself makes of the j-th unit state.
 *
 * The state is (q, v/omega, a/omega^2) for one-step methods, and (q_0, v_0/omega, q_-1, v_-1/omega, ...) for BDF.
 */
Eigen::MatrixXd step_map(const std::string &name, double zeta, double omega_h);

} // namespace gestell::tests
