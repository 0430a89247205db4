#include "coupling/modes/modes_along.h"

#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/machine/configuration/loop_closure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

struct Position
{
  InitialState state; ///< closed, and deflected if there is an equilibrium
  ModesAt      modes;
};

class Sweep
{
public:
  Sweep(Machine &machine, const SweptCoordinate &coordinate, const AlongOptions &options)
      : machine_(machine), coordinate_(coordinate), options_(options),
        step_((options.to - options.from) / (options.positions - 1)), mass_(dense_mass(machine))
  {
    for (const Body &body : machine.model().bodies())
      slides_ = slides_ || (body.kind == BodyKind::slider && body.coordinate == coordinate.coordinate);
  }

  ModesAlong result(const InitialState &start, const std::function<void(double)> &progress)
  {
    ModesAlong along;
    along.coordinate = coordinate_;
    Position last    = walk_to_first(start);
    for (int k = 0; k < options_.positions; ++k)
    {
      const double x = options_.from + k * step_;
      try
      {
        Position next = at(x, last, true);
        follow(last, next);
        along.positions.push_back(next.modes);
        last = std::move(next);
      }
      catch (const std::invalid_argument &error)
      {
        along.positions.push_back(gap_at(x, error.what()));
      }
      catch (const ConvergenceFailure &error)
      {
        along.positions.push_back(gap_at(x, error.what()));
      }
      if (progress)
        progress(double(k + 1) / options_.positions);
    }
    if (last.modes.modes.empty())
    {
      const std::string &gap = along.positions.front().gap;
      std::ostringstream at_start;
      at_start << "; at the start of the scene it is " << swept_value(machine_, coordinate_, start.q) << " "
               << coordinate_.unit << "; choose a range around that, or another coordinate or measure";
      throw std::invalid_argument(
          "--along " + coordinate_.name + ": no position has modes; " +
          (gap.empty() ? "joints and fixed coordinates leave no DOF" : "the first: " + gap + at_start.str()));
    }
    for (ModesAt &one : along.positions)
      one.modes.resize(std::min(one.modes.size(), std::size_t(options_.lines)));
    describe_lines(along);
    along.linearisations = linearisations_;
    return along;
  }

private:
  static ModesAt gap_at(double x, const std::string &reason)
  {
    ModesAt gap;
    gap.x   = x;
    gap.gap = reason;
    return gap;
  }

  /// The position x, from one nearby.
  Position at(double x, const Position &from, bool damping)
  {
    Position next;
    next.modes.x             = x;
    next.modes.configuration = Configuration::undeformed;
    next.state               = assembled(x, from);
    if (!has_joints(machine_))
      turn_along(x - from.modes.x, next.state);
    if (!slides_) // sliders close the chains: a fixed one cannot
      close_chains(machine_, next.state.q);
    Linearisation how = options_.linearisation;
    how.damping       = damping;
    how.acting        = Acting::structure;
    if (options_.configuration == Configuration::equilibrium)
      try
      {
        const HeldEquilibrium held = held_equilibrium(machine_, position_at(machine_, coordinate_, next.state, x));
        next.state.q               = held.q;
        how.multipliers            = held.lambda;
        next.modes.configuration   = Configuration::equilibrium;
      }
      catch (const std::invalid_argument &error)
      {
        next.modes.no_equilibrium = error.what();
        next.state                = relaxed(next.state, x);
      }
    constexpr int spare_modes = 10; // above the lines, so that a line may rise past others
    next.modes.modes          = linearised_modes(machine_, next.state.q, how, options_.lines + spare_modes);
    double highest            = 0.;
    for (const Mode &mode : next.modes.modes)
      highest = std::max(highest, mode.frequency_hz);
    constexpr double none = 1e-9; // frequency relative to the highest one, below which it is rounding of zero
    for (Mode &mode : next.modes.modes)
      if (mode.frequency_hz < none * highest)
        mode.frequency_hz = 0.;
    ++linearisations_;
    return next;
  }

  /// The assembled state with the frame undeformed.
  InitialState relaxed(InitialState state, double x)
  {
    state.q.head(machine_.model().n_frame()).setZero();
    state = assemble(machine_, position_at(machine_, coordinate_, state, x));
    if (!slides_)
      close_chains(machine_, state.q);
    return state;
  }

  /// Moves the machine from its start to the first position in steps.
  Position walk_to_first(const InitialState &start)
  {
    Position last{start, {}};
    last.modes.x = swept_value(machine_, coordinate_, start.q);
    if (options_.configuration == Configuration::undeformed)
      last.state.q.head(machine_.model().n_frame()).setZero();
    const double way   = options_.from - last.modes.x;
    const int    parts = int(std::abs(way / step_));
    try
    {
      for (int k = 1; k <= parts; ++k)
        last = at(options_.from - way + k * way / (parts + 1), last, false);
    }
    catch (const std::invalid_argument &)
    {
      // an obstacle is reported at the positions after it
    }
    catch (const ConvergenceFailure &)
    {
    }
    last.modes.modes.clear();
    return last;
  }

