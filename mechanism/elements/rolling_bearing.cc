#include "mechanism/elements/rolling_bearing.h"

#include "mechanism/require.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::mechanism
{
namespace
{

using Row = RollingBearing::Row;

double chord(const Row &from, const Row &to)
{
  return (to.force - from.force) / (to.deflection - from.deflection);
}

/// F' at an inner row: weighted harmonic mean of the chords to either side, zero where one of them is level.
double inner_stiffness(const Row &before, const Row &row, const Row &after)
{
  const double h_1 = row.deflection - before.deflection, h_2 = after.deflection - row.deflection;
  const double c_1 = chord(before, row), c_2 = chord(row, after);
  return c_1 > 0. && c_2 > 0. ? 3. * (h_1 + h_2) / ((2. * h_2 + h_1) / c_1 + (h_2 + 2. * h_1) / c_2) : 0.;
}

/// F' at the last row: of the parabola through the last three, within what keeps F rising.
double last_stiffness(const Row &first, const Row &before, const Row &row)
{
  const double h_1 = row.deflection - before.deflection, h_2 = before.deflection - first.deflection;
  const double c_1 = chord(before, row), c_2 = chord(first, before);
  return std::clamp(((2. * h_1 + h_2) * c_1 - h_1 * c_2) / (h_1 + h_2), 0., 3. * c_1);
}

std::string digits(double x)
{
  std::ostringstream text;
  text << x;
  return text.str();
}

/// At the centre F continues with F(-r) = -F(r), so that both chords are the first one.
std::vector<double> stiffnesses(const std::vector<Row> &rows)
{
  std::vector<double> stiffness = {chord(rows[0], rows[1])};
  const std::size_t   last      = rows.size() - 1;
  for (std::size_t i = 1; i < last; ++i)
    stiffness.push_back(inner_stiffness(rows[i - 1], rows[i], rows[i + 1]));
  stiffness.push_back(last > 1 ? last_stiffness(rows[last - 2], rows[last - 1], rows[last]) : stiffness[0]);
  return stiffness;
}

} // namespace

RollingBearing::RollingBearing(const Parameters &parameters)
    : damping_(parameters.damping), axial_stiffness_(parameters.axial_stiffness)
{
  const std::string name = "rolling bearing";
  require(!parameters.rows.empty(), name, "number of rows", 0., "one or more");
  require(std::isfinite(damping_) && damping_ >= 0., name, "damping [N s/m]", damping_, "zero or positive");
  require(std::isfinite(axial_stiffness_) && axial_stiffness_ >= 0., name, "axial_stiffness [N/m]", axial_stiffness_,
          "zero or positive");
  std::vector<Row> rows = {{0., 0.}};
  for (const Row &row : parameters.rows)
  {
    require(std::isfinite(row.deflection) && row.deflection > rows.back().deflection, name, "deflection [m] of a row",
            row.deflection, "above " + digits(rows.back().deflection) + ": rows rise from zero");
    require(std::isfinite(row.force) && row.force >= rows.back().force, name, "force [N] of a row", row.force,
            "at least " + digits(rows.back().force) + ": the force must grow with the deflection");
    rows.push_back(row);
  }
  require(rows.back().force > 0., name, "force [N] of the last row", rows.back().force, "positive");

  const std::vector<double> k = stiffnesses(rows);
  double                    E = 0.;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
  {
    const double h = rows[i + 1].deflection - rows[i].deflection, c = chord(rows[i], rows[i + 1]);
    pieces_.push_back({rows[i].deflection, rows[i].force, k[i], (3. * c - 2. * k[i] - k[i + 1]) / h,
                       (k[i] + k[i + 1] - 2. * c) / (h * h), E});
    E = at(rows[i + 1].deflection).energy;
  }
  pieces_.push_back({rows.back().deflection, rows.back().force, k.back(), 0., 0., E});
}

RollingBearing::Value RollingBearing::at(double r) const
{
  std::size_t i = pieces_.size() - 1;
  while (i > 0 && r < pieces_[i].begin)
    --i;
  const auto &[begin, F, k, second, third, E] = pieces_[i];
  const double s                              = r - begin;
  return {F + s * (k + s * (second + s * third)), k + s * (2. * second + 3. * s * third),
          E + s * (F + s * (k / 2. + s * (second / 3. + s * third / 4.)))};
}

void RollingBearing::engaged(const double *u, double *K, double *D) const
{
  const double r = std::hypot(u[0], u[1]), n[] = {r > 0. ? u[0] / r : 1., r > 0. ? u[1] / r : 0.};
  const Value  F      = at(r);
  const double secant = r > 0. ? F.force / r : F.stiffness;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      K[i + 3 * j] = (i == j ? secant : 0.) + (F.stiffness - secant) * n[i] * n[j];
  K[8] = axial_stiffness_;
  for (int i = 0; i < 3; ++i)
    D[4 * i] = damping_;
}

/// F' is largest at a row or in the vertex of its parabola between two rows.
void RollingBearing::stiffest(const double *u, double *K, double *D) const
{
  engaged(u, K, D);
  double largest = 0.;
  for (std::size_t i = 0; i < pieces_.size(); ++i)
  {
    largest = std::max(largest, pieces_[i].stiffness);
    if (i + 1 < pieces_.size())
    {
      const double middle = pieces_[i].third == 0. ? -1. : -pieces_[i].second / (3. * pieces_[i].third);
      if (middle > 0. && middle < pieces_[i + 1].begin - pieces_[i].begin)
        largest = std::max(largest, at(pieces_[i].begin + middle).stiffness);
    }
  }
  K[0] = K[4] = largest;
  K[1] = K[3] = 0.;
}

double RollingBearing::stored_energy(const LocalMotion &motion, const double *) const
{
  return at(std::hypot(motion.u[0], motion.u[1])).energy + 0.5 * axial_stiffness_ * motion.u[2] * motion.u[2];
}

double RollingBearing::stored_power(const LocalMotion &motion, const double *) const
{
  const double r = std::hypot(motion.u[0], motion.u[1]);
  return (r > 0. ? at(r).force / r * (motion.u[0] * motion.v[0] + motion.u[1] * motion.v[1]) : 0.) +
         axial_stiffness_ * motion.u[2] * motion.v[2];
}

std::vector<Quantity> RollingBearing::quantities() const
{
  return {{"force", "N"}, {"axial_force", "N"}, {"eccentricity", "m"}};
}

double RollingBearing::quantity(int i, const LocalMotion &motion, const double *history) const
{
  if (i == 2)
    return std::hypot(motion.u[0], motion.u[1]);
  double p[3];
  force(motion, history, p);
  return i == 0 ? std::hypot(p[0], p[1]) : -p[2];
}

} // namespace gestell::mechanism
