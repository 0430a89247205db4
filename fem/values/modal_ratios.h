#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/**
 * Damping ratios zeta, the shares of critical damping, of the elastic modes of a supported frame: a term 2 zeta omega
 * in each modal equation.
 *
 * Either one ratio for all modes, or ratios of the modes 1, 2, ... (the last one also for all higher modes), or a table
 * over the frequency, linear between its rows and constant beyond them.
 */
struct ModalRatios
{
  ModalRatios() = default;
  ModalRatios(double zeta) : constant(zeta) {} // NOLINT: a number is the same ratio for all modes

  double                                 constant = 0.;
  std::vector<double>                    by_mode;
  std::vector<std::pair<double, double>> by_frequency; ///< [Hz], zeta; frequencies ascending

  bool any() const; ///< whether some mode is damped

  /// zeta of the elastic mode number `mode`, from 0, with the natural frequency omega [rad/s].
  double at(int mode, double omega) const;

  /// 2 zeta omega [rad/s] of modes in ascending order; rigid-body modes, omega = 0, have none and are not counted.
  Eigen::VectorXd modal_dampers(const Eigen::VectorXd &omega) const;

  /// For people: "2 % of critical in every mode of the frame".
  std::string text() const;
};

} // namespace gestell::fem
