#pragma once

#include "mechanism/branches.h"
#include "mechanism/functions/position_function.h"
#include "mechanism/functions/profile.h"
#include "mechanism/switch_command.h"

#include <optional>

namespace gestell::mechanism
{

/**
 * A level over time that obeys orders: the wanted speed of a drive, the engagement of a brake, a force.
 *
 * It follows a profile of ramps, or a formula or table of the time, from the begin of the run on; or it waits at a
 * level until the order "start", from which on the time of the profile counts.  The orders "set" and "brake" leave it
 * by one ramp (Profile) from the level of that instant, "hold" keeps that level.  A ramp begins with the rate zero,
 * whatever the rate was before.
 *
 * Where it stands is history [n_history()] of the element that follows it; ends of its pieces are guards, as those of a
 * Branches: "next_segment", or the kinks of the formula.
 */
class CommandedProfile
{
public:
  CommandedProfile(double level = 0.) : CommandedProfile(Profile(level)) {} // NOLINT: a level is a course
  CommandedProfile(const Profile &profile) : profile_(profile) {}           // NOLINT: a profile is a course
  explicit CommandedProfile(const PositionFunction &of_time) : function_(of_time) {}

  /// Waits at `level` for the order "start".
  CommandedProfile waiting(double level) const;
  bool             waits() const { return waiting_.has_value(); }

  int  n_history() const { return n_slots + (function_ ? function_->n_history() : 0); }
  void start(double t, double *history) const;
  /// Nobody has taken its corners for a while: it goes on in the piece in which t lies.
  void resume(double t, double *history) const;

  struct Value
  {
    double value, rate;
  };
  /// @param by_history  the piece the history names, also beyond its ends; else the one t lies in
  Value at(double t, bool by_history, const double *history) const;
  /// Integral over the time, up to a constant that each order changes; of levels and profiles.
  double integral(double t, const double *history) const;

  int                n_guards(const double *history) const;
  std::vector<Guard> guards(const double *history) const;
  void               guard_values(double t, const double *history, double *g) const;
  void               transition(int i, double t, double *history) const;

  bool                            command(const SwitchCommand &order, double t, double *history) const;
  static std::vector<std::string> commands() { return {"start", "hold", "set", "brake"}; }

  /// The piece the history names is zero all along.
  bool                is_zero(const double *history) const;
  const Profile      &profile() const { return profile_; }
  std::vector<double> levels() const; ///< of a profile: lowest and highest without orders are among them

private:
  enum Slot
  {
    mode,
    piece,
    origin, ///< [s] from which the time of the profile counts
    from,   ///< of the ramp of an order, that began at `origin`
    to,
    rate,
    rate_of_rate,
    n_slots
  };
  enum Mode
  {
    follows, ///< the profile
    rests,   ///< until it is started
    ramps    ///< by order
  };
  using Pieces = Profile::Piece[Profile::most_pieces];

  static Mode mode_of(const double *history) { return static_cast<Mode>(static_cast<int>(history[mode])); }
  static int  ramp_pieces(const double *history, Pieces &pieces);
  static int  ramp_piece_at(double t, const Pieces &pieces, int n);
  bool        has_corner(const double *history, double &t) const;
  void        begin(double t, double *history) const; ///< the profile, from `origin` on

  Profile                         profile_;
  std::optional<PositionFunction> function_; ///< of the time, instead of the profile
  std::optional<double>           waiting_;
};

} // namespace gestell::mechanism
