#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct LinearisedSystem;

/// A motion about which a system is linear for small vibrations.
struct OperatingPoint
{
  LocalState      local; ///< motion of the measures, with multipliers; branches by the history of the events
  Eigen::MatrixXd joint_stiffness{}; ///< [n_u x n_u] -d(G^T lambda)/du at constant lambda; empty: joints have none
};

/// Complex amplitudes of a vibration about the operating point, a column per force.
struct Vibration
{
  double           omega = 0.; ///< [rad/s]
  Eigen::MatrixXcd q;          ///< [n x columns]
  Eigen::MatrixXcd p;          ///< [n_u x columns] forces of elements and joints in their measures
  Eigen::MatrixXcd lambda;     ///< [n_c x columns] multipliers of the joints
};

/// A scalar of the motion in first order; weights without entries are zero.
struct LinearAnswer
{
  Eigen::VectorXd q, v, a; ///< [n] of q, q', q''
  Eigen::VectorXd p;       ///< [n_u] of the forces in the measures
  Eigen::VectorXd lambda;  ///< [n_c] of the multipliers

  /// Its amplitude in a column of a vibration.
  std::complex<double> of(const Vibration &vibration, Eigen::Index column) const;
};

/**
 * The response of a machine to small harmonic forces F e^(i w t), linearised at an operating point:
 *
 *     (-w^2 M + i w B + C) q = F + W p,     p = -D(w) u + E^T mu,     E u = 0,     u = W^T q,
 *     D(w) = -dp/du - i w dp/dv + w^2 dp/da + (stiffness of the joints' forces),
 *
 * with the rows E = [G; unit vectors] of ideal joints and of what sticks.  Condensed to the measures by the base's
 * receptance Y = W^T (-w^2 M + i w B + C)^-1 W in its modes,
 *
 *     [ 1 + Y D   -Y E^T ] [ u  ]   [ u_F ]
 *     [    E         0   ] [ mu ] = [  0  ],     u_F = W^T (-w^2 M + i w B + C)^-1 F,
 *
 * and refined with residuals in extended precision, so that the result is as accurate as the matrices.  Where the
 * base has no modes (a coordinate without mass) or is driven at a natural frequency, the whole equations are solved.
 *
 * Coefficients are those of the instant, without excitation, events and gyroscopic changes over time.
 *
 * Source: docs/theory/frequency_response.md (1) to (4).
 */
class LinearResponse
{
public:
  /// @throws std::invalid_argument if the base system is sparse, or forces depend on the multipliers of joints
  LinearResponse(const SecondOrderSystem &system, const OperatingPoint &point);
  ~LinearResponse();
  LinearResponse(LinearResponse &&) noexcept;

  /// @param omega   > 0 [rad/s]
  /// @param forces  F [n x columns]
  /// @throws ConvergenceFailure if the machine has an undamped mode at omega
  Vibration at(double omega, const Eigen::MatrixXd &forces) const;

  const LinearisedSystem &parts() const { return *parts_; }

  /// Why the whole equations are solved at every frequency; empty: they are condensed.
  const std::string &not_condensed() const;

  /// Growing motions exp(s t) about the operating point; nothing if unknown, see unstable_modes().
  std::optional<std::vector<std::complex<double>>> growing() const;

private:
  std::unique_ptr<LinearisedSystem> parts_;
};

} // namespace gestell::coupling
