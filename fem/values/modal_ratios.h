#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// A damping ratio of one elastic mode by its number, of all modes in an interval of frequencies, or of a measured
/// mode, whose counterpart in the frame is found by frequency and shape (coupling::matched()).
struct NamedRatio
{
  double                             ratio = 0.;
  int                                mode  = -1;         ///< from 0; -1: not by number
  double                             from = 0., to = 0.; ///< [Hz] from <= f < to; equal: of a measured mode
  std::vector<std::array<double, 3>> points{};           ///< [m] of a measured shape, or none
  Eigen::VectorXcd                   shape{};            ///< [3 points] of it; 0: not measured
  std::string                        place{};            ///< for messages

  bool is_measured() const { return mode < 0 && from == to; }
};

/**
 * Damping ratios zeta, the shares of critical damping, of the elastic modes of a supported frame: a term 2 zeta omega
 * in each modal equation.
 *
 * One ratio for all modes, or a table over the frequency, linear between its rows and constant beyond them; in place of
 * these the named ones, a number before an interval.
 */
struct ModalRatios
{
  ModalRatios() = default;
  ModalRatios(double zeta) : constant(zeta) {} // NOLINT: a number is the same ratio for all modes

  double                                 constant = 0.;
  std::vector<NamedRatio>                named;        ///< measured ones count only when matched()
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
