#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/spectra/order_tracking.h"
#include "apps/analysis/spectra/spectra.h"
#include "apps/output/text/csv.h"

namespace gestell::apps
{

std::vector<Section> sections_of(const Result &result, const RunSpectra &found)
{
  std::vector<Section> sections;
  if (found.orders)
    sections.push_back(order_section(result, *found.orders));
  if (found.spectra)
    sections.push_back(spectrum_section(result, found));
  return sections;
}

namespace
{

/// Computed for every run: costs a tenth of a short one.
class SpectraOfRun : public Analysis
{
public:
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    const RunRequest &run = session.scene().run;
    RunSpectra        found{spectra(*result.run, run.last_period ? run.options.begin : result.run->from),
                     order_tracking(session.scene(), *result.run)};
    if (found.spectra || found.orders)
      result.answers.push_back(as_answer(std::move(found)));
    return AnalysisOutcome::done;
  }
};

CsvTable orders_csv(const RunSpectra &found)
{
  if (!found.orders)
    return {};
  const OrderTracking     &tracking = *found.orders;
  std::vector<std::string> heads{"t [s]", "speed [1/min]"};
  for (const OrderedSignal &signal : tracking.signals)
    for (const int order : tracking.orders)
      heads.push_back(signal.name + " order " + std::to_string(order) + " [" + signal.unit + ']');
  CsvTable csv(heads);
  for (std::size_t window = 0; window < tracking.t.size(); ++window)
  {
    std::vector<double> row{tracking.t[window], tracking.speed_rpm[window]};
    for (const OrderedSignal &signal : tracking.signals)
      for (const std::vector<double> &order : signal.amplitudes)
        row.push_back(order[window]);
    csv.add(row);
  }
  return csv;
}

} // namespace

AnalysisEntry spectra_analysis()
{
  return analysis_entry<SpectraOfRun, RunSpectra>(
      "spectra", "", {},
      {{"orders.csv", "signals at multiples of a rotor speed, if the angle or speed is a signal",
        content_of<RunSpectra, orders_csv>}},
      "run");
}

} // namespace gestell::apps
