#include "apps/output/charts/work_precision.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gestell::apps
{
namespace
{

bool usable(const WorkPoint &point)
{
  return point.failure.empty() && point.resolved && std::isfinite(point.error);
}

std::string quoted(const std::string &text)
{
  std::string safe = "\"";
  for (const char c : text)
    safe += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ';' : c);
  return safe + '"';
}

/// Columns of fixed width.
std::string cell(const std::string &text, int width)
{
  std::string padded = text;
  // Every letter of the tables is ASCII.
  padded.resize(std::max<std::size_t>(padded.size(), std::size_t(width)), ' ');
  return padded + ' ';
}

std::string right(const std::string &text, int width)
{
  return std::string(std::max(0, width - int(text.size())), ' ') + text + ' ';
}

std::string setting_text(const WorkPoint &point)
{
  return point.step > 0. ? short_text(point.step * 1e6, 4) + " us" : "tol " + short_text(point.tolerance, 2);
}

std::string model_text(const WorkModel &model)
{
  return std::to_string(model.coordinates) + " DOFs" +
         (model.modes > 0 ? ", " + std::to_string(model.modes) + " of them modal" : "");
}

std::string front_table(const WorkPrecision &chart, int model)
{
  std::string text = cell("method", 34) + cell("located", 7) + cell("setting", 11) + right("error", 9) +
                     right("CPU [ms]", 10) + right("steps", 9) + right("Newton", 9) + right("factor.", 8) + "\n";
  for (const std::size_t i : pareto_front(chart, model))
  {
    const WorkPoint &point = chart.points[i];
    text += cell(point.method, 34) + cell(point.events ? "yes" : "no", 7) + cell(setting_text(point), 11) +
            right(short_text(point.error, 2), 9) + right(short_text(1e3 * point.cpu_s, 4), 10) +
            right(std::to_string(point.work.steps), 9) + right(std::to_string(point.work.newton), 9) +
            right(std::to_string(point.work.factorisations), 8) + "\n";
  }
  return text;
}

std::string choice_text(const WorkPrecision &chart, const std::vector<WorkSeries> &series, int model, double target)
{
  std::string text = "fastest at an error of " + short_text(target, 2) + ": ";
  const auto  best = best_at_error(chart, series, model, true, target);
  if (!best)
    return text + (target < 10. * chart.models[model].reference_error ? "not resolved by the reference\n"
                                                                      : "no run reaches this error\n");
  const WorkPoint &point = chart.points[best->at.point];
  text += point.method + ", " + setting_text(point) + ", events " + (point.events ? "located" : "not located") + ", " +
          (best->at.bound ? "at most " : "") + short_text(1e3 * best->at.cpu_s, 3) + " ms";
  if (!best->at.bound && point.cpu_s > 1.1 * best->at.cpu_s)
    text += " interpolated (this run: " + short_text(1e3 * point.cpu_s, 3) + " ms, error " +
            short_text(point.error, 2) + ")";
  if (const auto peer = best_at_error(chart, series, model, false, target))
    text += "; " + peer->series->method + (peer->series->events ? ", events located, " : " ") +
            (peer->at.bound ? "at most " : "") + short_text(1e3 * peer->at.cpu_s, 3) +
            " ms: " + short_text(peer->at.cpu_s / best->at.cpu_s, 3) + " times as long";
  else if (!chart.peers.empty())
    text += "; no run of " + chart.peers + " reaches this error";
  return text + "\n";
}

} // namespace

std::vector<WorkSeries> work_series(const WorkPrecision &chart)
{
  std::vector<WorkSeries> all;
  for (std::size_t i = 0; i < chart.points.size(); ++i)
  {
    const WorkPoint &point = chart.points[i];
    const auto       found =
        std::find_if(all.begin(), all.end(),
                     [&](const WorkSeries &s)
                     { return s.method == point.method && s.events == point.events && s.model == point.model; });
    if (found != all.end())
      found->points.push_back(i);
    else
      all.push_back({point.method, point.family, point.own, point.events, point.model, {i}});
  }
  for (WorkSeries &series : all)
    std::stable_sort(series.points.begin(), series.points.end(),
                     [&](std::size_t a, std::size_t b)
                     { return chart.points[a].setting() > chart.points[b].setting(); });
  return all;
}

std::vector<std::size_t> pareto_front(const WorkPrecision &chart, int model)
{
  // Errors below the resolution of the reference count as that resolution: such runs rank before others, and their own
  // order is unknown.
  const double resolved = 10. * chart.models[std::size_t(model)].reference_error;
  const auto   error_of = [&](std::size_t i)
  { return usable(chart.points[i]) ? chart.points[i].error : std::max(chart.points[i].error, resolved); };
  std::vector<std::size_t> candidates, front;
  for (std::size_t i = 0; i < chart.points.size(); ++i)
    if (chart.points[i].model == model && chart.points[i].failure.empty() && std::isfinite(chart.points[i].error))
      candidates.push_back(i);
  std::sort(candidates.begin(), candidates.end(),
            [&](std::size_t a, std::size_t b)
            {
              const double x = chart.points[a].cpu_s, y = chart.points[b].cpu_s;
              return x != y ? x < y : error_of(a) != error_of(b) ? error_of(a) < error_of(b) : a < b;
            });
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : candidates)
    if (error_of(i) < best)
    {
      best = error_of(i);
      if (usable(chart.points[i]))
        front.push_back(i);
    }
  return front;
}

