#include "apps/output/tables/modes_along_table.h"

#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::ModesAt;

} // namespace

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
