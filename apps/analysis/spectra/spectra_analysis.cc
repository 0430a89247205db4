#include "apps/analysis/analysis.h"
#include "apps/analysis/spectra/order_tracking.h"
#include "apps/analysis/spectra/spectra.h"
#include "apps/output/describe/described_answer.h"
#include "apps/output/report/section.h"
#include "apps/output/text/csv.h"
#include "apps/output/values/result.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

class SpectraAnswer : public DescribedAnswer<RunSpectra>
{
public:
  using DescribedAnswer::DescribedAnswer;

  std::vector<Section> sections(const Result &result) const override
  {
    std::vector<Section> sections;
    if (value.orders)
      sections.push_back(order_section(result, *value.orders));
    if (value.spectra)
      sections.push_back(spectrum_section(result, value));
    return sections;
  }
};

/// Of every run: a tenth of the cost of a short one.
class SpectraOfRun : public Analysis
{
public:
  bool compute(Session &session, Result &result) const override
  {
    const RunRequest &run = session.scene().run;
    RunSpectra found{spectra(*result.run, run.last_period ? run.options.begin : result.run->from),
                     order_tracking(session.scene(), *result.run)};
    if (found.spectra || found.orders)
      result.answers.push_back(std::make_shared<SpectraAnswer>(std::move(found)));
    return true;
  }
};

std::string orders_csv(const Result &result)
{
  const auto *found = answer_in<RunSpectra>(result.answers);
  if (!found || !found->orders)
    return "";
  const OrderTracking &tracking = *found->orders;
  std::string          csv      = "t [s],speed [1/min]";
  for (const OrderedSignal &signal : tracking.signals)
    for (const int order : tracking.orders)
      csv += ',' + signal.name + " order " + std::to_string(order) + " [" + signal.unit + ']';
  csv += '\n';
  for (std::size_t window = 0; window < tracking.t.size(); ++window)
  {
    append_exact(csv, tracking.t[window]);
    append_exact(csv += ',', tracking.speed_rpm[window]);
    for (const OrderedSignal &signal : tracking.signals)
      for (const std::vector<double> &order : signal.amplitudes)
        append_exact(csv += ',', order[window]);
    csv += '\n';
  }
  return csv;
}

} // namespace

AnalysisEntry spectra_analysis()
{
  return analysis_entry<SpectraOfRun, SpectraAnswer, RunSpectra>(
      "spectra", "", {},
      {{"orders.csv", "signals at multiples of a rotor's speed, of a run that tells its angle or speed", orders_csv}},
      "run");
}

} // namespace gestell::apps
