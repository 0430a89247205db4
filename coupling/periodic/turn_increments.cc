#include "coupling/periodic/turn_increments.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double still      = 1e-9; ///< speed of what does not turn, of the speeds that it is the difference of
constexpr double not_at_all = 1e-9; ///< share of a coordinate in a shift of unit length

/// Speeds of the angles as everything that never repeats allows them.
class TurningAngles
{
public:
  TurningAngles(const AngleInvariance &invariance, const VectorXd &speeds, double tolerance, const LinearSystem &names)
      : invariance_(invariance), names_(names), tolerance_(tolerance), given_(speeds(invariance.angles())),
        none_(VectorXd::Zero(Index(invariance.dependences().size()))), omega_(invariance.nearest(given_, none_, true))
  {
  }

  /// Turns of dependence d in a second, and those of its terms.
  double rate(const AngleDependence &d) const { return d.of.dot(omega_) / (2. * M_PI); }
  double size(const AngleDependence &d) const { return d.of.cwiseAbs().dot(omega_.cwiseAbs()) / (2. * M_PI); }
  bool   turns(const AngleDependence &d) const { return d.turns > 0 && std::abs(rate(d)) > still * size(d); }

  const VectorXd &omega() const { return omega_; }

  /// Increments in `period`; false: they are not whole turns, and `why` says which.
  bool increments(double period, VectorXd &increments, std::string &why) const
  {
    VectorXd whole = none_;
    for (std::size_t k = 0; k < invariance_.dependences().size(); ++k)
    {
      const AngleDependence &d = invariance_.dependences()[k];
      if (d.turns == 0)
        continue;
      const double turns = rate(d) * period, nearest = d.turns * std::round(turns / d.turns);
      if (std::abs(turns - nearest) > tolerance_ * size(d) * period)
      {
        why = of_turns(d, turns, period);
        return false;
      }
      whole[Index(k)] = 2. * M_PI * nearest;
    }
    increments = invariance_.nearest(omega_ * period, whole);
    for (std::size_t k = 0; k < invariance_.dependences().size(); ++k)
    {
      const AngleDependence &d          = invariance_.dependences()[k];
      constexpr double       consistent = 1e-9; // turns: rounding of sums of numbers up to 64
      if (std::abs(d.of.dot(increments) - whole[Index(k)]) <= 2. * M_PI * consistent * (1. + size(d) * period))
        continue;
      why = of_turns(d, rate(d) * period, period);
      return false;
    }
    return true;
  }

  std::string name(const AngleDependence &d) const
  {
    std::string text;
    for (Index k = 0; k < d.of.size(); ++k)
      if (d.of[k] != 0.)
        text += (text.empty() ? "" : " and ") + names_.coordinate_name(invariance_.angles()[std::size_t(k)]);
    return text;
  }

private:
  std::string of_turns(const AngleDependence &d, double turns, double period) const
  {
    std::ostringstream text;
    text.precision(6);
    text << name(d) << ", on which " << d.element << " depends, makes " << turns << " revolutions in " << period
         << " s";
    return text.str();
  }

  const AngleInvariance &invariance_;
  const LinearSystem    &names_;
  double                 tolerance_;
  VectorXd               given_, none_, omega_;
};

VectorXd on_all(const AngleInvariance &invariance, const VectorXd &of_angles, Index n)
{
  VectorXd all             = VectorXd::Zero(n);
  all(invariance.angles()) = of_angles;
  return all;
}

/// Nothing depends on a single angle that turns: the slowest comes round once.
void turn_freely(const AngleInvariance &invariance, const TurningAngles &angles, AngleIncrements &found)
{
  const VectorXd omega = on_all(invariance, angles.omega(), found.turn.size());
  const double   least = still * omega.cwiseAbs().maxCoeff();
  for (const int i : invariance.angles())
    if (std::abs(omega[i]) > least && found.free.row(i).norm() > not_at_all &&
        (found.phase < 0 || std::abs(omega[i]) < std::abs(omega[found.phase])))
      found.phase = i;
  if (found.phase < 0)
    return;
  found.period            = 2. * M_PI / std::abs(omega[found.phase]);
  found.turn              = found.period * omega;
  found.turn[found.phase] = std::copysign(2. * M_PI, omega[found.phase]);
  found.free              = without_coordinate(found.free, found.phase);
}

/// The coordinate whose angle tells the turn of a dependence.
int phase_of(const AngleInvariance &invariance, const AngleDependence &d, const MatrixXd &free)
{
  int    phase   = -1;
  double largest = 0.;
  for (Index k = 0; k < d.of.size(); ++k)
    if (const int i = invariance.angles()[std::size_t(k)];
        std::abs(d.of[k]) > largest && free.row(i).norm() <= not_at_all)
    {
      phase   = i;
      largest = std::abs(d.of[k]);
    }
  return phase;
}

} // namespace

AngleIncrements increments_of(const AngleInvariance &invariance, const VectorXd &speeds, double period,
                              double tolerance, const LinearSystem &names)
{
  AngleIncrements found{VectorXd::Zero(speeds.size()), invariance.free(), 0., -1, ""};
  if (invariance.angles().empty())
    return found;
  const TurningAngles angles(invariance, speeds, tolerance, names);
  VectorXd            increments;
  if (period > 0.)
  {
    if (angles.increments(period, increments, found.refusal))
      found.turn = on_all(invariance, increments, speeds.size());
    return found;
  }
  const AngleDependence *slowest = nullptr;
  for (const AngleDependence &d : invariance.dependences())
    if (angles.turns(d) && (!slowest || std::abs(angles.rate(d)) < std::abs(angles.rate(*slowest))))
      slowest = &d;
  if (!slowest)
  {
    turn_freely(invariance, angles, found);
    return found;
  }
  found.phase = phase_of(invariance, *slowest, found.free);
  if (found.phase < 0)
  {
    found.refusal = slowest->element + " depends on " + angles.name(*slowest) +
                    " together, but none of these angles alone determines when a revolution is complete";
    return found;
  }
  std::string   first_why;
  constexpr int most_turns_of_period = 64; // of the slowest angle: a longer common period is none that a run shows
  for (int turns = 1; turns <= most_turns_of_period; ++turns)
  {
    std::string why;
    found.period = turns / std::abs(angles.rate(*slowest));
    if (angles.increments(found.period, increments, why))
    {
      found.turn = on_all(invariance, increments, speeds.size());
      return found;
    }
    if (turns == 1)
      first_why = why;
  }
  found.refusal = "the rotating bodies have no common period of up to " + std::to_string(most_turns_of_period) +
                  " revolutions of " + angles.name(*slowest) + ": " + first_why;
  return found;
}

} // namespace gestell::coupling
