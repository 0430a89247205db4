#include "mechanism/elements/table_force.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{
namespace
{

void check(const std::vector<TableForce::Row> &rows)
{
  const std::string name = "table force";
  require(rows.size() >= 2, name, "number of rows", static_cast<double>(rows.size()), "2 or more");
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const std::string row = "row " + std::to_string(i + 1);
    require(std::isfinite(rows[i].x), name, row + ", abscissa", rows[i].x, "finite");
    require(std::isfinite(rows[i].force), name, row + ", force", rows[i].force, "finite");
    if (i == 0)
      continue;
    const double       last = rows[i - 1].x;
    std::ostringstream before;
    before << last << " of the previous row, or above it; sort the rows in ascending order";
    require(rows[i].x >= last, name, row + ", abscissa", rows[i].x, before.str());
    require(i == 1 || rows[i].x > rows[i - 2].x, name, row + ", abscissa", rows[i].x,
            "above that of the two rows before; two rows make a jump, a third row is not allowed");
    require(rows[i].x == last || std::isfinite((rows[i].force - rows[i - 1].force) / (rows[i].x - last)), name,
            row + ", abscissa", rows[i].x, "farther from the previous row, or equal to it for a jump");
  }
}

} // namespace

TableForce::TableForce(const Parameters &parameters) : against_(parameters.against)
{
  const auto &rows = parameters.rows;
  check(rows);
  segments_.push_back({rows[0].x, rows[0].force, 0., 0.});
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const bool last = i + 1 == rows.size();
    if (!last && rows[i + 1].x == rows[i].x)
      continue; // the segment begins after the jump
    const double   slope = last ? 0. : (rows[i + 1].force - rows[i].force) / (rows[i + 1].x - rows[i].x);
    const bool     jump  = i > 0 && rows[i - 1].x == rows[i].x && rows[i - 1].force != rows[i].force;
    const Segment &s     = segments_.back();
    if (!jump && slope == s.slope)
      continue; // no corner
    const double dx = rows[i].x - s.x;
    corners_.push_back(rows[i].x);
    segments_.push_back({rows[i].x, rows[i].force, slope, s.energy - (s.force + 0.5 * s.slope * dx) * dx});
  }
}

std::size_t TableForce::segment_at(double x) const
{
  return static_cast<std::size_t>(std::upper_bound(corners_.begin(), corners_.end(), x) - corners_.begin());
}

double TableForce::abscissa(const LocalMotion &motion) const
{
  return against_ == Against::time ? motion.t : against_ == Against::displacement ? motion.u[0] : motion.v[0];
}

void TableForce::stiffest(const double *, double *K, double *D) const
{
  if (against_ != Against::time)
    for (const Segment &s : segments_)
    {
      double &steepest = against_ == Against::displacement ? *K : *D;
      steepest         = std::max(steepest, -s.slope);
    }
}

void TableForce::start(const LocalMotion &motion, double *history) const
{
  history[0] = static_cast<double>(segment_at(abscissa(motion)));
}

double TableForce::stored_energy(const LocalMotion &motion, const double *history) const
{
  if (against_ != Against::displacement)
    return 0.;
  const Segment &s  = segments_[motion.by_history ? segment_of(history) : segment_at(motion.u[0])];
  const double   dx = motion.u[0] - s.x;
  return s.energy - (s.force + 0.5 * s.slope * dx) * dx;
}

double TableForce::stored_power(const LocalMotion &motion, const double *history) const
{
  return against_ == Against::displacement ? resistance(motion, history) * motion.v[0] : 0.;
}

Work TableForce::work() const
{
  return against_ == Against::displacement ? Work::dissipated : Work::input;
}

int TableForce::n_guards(const double *history) const
{
  return int(ends(segment_of(history))) + int(goes_back(segment_of(history)));
}

std::vector<Guard> TableForce::guards(const double *history) const
{
  std::vector<Guard> guards;
  if (ends(segment_of(history)))
    guards.push_back({"next_segment", Crossing::rising});
  if (goes_back(segment_of(history)))
    guards.push_back({"previous_segment", Crossing::falling});
  return guards;
}

void TableForce::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const std::size_t segment = segment_of(history);
  const double      x       = abscissa(motion);
  if (ends(segment))
    *g++ = x - corners_[segment];
  if (goes_back(segment))
    *g = x - corners_[segment - 1];
}

void TableForce::transition(int i, const LocalMotion &, double *history) const
{
  history[0] += i == 0 && ends(segment_of(history)) ? 1. : -1.;
}

std::vector<Quantity> TableForce::quantities() const
{
  return {{"force", "N"}, {"displacement", "m"}, {"rate", "m/s"}};
}

double TableForce::quantity(int i, const LocalMotion &motion, const double *history) const
{
  return i == 0 ? -resistance(motion, history) : i == 1 ? motion.u[0] : motion.v[0];
}

} // namespace gestell::mechanism
