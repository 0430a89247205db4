#include "mechanism/functions/profile.h"

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
    before << end() << " s (end of the previous ramp) or later";
    require(i == 0 || is_constant() || ramp.at >= end(), name, row + ", begin [s]", ramp.at, before.str());
    require(i == 0 || ramp.at > ramps[i - 1].at, name, row + ", begin [s]", ramp.at, "after that of the previous ramp");
    if (ramp.to == level)
      continue;
    Piece     of_ramp[most_pieces];
    const int n = pieces_of(level, ramp, of_ramp);
    for (int k = 0; k < n; ++k)
      add(of_ramp[k]);
    level = ramp.to;
  }
}

void Profile::add(const Piece &piece)
{
  if (!corners_.empty() && corners_.back() == piece.begin)
    pieces_.back() = {piece.begin, piece.c, pieces_.back().area};
  else
  {
    corners_.push_back(piece.begin);
    const double area = integral(pieces_.size() - 1, piece.begin);
    pieces_.push_back({piece.begin, piece.c, area});
  }
}

int Profile::pieces_of(double from, const Ramp &ramp, Piece (&pieces)[most_pieces])
{
  const double D = std::abs(ramp.to - from), s = ramp.to < from ? -1. : 1., a = ramp.rate, j = ramp.rate_of_rate;
  double       t_j = 0., t_c = 0., rate = s * a;
  if (!std::isinf(j) && D > 0.)
  {
    t_j  = D >= a * a / j ? a / j : std::sqrt(D / j);
    rate = s * j * t_j;
  }
  if (!std::isinf(a))
    t_c = std::max(0., D / a - t_j);
  int    n = 0;
  double t = ramp.at, level = from;
  if (t_j > 0.)
  {
    pieces[n++] = {t, {level, 0., 0.5 * s * j}};
    t += t_j;
    level += 0.5 * rate * t_j;
  }
  if (t_c > 0.)
  {
    pieces[n++] = {t, {level, rate, 0.}};
    t += t_c;
    level += rate * t_c;
  }
  if (t_j > 0.)
  {
    pieces[n++] = {t, {level, rate, -0.5 * s * j}};
    t += t_j;
  }
  pieces[n++] = {t, {ramp.to, 0., 0.}};
  return n;
}

std::size_t Profile::piece_at(double t) const
{
  return static_cast<std::size_t>(std::upper_bound(corners_.begin(), corners_.end(), t) - corners_.begin());
}

double Profile::value(std::size_t piece, double t) const
{
  return pieces_[piece].value(t);
}

double Profile::rate(std::size_t piece, double t) const
{
  return pieces_[piece].rate(t);
}

double Profile::integral(std::size_t piece, double t) const
{
  return pieces_[piece].area + pieces_[piece].integral(t);
}

bool Profile::is_zero(std::size_t piece) const
{
  return pieces_[piece].is_zero();
}

std::vector<double> Profile::levels() const
{
  std::vector<double> levels;
  for (const Piece &piece : pieces_)
    levels.push_back(piece.c[0]);
  return levels;
}

} // namespace gestell::mechanism