  /// The deflection of the frame at the last position may hold bodies of a plane apart at the next: they are then
  /// assembled on the undeformed frame.
  InitialState assembled(double x, const Position &from)
  {
    try
    {
      return assembled_on_its_frame(x, from);
    }
    catch (const std::invalid_argument &)
    {
      Position undeformed = from;
      undeformed.state.q.head(machine_.model().n_frame()).setZero();
      return assembled_on_its_frame(x, undeformed);
    }
  }

  /// Assembles in steps, which keep a linkage on its branch, or directly if an obstacle prevents that.
  InitialState assembled_on_its_frame(double x, const Position &from)
  {
    // [rad] of a step on the way to a position: 5 degrees, in which Newton's method follows joints
    constexpr double longest_turn = 0.09;
    const double     longest = coordinate_.unit == "rad" ? std::min(longest_turn, std::abs(step_)) : std::abs(step_);
    const double     begin   = from.modes.x;
    const int        parts   = std::max(1, int(std::ceil(std::abs(x - begin) / longest - 1e-9)));
    try
    {
      InitialState state = from.state;
      for (int k = 1; k <= parts; ++k)
        state = assemble(machine_, position_at(machine_, coordinate_, state, begin + (x - begin) * k / parts));
      return state;
    }
    catch (const std::invalid_argument &)
    {
      if (parts == 1)
        throw;
      return assemble(machine_, position_at(machine_, coordinate_, from.state, x));
    }
  }

  /// Without joints nothing rotates the other rotors with the crank: all rotate by the same angle.
  void turn_along(double angle, InitialState &state) const
  {
    const auto is_rotor = [](const Body &body) { return body.kind == BodyKind::rotor; };
    const auto swept    = [this](const Body &body) { return body.coordinate == coordinate_.coordinate; };
    const auto bodies   = machine_.model().bodies();
    if (std::none_of(bodies.begin(), bodies.end(), [&](const Body &body) { return is_rotor(body) && swept(body); }))
      return;
    for (const Body &body : bodies)
      if (is_rotor(body) && !swept(body))
        state.q[body.coordinate] += angle;
  }

  void follow(const Position &last, Position &next)
  {
    const std::size_t lines = std::min(next.modes.modes.size(), std::size_t(options_.lines));
    next.modes.assurance.assign(lines, std::numeric_limits<double>::quiet_NaN());
    if (last.modes.modes.empty())
      return;
    TrackingOptions tracking;
    tracking.lines = options_.lines;
    if (std::abs(next.modes.x - last.modes.x) > 1.5 * std::abs(step_)) // there is nothing between after a gap
      tracking.most_halving = 0;
    const TrackedModes before{last.modes.x, last.modes.modes, {}};
    TrackedModes       after{next.modes.x, next.modes.modes, {}};
    track(before, after, mass_, tracking, [&](double x) { return at(x, last, false).modes.modes; });
    next.modes.modes     = std::move(after.modes);
    next.modes.assurance = std::move(after.assurance);
  }

  void describe_lines(ModesAlong &along) const
  {
    for (const ModesAt &at : along.positions)
      for (std::size_t i = 0; i < at.modes.size(); ++i)
      {
        const Mode &mode = at.modes[i];
        if (i == along.free.size())
        {
          Eigen::Index most = 0;
          mode.shape.cwiseProduct(mass_ * mode.shape).maxCoeff(&most);
          along.moves_most.push_back(machine_.coordinate_name(int(most)));
          along.free.push_back(true);
        }
        along.free[i] = along.free[i] && mode.frequency_hz == 0.;
      }
  }

  Machine               &machine_;
  const SweptCoordinate &coordinate_;
  const AlongOptions    &options_;
  double                 step_;
  Eigen::MatrixXd        mass_;
  bool                   slides_         = false; ///< the coordinate is a slider's
  int                    linearisations_ = 0;
};

} // namespace

ModesAlong modes_along(Machine &machine, const SweptCoordinate &coordinate, const InitialState &start,
                       const AlongOptions &options, const std::function<void(double)> &progress)
{
  std::ostringstream message;
  if (options.positions < 2)
    message << "--positions is " << options.positions << "; lines need at least two positions";
  else if (!(std::abs(options.to - options.from) > 0.) || !std::isfinite(options.to - options.from))
    message << "--from is " << options.from << " " << coordinate.unit << ", --to " << options.to << " "
            << coordinate.unit << "; they must differ";
  if (!message.str().empty())
    throw std::invalid_argument(message.str());
  return Sweep(machine, coordinate, options).result(start, progress);
}

} // namespace gestell::coupling
