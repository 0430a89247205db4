#include "coupling/simulation/checks/instantaneous_modes.h"
#include "coupling/integration/system/state_archive.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "fem/values/two_pi.h"

#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
/// enough for a share in per cent; a tenth of a frequency is a fifth of a stiffness
constexpr double looks_of_a_run = 64., allowed_difference = 0.1;
} // namespace

InstantaneousModes::InstantaneousModes(const Machine &machine, const TimeIntegrator &integrator, double begin,
                                       double end)
    : machine_(machine), integrator_(integrator), averaged_(machine.superposed_frequencies()),
      pace_((end - begin) / looks_of_a_run), next_(begin + pace_)
{
  if (averaged_.size() == 0)
    return;
  M_ = dense_mass(machine);
  C_ = dense_stiffness(machine);
}

void InstantaneousModes::step()
{
  const LocalState &state = integrator_.local();
  if (averaged_.size() == 0 || state.t < next_)
    return;
  next_ = state.t + pace_;
  ++looks_;
  const auto     &W    = machine_.forces().directions();
  const auto      n_u  = W.cols();
  Eigen::VectorXd p    = Eigen::VectorXd::Zero(n_u);
  Eigen::MatrixXd by_u = Eigen::MatrixXd::Zero(n_u, n_u), by_v = by_u;
  machine_.forces().derivatives(state, p, by_u, by_v);
  const Eigen::MatrixXd K     = C_ - W * by_u * W.transpose();
  const DenseModes      now   = dense_modes(0.5 * (K + K.transpose()), M_);
  bool                  apart = false;
  for (Eigen::Index j = 0; j < std::min(averaged_.size(), now.omega.size()); ++j)
  {
    const double difference = std::abs(now.omega[j] / averaged_[j] - 1.);
    apart                   = apart || difference > allowed_difference;
    if (difference <= difference_)
      continue;
    difference_ = difference;
    mode_       = int(j) + 1;
    t_          = state.t;
    omega_      = now.omega[j];
  }
  apart_ += apart ? 1 : 0;
}

void InstantaneousModes::finish(RunOutcome &outcome)
{
  if (apart_ == 0)
    return;
  std::ostringstream text;
  text.precision(3);
  text << "modal superposition: the modes are those of the averaged machine; at " << 100 * apart_ / looks_ << " % of "
       << looks_ << " instants the actual frequencies differed by more than " << 100. * allowed_difference
       << " %, most for mode " << mode_ << " at t = " << t_ << " s with " << omega_ / two_pi << " Hz instead of "
       << averaged_[mode_ - 1] / two_pi
       << " Hz; check that more modes do not change the result (modes.open lists contacts that are usually open), or "
          "use method = \"craig-bampton\"";
  outcome.warn("instantaneous-modes", "mode " + std::to_string(mode_), text.str());
}

void InstantaneousModes::exchange(StateArchive &archive)
{
  archive(next_, looks_, apart_, mode_, t_, omega_, difference_);
}

} // namespace gestell::coupling
