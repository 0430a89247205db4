#include "mechanism/functions/commanded_profile.h"

#include <algorithm>

namespace gestell::mechanism
{

CommandedProfile CommandedProfile::waiting(double level) const
{
  CommandedProfile course = *this;
  course.waiting_         = level;
  return course;
}

std::vector<double> CommandedProfile::levels() const
{
  std::vector<double> levels = profile_.levels();
  if (waiting_)
    levels.push_back(*waiting_);
  return levels;
}

void CommandedProfile::begin(double t, double *history) const
{
  const double since = t - history[origin];
  history[mode]      = follows;
  history[piece]     = static_cast<double>(profile_.piece_at(since));
  if (function_)
    function_->start(since, 1., history + n_slots);
}

void CommandedProfile::start(double t, double *history) const
{
  std::fill_n(history, n_history(), 0.);
  begin(t, history);
  if (waiting_)
    history[mode] = rests;
}

void CommandedProfile::resume(double t, double *history) const
{
  switch (mode_of(history))
  {
  case rests:
    return;
  case follows:
    begin(t, history);
    return;
  case ramps:
    break;
  }
  Pieces    pieces;
  const int n    = ramp_pieces(history, pieces);
  history[piece] = ramp_piece_at(t, pieces, n);
}

int CommandedProfile::ramp_piece_at(double t, const Pieces &pieces, int n)
{
  int i = 0;
  while (i + 1 < n && pieces[i + 1].begin <= t)
    ++i;
  return i;
}

int CommandedProfile::ramp_pieces(const double *history, Pieces &pieces)
{
  return Profile::pieces_of(history[from], {history[origin], history[to], history[rate], history[rate_of_rate]},
                            pieces);
}

CommandedProfile::Value CommandedProfile::at(double t, bool by_history, const double *history) const
{
  switch (mode_of(history))
  {
  case rests:
    return {*waiting_, 0.};
  case ramps:
  {
    Pieces    pieces;
    const int n = ramp_pieces(history, pieces);
    const int i = by_history ? static_cast<int>(history[piece]) : ramp_piece_at(t, pieces, n);
    return {pieces[i].value(t), pieces[i].rate(t)};
  }
  case follows:
    break;
  }
  const double since = t - history[origin];
  if (function_)
  {
    const auto f = function_->at(since, by_history ? history + n_slots : nullptr);
    return {f.value, f.first};
  }
  const std::size_t i = by_history ? static_cast<std::size_t>(history[piece]) : profile_.piece_at(since);
  return {profile_.value(i, since), profile_.rate(i, since)};
}

double CommandedProfile::integral(double t, const double *history) const
{
  const double since = t - history[origin];
  if (mode_of(history) == rests)
    return *waiting_ * since;
  if (mode_of(history) == follows)
    return profile_.integral(static_cast<std::size_t>(history[piece]), since);
  Pieces pieces;
  ramp_pieces(history, pieces);
  const int last = static_cast<int>(history[piece]);
  double    area = 0.;
  for (int i = 0; i < last; ++i)
    area += pieces[i].integral(pieces[i + 1].begin);
  return area + pieces[last].integral(t);
}

bool CommandedProfile::is_zero(const double *history) const
{
  if (mode_of(history) == rests)
    return *waiting_ == 0.;
  if (mode_of(history) == follows)
    return !function_ && profile_.is_zero(static_cast<std::size_t>(history[piece]));
  Pieces pieces;
  ramp_pieces(history, pieces);
  return pieces[static_cast<int>(history[piece])].is_zero();
}

// --- corners and orders

bool CommandedProfile::has_corner(const double *history, double &t) const
{
  const auto now = static_cast<std::size_t>(history[piece]);
  if (mode_of(history) == follows)
  {
    if (!profile_.ends(now))
      return false;
    t = profile_.corner(now) + history[origin];
    return true;
  }
  if (mode_of(history) == rests)
    return false;
  Pieces    pieces;
  const int n = ramp_pieces(history, pieces);
  if (static_cast<int>(now) + 1 >= n)
    return false;
  t = pieces[now + 1].begin;
  return true;
}

int CommandedProfile::n_guards(const double *history) const
{
  double t = 0.;
  if (function_ && mode_of(history) == follows)
    return function_->n_guards();
  return int(has_corner(history, t));
}

std::vector<Guard> CommandedProfile::guards(const double *history) const
{
  if (function_ && mode_of(history) == follows)
    return function_->guards(history + n_slots);
  return n_guards(history) > 0 ? std::vector<Guard>{{"next_segment", Crossing::rising}} : std::vector<Guard>{};
}

void CommandedProfile::guard_values(double t, const double *history, double *g) const
{
  double corner = 0.;
  if (function_ && mode_of(history) == follows)
    function_->guard_values(t - history[origin], history + n_slots, g);
  else if (has_corner(history, corner))
    g[0] = t - corner;
}

void CommandedProfile::transition(int i, double t, double *history) const
{
  if (function_ && mode_of(history) == follows)
    function_->transition(i, t - history[origin], 1., history + n_slots);
  else
    history[piece] += 1.;
}

bool CommandedProfile::command(const SwitchCommand &order, double t, double *history) const
{
  const auto known = commands();
  if (std::find(known.begin(), known.end(), order.name) == known.end())
    return false;
  const double now = at(t, true, history).value;
  history[origin]  = t;
  if (order.name == "start")
  {
    begin(t, history);
    return true;
  }
  history[mode]         = ramps;
  history[piece]        = 0.;
  history[from]         = now;
  history[to]           = order.name == "set" ? order.level : order.name == "hold" ? now : 0.;
  history[rate]         = order.rate;
  history[rate_of_rate] = order.rate_of_rate;
  return true;
}

} // namespace gestell::mechanism
