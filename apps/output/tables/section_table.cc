#include "apps/output/tables/section_table.h"

#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

std::string kind_text(const coupling::Recurrence &motion)
{
  if (motion.kind == "periodic")
    return "periodic: it repeats after one period of the excitation";
  if (motion.kind == "sub-harmonic")
    return "sub-harmonic: it repeats after " + std::to_string(motion.repeats) + " periods of the excitation";
  if (motion.kind == "quasi-periodic")
    return "quasi-periodic: it beats and never repeats, neighbouring motions keep their distance";
  if (motion.kind == "drifting")
    return "drifting: it lies ever farther away over these periods, as a motion that nothing holds";
  if (motion.kind == "chaotic")
    return "chaotic: it never repeats, neighbouring motions part";
  return "still settling: it comes ever nearer to a motion that repeats" +
         (motion.repeats > 0 ? " after " + std::to_string(motion.repeats) + " period" + (motion.repeats > 1 ? "s" : "")
                             : std::string());
}

} // namespace

std::string long_run_text(const LongRun &run)
{
  const coupling::Recurrence &motion = run.motion;
  return "in the long run (" + std::to_string(motion.periods) + " periods, behind as many) the motion is " +
         kind_text(motion) + "; largest Lyapunov exponent " + short_text(motion.exponent, 3) + " 1/s, standard error " +
         short_text(motion.error, 2) + " 1/s";
}

std::string section_csv(const PeriodicResult &result)
{
  if (!result.long_run)
    return "";
  const LongRun &run = *result.long_run;
  std::string    csv = "period";
  for (const NamedCoordinate &coordinate : result.coordinates)
    csv += ',' + csv_field(coordinate.name) + ',' + csv_field(coordinate.name + "'");
  for (const std::string &column : run.columns)
    csv += ',' + csv_field(column);
  csv += '\n';
  const Eigen::MatrixXd &section = run.motion.section;
  const auto             n = section.rows() / 2, width = Eigen::Index(run.columns.size());
  for (Eigen::Index k = 0; k < section.cols(); ++k)
  {
    csv += std::to_string(run.motion.periods + k);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const double sign = result.coordinates[std::size_t(i)].sign;
      append_exact(csv += ',', sign * section(i, k));
      append_exact(csv += ',', sign * section(n + i, k));
    }
    for (Eigen::Index j = 0; j < width; ++j)
      append_exact(csv += ',', run.rows[std::size_t(k * width + j)]);
    csv += '\n';
  }
  return csv;
}

} // namespace gestell::apps
