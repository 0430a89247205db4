#pragma once

#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/newmark/one_step.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace gestell::tests
{

/// Methods of the reference tables by the names they have there; empty for one that Gestell has not.
std::unique_ptr<coupling::OneStep> one_step_method(const std::string &name, const coupling::SecondOrderSystem &system,
                                                   double h);

/// Order of "bdf3", "bdf3(order ramp 1..3)"; 0 if it is no BDF.
int bdf_order(const std::string &name);

/// True: the integrators here know the method.
bool has_method(const std::string &name);

/**
 * What one step of size h of the integrator does to the oscillator x'' + 2 zeta omega x' + omega^2 x = 0: column j is
 * the state that the integrator itself makes of the j-th unit state.
 *
 * The state is (q, v/omega, a/omega^2) for one-step methods, and (q_0, v_0/omega, q_-1, v_-1/omega, ...) for BDF.
 */
Eigen::MatrixXd step_map(const std::string &name, double zeta, double omega_h);

/// Eigenvalues of a matrix whose rows may differ in scale by many orders.
std::vector<std::complex<double>> roots(Eigen::MatrixXd map);

/// max |root|.
double spectral_radius(const std::string &name, double zeta, double omega_h);

} // namespace gestell::tests
