#include "apps/output/tables/modes_along_table.h"

#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::ModesAlong;
using coupling::ModesAt;

constexpr double no_damping = 1e-12; ///< what rounding leaves

} // namespace

LineExtremes line_extremes(const ModesAlong &along, std::size_t line)
{
  LineExtremes own;
  own.min = own.least_damping = own.largest_damping = own.least_assurance = std::nan("");
  for (const ModesAt &at : along.positions)
  {
    if (line >= at.modes.size())
      continue;
    const coupling::Mode &mode = at.modes[line];
    if (std::isnan(own.min) || mode.frequency_hz < own.min)
    {
      own.min   = mode.frequency_hz;
      own.x_min = at.x;
    }
    if (mode.frequency_hz > own.max)
    {
      own.max   = mode.frequency_hz;
      own.x_max = at.x;
    }
    if (mode.growth > own.growth)
    {
      own.growth   = mode.growth;
      own.x_growth = at.x;
    }
    const double damping = std::abs(mode.damping_ratio) < no_damping ? 0. : mode.damping_ratio;
    own.least_damping    = std::fmin(own.least_damping, damping); // nan gives way
    own.largest_damping  = std::fmax(own.largest_damping, damping);
    if (line < at.assurance.size())
      own.least_assurance = std::fmin(own.least_assurance, at.assurance[line]);
  }
  return own;
}

std::string modes_along_csv(const AlongResult &along)
{
  std::string csv = along.modes.coordinate.name + " [" + along.modes.coordinate.unit +
                    "],line,frequency [Hz],damped frequency [Hz],damping ratio,mac,configuration,growth [1/s]\n";
  for (const ModesAt &at : along.modes.positions)
    for (std::size_t i = 0; i < at.modes.size(); ++i)
    {
      append_exact(csv, at.x);
      csv += ',' + std::to_string(i + 1);
      for (const double value : {at.modes[i].frequency_hz, at.modes[i].damped_frequency_hz, at.modes[i].damping_ratio,
                                 i < at.assurance.size() ? at.assurance[i] : std::nan("")})
        append_exact(csv += ',', value);
      csv += at.configuration == coupling::Configuration::equilibrium ? ",equilibrium," : ",undeformed,";
      append_exact(csv, at.modes[i].growth);
      csv += '\n';
    }
  return csv;
}

std::string modes_along_shapes_csv(const AlongResult &along, const std::vector<std::string> &coordinates)
{
  std::string csv = along.modes.coordinate.name + " [" + along.modes.coordinate.unit + "],line";
  for (const std::string &name : coordinates)
    csv += ',' + name;
  csv += '\n';
  for (const ModesAt &at : along.modes.positions)
    for (std::size_t i = 0; i < at.modes.size(); ++i)
    {
      append_exact(csv, at.x);
      csv += ',' + std::to_string(i + 1);
      for (const double value : at.modes[i].shape)
        append_exact(csv += ',', value);
      csv += '\n';
    }
  return csv;
}

} // namespace gestell::apps