std::optional<WorkAtError> work_at_error(const WorkPrecision &chart, const WorkSeries &series, double error)
{
  if (error < 10. * chart.models[series.model].reference_error)
    return std::nullopt;
  // Backwards from the finest run with an error to the last one that is too coarse.
  std::optional<WorkAtError> found;
  for (auto i = series.points.rbegin(); i != series.points.rend(); ++i)
  {
    const WorkPoint &point = chart.points[*i];
    const bool       fine  = point.failure.empty() && std::isfinite(point.error) && point.error <= error;
    if (fine)
    {
      found = {point.cpu_s, *i, true};
      continue;
    }
    if (!found && !point.failure.empty())
      continue; // given up for its time: nothing finer was tried
    if (!found)
      return std::nullopt;
    const WorkPoint &finer = chart.points[found->point];
    if (point.failure.empty() && std::isfinite(point.error) && point.error > finer.error && finer.error > 0. &&
        point.cpu_s > 0.)
    {
      const double share = std::log(point.error / error) / std::log(point.error / finer.error);
      found->cpu_s       = std::min(finer.cpu_s, point.cpu_s * std::pow(finer.cpu_s / point.cpu_s, share));
    }
    found->bound = false;
    return found;
  }
  return found;
}

std::optional<BestSeries> best_at_error(const WorkPrecision &chart, const std::vector<WorkSeries> &series, int model,
                                        bool own, double error)
{
  std::optional<BestSeries> best;
  for (const WorkSeries &candidate : series)
    if (candidate.model == model && candidate.own == own)
      if (const auto at = work_at_error(chart, candidate, error); at && (!best || at->cpu_s < best->at.cpu_s))
        best = BestSeries{&candidate, *at};
  return best;
}

std::vector<bool> on_pareto_front(const WorkPrecision &chart)
{
  std::vector<bool> on_front(chart.points.size(), false);
  for (std::size_t m = 0; m < chart.models.size(); ++m)
    for (const std::size_t i : pareto_front(chart, int(m)))
      on_front[i] = true;
  return on_front;
}

std::string setting_words(const WorkPoint &point)
{
  return point.step > 0. ? "step " + short_text(point.step * 1e6, 4) + " µs"
                         : "tolerance " + short_text(point.tolerance, 2);
}

std::string work_precision_csv(const WorkPrecision &chart)
{
  const std::vector<bool> on_front = on_pareto_front(chart);

  std::string csv = "method,family,own,events,coordinates,modes,step [s],tolerance,error,reference error,resolved,"
                    "cpu [s],set-up [s],steps,rejected,newton,factorisations,solves,evaluations,located events,pareto,"
                    "failure,settings\n";
  for (std::size_t i = 0; i < chart.points.size(); ++i)
  {
    const WorkPoint &p     = chart.points[i];
    const WorkModel &model = chart.models[p.model];
    const auto       yes   = [](bool x) { return x ? "1" : "0"; };
    const auto       value = [](double x) { return x > 0. ? exact_text(x) : std::string(); };
    const bool       known = p.failure.empty() && std::isfinite(p.error);
    csv += quoted(p.method) + ',' + p.family + ',' + yes(p.own) + ',' + yes(p.events) + ',' +
           std::to_string(model.coordinates) + ',' + std::to_string(model.modes) + ',' + value(p.step) + ',' +
           value(p.tolerance) + ',' + (known ? exact_text(p.error) : std::string()) + ',' +
           exact_text(model.reference_error) + ',' + yes(known && p.resolved) + ',' + exact_text(p.cpu_s) + ',' +
           exact_text(p.setup_s);
    for (const long count : {p.work.steps, p.work.rejected, p.work.newton, p.work.factorisations, p.work.solves,
                             p.work.evaluations, p.n_events})
      csv += ',' + std::to_string(count);
    csv += std::string(",") + yes(on_front[i]) + ',' + quoted(p.failure) + ',' + quoted(p.settings) + '\n';
  }
  return csv;
}

std::string work_precision_text(const WorkPrecision &chart)
{
  const std::vector<WorkSeries> series = work_series(chart);
  std::string                   text;
  for (std::size_t m = 0; m < chart.models.size(); ++m)
  {
    const WorkModel &model = chart.models[m];
    text +=
        model_text(model) + "; reference: " + model.reference + ", error " + power_text(model.reference_error) + "\n";
    if (std::isfinite(model.truncation))
      text += "error due to truncated modes: " + short_text(model.truncation, 2) + "\n";
    text += "\nPareto front\n" + front_table(chart, int(m)) + "\n";
    for (const double target : chart.targets)
      text += choice_text(chart, series, int(m), target);
    text += "\n";
  }
  for (const std::string &note : chart.notes)
    text += "note: " + note + "\n";
  return text;
}

std::string work_precision_settings(const WorkPrecision &chart)
{
  const std::vector<WorkSeries> series = work_series(chart);
  const int                     model  = int(chart.models.size()) - 1;
  std::string                   text   = "# Settings for the scene " + chart.scene +
                     ", from gestell chart: fastest Gestell run for each error, " + model_text(chart.models[model]) +
                     ".\n# Use one of them for [run].\n";
  bool in_force = false;
  for (const double target : chart.targets)
  {
    const auto best = best_at_error(chart, series, model, true, target);
    text += "\n# error " + short_text(target, 2) + ": ";
    if (!best)
    {
      text += "no run reaches this error, or the reference does not resolve it\n";
      continue;
    }
    const WorkPoint &point = chart.points[best->at.point];
    text +=
        point.method + ", measured " + short_text(point.error, 2) + " in " + short_text(1e3 * point.cpu_s, 3) + " ms\n";
    const std::string entries = "[run]\n" + point.settings;
    for (std::size_t i = 0; i < entries.size();)
    {
      const std::size_t end = entries.find('\n', i);
      text += (in_force ? "# " : "") + entries.substr(i, end - i) + "\n";
      i = end + 1;
    }
    in_force = true;
  }
  return text;
}

} // namespace gestell::apps
