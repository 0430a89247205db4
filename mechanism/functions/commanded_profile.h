#pragma once

#include "mechanism/branches.h"
#include "mechanism/functions/position_function.h"
#include "mechanism/functions/profile.h"
#include "mechanism/switch_command.h"

#include <optional>

namespace gestell::mechanism
{

/**
 * A level over time that accepts commands: the setpoint speed of a drive, the engagement of a brake, a force.
 *
 * It follows a profile of ramps, or a formula or table of time, from the start of the run; or it waits at a level until
 * the command "start", where the time of the profile begins.  The commands "set" and "brake" replace it by one ramp
 * (Profile) from the present level, "hold" keeps the present level.  A ramp begins with the rate zero, independently of
 * the rate before.
 *
 * Its state is history [n_history()] of the element that follows it; ends of its pieces are guards like those of
 * Branches: "next_segment", or the kinks of the formula.
 */
class CommandedProfile
{
public:
  CommandedProfile(double level = 0.) : CommandedProfile(Profile(level)) {} // NOLINT: a level is a course
  CommandedProfile(const Profile &profile) : profile_(profile) {}           // NOLINT: a profile is a course
  explicit CommandedProfile(const PositionFunction &of_time) : function_(of_time) {}

  /// A profile that waits at `level` for the command "start".
  CommandedProfile waiting(double level) const;
  bool             waits() const { return waiting_.has_value(); }

  int  n_history() const { return n_slots + (function_ ? function_->n_history() : 0); }
  void start(double t, double *history) const;
  /// Sets the piece that contains t, after its corners were not processed for some time.
  void resume(double t, double *history) const;

  struct Value
  {
    double value, rate;
  };
  /// @param by_history  the piece of the history, also beyond its ends; else the one that contains t
  Value at(double t, bool by_history, const double *history) const;
  /// Integral over time, up to a constant that each command changes; for levels and profiles.
  double integral(double t, const double *history) const;

  int                n_guards(const double *history) const;
  std::vector<Guard> guards(const double *history) const;
  void               guard_values(double t, const double *history, double *g) const;
  void               transition(int i, double t, double *history) const;

  bool                            command(const SwitchCommand &order, double t, double *history) const;
  static std::vector<std::string> commands() { return {"start", "hold", "set", "brake"}; }

  /// Whether the piece of the history is zero throughout.
  bool                is_zero(const double *history) const;
  const Profile      &profile() const { return profile_; }
  std::vector<double> levels() const; ///< of a profile, including the lowest and highest without commands

private:
  enum Slot
  {
    mode,
    piece,
    origin, ///< [s] start of the profile's time
    from,   ///< initial level of the ramp of a command, which began at `origin`
    to,
    rate,
    rate_of_rate,
    n_slots
  };
  enum Mode
  {
    follows, ///< the profile
    rests,   ///< before its start
    ramps    ///< by a command
  };
  using Pieces = Profile::Piece[Profile::most_pieces];

  static Mode mode_of(const double *history) { return static_cast<Mode>(static_cast<int>(history[mode])); }
  static int  ramp_pieces(const double *history, Pieces &pieces);
  static int  ramp_piece_at(double t, const Pieces &pieces, int n);
  bool        has_corner(const double *history, double &t) const;
  void        begin(double t, double *history) const; ///< starts the profile at `origin`

  Profile                         profile_;
  std::optional<PositionFunction> function_; ///< of time, instead of the profile
  std::optional<double>           waiting_;
};

} // namespace gestell::mechanism
