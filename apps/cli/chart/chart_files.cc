#include "apps/cli/chart/chart_files.h"

#include "apps/output/charts/work_precision_chart.h"
#include "apps/output/folder/writing.h"
#include "apps/output/report/work_precision_page.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

void write_pictures(const WorkPrecision &chart, int model, Writing &writing)
{
  const std::string ending =
      chart.models.size() == 1 ? ".svg" : "_m" + std::to_string(chart.models[std::size_t(model)].modes) + ".svg";
  writing.write("charts/work_precision" + ending, work_precision_svg(chart, model, WorkMeasure::cpu));
  writing.write("charts/work_precision_counts" + ending, work_precision_svg(chart, model, WorkMeasure::evaluations));
}

} // namespace

const std::vector<std::string> &chart_files()
{
  static const std::vector<std::string> names = {"chart.csv", "chart_settings.toml", "chart.html", "charts/"};
  return names;
}

void write_chart(const std::filesystem::path &folder, const WorkPrecision &chart)
{
  OwnFolder(folder).remove_all(
      [](const std::string &name)
      {
        return std::count(chart_files().begin(), chart_files().end(), name) > 0 ||
               has_form(name, "charts/work_precision*");
      });
  write_or_rescue(folder,
                  [&](Writing &writing)
                  {
                    writing.write("chart.csv", work_precision_csv(chart));
                    writing.write("chart_settings.toml", work_precision_settings(chart));
                    writing.write("chart.html", work_precision_page(chart));
                    for (int model = 0; model < int(chart.models.size()); ++model)
                      write_pictures(chart, model, writing);
                  });
}

} // namespace gestell::apps
