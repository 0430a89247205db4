#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/checks/oscillator_bank.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Estimates the effect of a reduced frame's frequencies, which are too high, on the deflections of a run.
 *
 * Modes phi_k of the supported frame respond to the forces f(t) as oscillators y_k.  In the reduced frame they have the
 * frequencies omega_k, in the full one about omega'_k, refined_hz().  Because the statics of both are the same, the
 * deflection along a direction w has the error
 *
 *     e(t) = sum_k (w.phi_k) / omega_k^2  (y_k[omega_k] - y_k[omega'_k]),     y_k'' + 2 zeta_k omega y_k' + omega^2 y_k
 *                                                                               = omega^2 phi_k.f(t).
 *
 * f are the forces of elements, joints, loads and base springs.  If steps are shorter than 1/32 of a period of the
 * frequency limit f, forces are averaged over that interval (loads at its middle, springs as the mean of both ends): 16
 * samples in a period at 2 f.  Masses carried by the frame are not included in its modes.
 *
 * Source: docs/theory/reduction.md (16f).
 */
class ForceBandwidthCheck : public RunObserver
{
public:
  ForceBandwidthCheck(const Machine &machine, const TimeIntegrator &integrator);

  void begin() override; ///< forces at the start are assumed static
  void step() override;
  void event(const Event &) override;
  void finish(RunOutcome &outcome) override; ///< one for all points where over 5 % of a deflection is uncertain
  void exchange(StateArchive &archive) override;

private:
  static constexpr int n_ranges = 4; ///< f, 2 f, 4 f, 8 f: the remaining error with a larger range

  /// A point where a force acts on the frame: a measure of an element, or base springs between a coordinate and bodies.
  struct Place
  {
    std::string     name;
    Eigen::VectorXd direction; ///< w [n_f]
    int             measure;   ///< -1: the force is spring.q + damper.v
    Eigen::VectorXd spring{}, damper{};
    double          above = 0.; ///< share of the flexibility along w due to modes above f
  };

  void take_forces(const Machine &machine, const Eigen::MatrixXd &W, const Eigen::MatrixXd &springs,
                   const Eigen::MatrixXd &dampers);
  void take_modes(const ReducedFrame &frame);

  /// phi_k.f for the oscillators of the model, then for the refined ones.
  /// @param p  forces of the measures
  /// @param t  time of the loads; if it is before now, base springs have the mean of their forces at the last
  ///   evaluation and now
  const Eigen::ArrayXd  &inputs(const Eigen::VectorXd &p, double t);
  const Eigen::VectorXd &measured() const { return integrator_.local().p; }
  double                 force_on(const Place &place) const;
  void                   look();
  double                 doubt(std::size_t place, int range) const;

  const TimeIntegrator &integrator_;
  const Excitation     *excitation_ = nullptr; ///< if it changes with time
  double                limit_      = 0.;      ///< f [Hz]
  double                pace_       = 0.;      ///< [s] between two evaluations, if steps are shorter
  double                t_ = 0., t_step_ = 0.; ///< of the last evaluation; of the last step
  Eigen::VectorXd       impulse_, p_;          ///< of the measures' forces since the last evaluation; at the last step
  std::vector<Place>    places_;
  Eigen::MatrixXd       shapes_;                     ///< (w_i.phi_k) / omega_k^2 [places x modes]
  Eigen::MatrixXd       by_measures_, by_loads_;     ///< phi_k.f per p [modes x n_u], per f_t [modes x n]
  Eigen::MatrixXd       by_motion_, by_rates_;       ///< of base springs, dampers, per q, v of sprung_
  std::vector<int>      sprung_;                     ///< coordinates of base springs
  Eigen::Index          first_[n_ranges] = {};       ///< first mode that is not exact with the range
  OscillatorBank        bank_;                       ///< of the model, then the refined ones
  Eigen::VectorXd       sprung_before_, sprung_now_; ///< phi_k.f of base springs at the last evaluation, and now
  Eigen::VectorXd       force_, load_, at_rest_;     ///< phi_k.f; f_t; deflections at the beginning
  Eigen::VectorXd       sum_, difference_;
  Eigen::ArrayXd        input_;
  Eigen::ArrayXd        deflection_, least_, most_; ///< largest change of deflections; forces along them
  Eigen::ArrayXXd       error_;                     ///< largest e(t) [places x n_ranges]
};

} // namespace gestell::coupling
