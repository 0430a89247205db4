#include "apps/output/report.h"

#include "apps/output/number_text.h"
#include "apps/output/signal_charts.h"
#include "apps/output/svg.h"

namespace gestell::apps
{

Report make_report(const Result &result)
{
  Report report;
  report.html = "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>" + escape_xml(result.scene) +
                "</title><h1>" + escape_xml(result.scene) + "</h1>";
  if (result.run)
    for (SignalChart &chart : signal_charts(*result.run))
    {
      report.html += chart.svg;
      report.charts.emplace_back(chart.name, std::move(chart.svg));
    }
  report.html += "</html>\n";
  return report;
}

} // namespace gestell::apps
