#include "apps/output/report/overview_report.h"

#include "apps/output/tables/noise.h"
#include "apps/output/text/change_text.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gestell::apps
{

namespace
{

/// A signal's extreme of the larger size.
struct Peak
{
  const coupling::SignalSummary *signal;
  double                         value, t;
};

Peak peak_of(const coupling::SignalSummary &signal)
{
  return std::abs(signal.max) >= std::abs(signal.min) ? Peak{&signal, signal.max, signal.t_max}
                                                      : Peak{&signal, signal.min, signal.t_min};
}

/// Peaks of the first force, the first moment, ... in the order of the scene.
std::vector<Peak> main_peaks(const coupling::RunResult &run)
{
  std::vector<Peak> peaks;
  for (const coupling::SignalSummary &signal : run.signals)
  {
    const auto same = [&](const Peak &other) { return other.signal->unit == signal.unit; };
    if (std::none_of(peaks.begin(), peaks.end(), same))
      peaks.push_back(peak_of(signal));
  }
  constexpr std::size_t most_peaks = 3; // the others are in the table of extremes
  peaks.resize(std::min(peaks.size(), most_peaks));
  return peaks;
}

const coupling::Mode *first_that_vibrates(const std::vector<coupling::Mode> &modes)
{
  const auto found =
      std::find_if(modes.begin(), modes.end(), [](const coupling::Mode &mode) { return mode.frequency_hz > 1e-3; });
  return found != modes.end() ? &*found : nullptr;
}

std::string model_text(const ModelFacts &model)
{
  std::string text;
  if (model.dofs >= 0)
    text += " with " + count_text(static_cast<std::size_t>(model.dofs), "DOF");
  if (model.interface >= 0 && model.modes >= 0 && model.frame_dofs > model.interface + model.modes)
    text += ", " + std::to_string(model.interface + model.modes) + " of them for the " +
            std::to_string(model.frame_dofs) + " DOFs of the frame";
  return text;
}

std::string what_was_run(const Result &result, const coupling::RunResult &run)
{
  std::string text = "The motion of " + result.scene;
  if (!run.rows.empty())
    text += " from " + short_text(run.rows.front()) + " to " +
            short_text(run.rows[run.rows.size() - run.columns.size()]) + " s";
  return text + " was computed by " + run.method + " in " + std::to_string(run.work.steps) + " steps" +
         model_text(result.model) + ".";
}

bool windowed(const coupling::RunResult &run)
{
  return !run.rows.empty() && run.from > run.rows.front();
}

std::string what_it_gave(const coupling::RunResult &run)
{
  const std::vector<Peak> peaks = main_peaks(run);
  if (!run.failure.empty())
    return "It ended early: " + run.failure;
  std::string text;
  for (const Peak &peak : peaks)
    text += (text.empty() ? "" : ", ") + peak.signal->name + " reaches " +
            quantity_text(peak.value, peak.signal->unit) + " at " + short_text(peak.t) + " s";
  if (!text.empty() && windowed(run))
    text = "After " + short_text(run.from, 6) + " s, " + text;
  text += (text.empty() ? "" : ". ") + count_text(run.events.size(), "event") + " occurred.";
  if (run.energy.exchanged > 0.)
    text += " The energy residual is " + short_text(100. * run.energy.residual / run.energy.exchanged, 2) +
            " % of the energy exchanged.";
  return text;
}

std::string computed_subject(const Result &result)
{
  std::string subject;
  for (const auto &answer : result.answers)
    if (const std::string own = answer->subject(); !own.empty())
      subject += (subject.empty() ? "" : ", ") + own;
  return subject;
}

std::string other_sentences(const Result &result)
{
  std::string text;
  if (const std::string subject = computed_subject(result); !subject.empty())
    text += subject + " of " + result.scene + " were computed" + model_text(result.model) + ". ";
  else if (!result.coupled_modes.empty() || !result.frame_modes.empty())
    text += "The natural frequencies of " + result.scene + " were computed" + model_text(result.model) + ". ";
  if (const coupling::Mode *first = first_that_vibrates(result.coupled_modes))
    text += "The lowest natural frequency of the machine is " + short_text(first->frequency_hz) + " Hz.";
  return text;
}

std::vector<KeyNumber> key_numbers(const Result &result)
{
  std::vector<KeyNumber> numbers;
  if (result.run)
    for (const Peak &peak : main_peaks(*result.run))
      numbers.push_back({quantity_text(peak.value, peak.signal->unit),
                         (peak.value >= 0. ? "maximum of " : "minimum of ") + peak.signal->name});
  if (const coupling::Mode *first = first_that_vibrates(result.frame_modes))
    numbers.push_back({short_text(first->frequency_hz) + " Hz", "lowest frequency of the frame"});
  else if (const coupling::Mode *lowest = first_that_vibrates(result.coupled_modes))
    numbers.push_back({short_text(lowest->frequency_hz) + " Hz", "lowest frequency of the machine"});
  if (result.stress)
  {
    double most = 0.;
    for (const StressAt &at : result.stress->instants)
      most = std::max(most, at.peak ? at.peak->von_mises : 0.);
    numbers.push_back({quantity_text(most, "Pa"), "largest von Mises stress"});
  }
  if (result.run && result.run->energy.exchanged > 0.)
    numbers.push_back(
        {short_text(100. * result.run->energy.residual / result.run->energy.exchanged, 2) + " %", "energy residual"});
  return numbers;
}

} // namespace

std::string overview(const Result &result)
{
  Headline headline{result.run && computed_subject(result).empty()
                        ? what_was_run(result, *result.run) + " " + what_it_gave(*result.run)
                        : other_sentences(result),
                    key_numbers(result)};
  for (const auto &answer : result.answers)
    if (const Headline own = answer->headline(); !own.sentence.empty())
    {
      headline.sentence = own.sentence;
      headline.numbers.insert(headline.numbers.begin(), own.numbers.begin(), own.numbers.end());
    }
  return headline.html();
}

} // namespace gestell::apps
