#include "mechanism/profile.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{

Profile::Profile(double constant) : pieces_{{0., {constant, 0., 0.}, 0.}} {}

Profile::Profile(const std::string &name, double from, const std::vector<Ramp> &ramps) : Profile(from)
{
  require(std::isfinite(from), name, "level at the beginning", from, "finite");
  double level = from;
  for (std::size_t i = 0; i < ramps.size(); ++i)
  {
    const Ramp       &ramp = ramps[i];
    const std::string row  = "ramp " + std::to_string(i + 1);
    require(std::isfinite(ramp.at), name, row + ", begin [s]", ramp.at, "finite");
    require(std::isfinite(ramp.to), name, row + ", level", ramp.to, "finite");
    require(ramp.rate > 0., name, row + ", largest rate", ramp.rate, "positive");
    require(ramp.rate_of_rate > 0., name, row + ", largest rate of rate", ramp.rate_of_rate, "positive");
    std::ostringstream before;
    before << end() << " s, where the ramp before ends, or later";
    require(i == 0 || is_constant() || ramp.at >= end(), name, row + ", begin [s]", ramp.at, before.str());
    require(i == 0 || ramp.at > ramps[i - 1].at, name, row + ", begin [s]", ramp.at, "after that of the ramp before");
    add_ramp(level, ramp);
    level = ramp.to;
  }
}

void Profile::add(double begin, double c0, double c1, double c2)
{
  if (!corners_.empty() && corners_.back() == begin)
    pieces_.back() = {begin, {c0, c1, c2}, pieces_.back().area};
  else
  {
    corners_.push_back(begin);
    const double area = integral(pieces_.size() - 1, begin);
    pieces_.push_back({begin, {c0, c1, c2}, area});
  }
}

void Profile::add_ramp(double from, const Ramp &ramp)
{
  const double D = std::abs(ramp.to - from), s = ramp.to < from ? -1. : 1., a = ramp.rate, j = ramp.rate_of_rate;
  if (D == 0.)
    return;
  double t_j = 0., t_c = 0., rate = s * a;
  if (!std::isinf(j))
  {
    t_j  = D >= a * a / j ? a / j : std::sqrt(D / j);
    rate = s * j * t_j;
  }
  if (!std::isinf(a))
    t_c = std::max(0., D / a - t_j);
  double t = ramp.at, level = from;
  if (t_j > 0.)
  {
    add(t, level, 0., 0.5 * s * j);
    t += t_j;
    level += 0.5 * rate * t_j;
  }
  if (t_c > 0.)
  {
    add(t, level, rate, 0.);
    t += t_c;
    level += rate * t_c;
  }
  if (t_j > 0.)
  {
    add(t, level, rate, -0.5 * s * j);
    t += t_j;
  }
  add(t, ramp.to, 0., 0.);
}

std::size_t Profile::piece_at(double t) const
{
  return static_cast<std::size_t>(std::upper_bound(corners_.begin(), corners_.end(), t) - corners_.begin());
}

double Profile::value(std::size_t piece, double t) const
{
  const auto  &p = pieces_[piece];
  const double s = t - p.begin;
  return p.c[0] + s * (p.c[1] + s * p.c[2]);
}

double Profile::rate(std::size_t piece, double t) const
{
  const auto &p = pieces_[piece];
  return p.c[1] + 2. * p.c[2] * (t - p.begin);
}

double Profile::integral(std::size_t piece, double t) const
{
  const auto  &p = pieces_[piece];
  const double s = t - p.begin;
  return p.area + s * (p.c[0] + s * (p.c[1] / 2. + s * p.c[2] / 3.));
}

bool Profile::is_zero(std::size_t piece) const
{
  const auto &c = pieces_[piece].c;
  return c[0] == 0. && c[1] == 0. && c[2] == 0.;
}

std::vector<double> Profile::levels() const
{
  std::vector<double> levels;
  for (const Piece &piece : pieces_)
    levels.push_back(piece.c[0]);
  return levels;
}

} // namespace gestell::mechanism
