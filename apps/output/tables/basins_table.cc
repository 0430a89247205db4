#include "apps/output/tables/basins_table.h"

#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

using coupling::Basins;

std::string range_text(const std::string &name, double begin, double end)
{
  return name + " from " + short_text(begin, 4) + " to " + short_text(end, 4);
}

std::string percent(double share)
{
  return short_text(100. * share, 3) + " %";
}

} // namespace

std::string basins_text(const BasinMap &map)
{
  const Basins &basins = map.basins;
  std::string   text   = "basins over " + range_text(map.x_name, basins.plane.x_begin, basins.plane.x_end) + ", " +
                     range_text(map.y_name, basins.plane.y_begin, basins.plane.y_end) + ":";
  for (int number = 1; number <= basins.motion.maxCoeff(); ++number)
    if (const double share = basins.share(number); share > 0.)
      text += " no. " + std::to_string(number) + " " + percent(share) + ",";
  text += " none of the stable motions found " + percent(basins.share(Basins::not_reached));
  return text + (basins.is_complete() ? "" : "; interrupted");
}

std::string basins_csv(const PeriodicResult &result)
{
  if (!result.basins)
    return "";
  const Basins &basins = result.basins->basins;
  std::string   csv    = result.basins->x_name + ',' + result.basins->y_name + ",solution,periods\n";
  for (int j = 0; j < basins.plane.points; ++j)
    for (int i = 0; i < basins.plane.points; ++i)
      if (basins.motion(i, j) != Basins::not_looked_at)
      {
        append_exact(csv, basins.plane.x_at(i));
        append_exact(csv += ',', basins.plane.y_at(j));
        csv += ',' + std::to_string(basins.motion(i, j)) + ',' + std::to_string(basins.periods(i, j)) + '\n';
      }
  return csv;
}

} // namespace gestell::apps
