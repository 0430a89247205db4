#include "apps/analysis/periodic/periodic_headline.h"

#include "apps/output/text/change_text.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

std::string with_unit_of_parameter(const PeriodicResult &result, const std::string &number)
{
  return number + (result.parameter_unit.empty() ? "" : " " + result.parameter_unit);
}

/// "200 to 436, 470 to 600 1/min": where consecutive motions of a branch are stable.
std::string stable_stretches(const PeriodicResult &result)
{
  constexpr int        most_stretches = 3; // a line
  int                  n              = 0;
  std::string          text;
  const PeriodicEntry *first = nullptr, *last = nullptr;
  const auto           end_stretch = [&]
  {
    if (!first)
      return;
    const auto [low, high] = std::minmax(first->parameter, last->parameter);
    if (++n <= most_stretches)
      text += (n > 1 ? ", " : "") + short_text(low) + (high > low ? " to " + short_text(high) : "");
    first = nullptr;
  };
  for (const PeriodicEntry &entry : result.entries)
  {
    const bool stable = entry.solution.stable();
    if (first && (!stable || entry.branch != last->branch))
      end_stretch();
    if (stable)
    {
      first = first ? first : &entry;
      last  = &entry;
    }
  }
  end_stretch();
  return n == 0 ? "nowhere" : with_unit_of_parameter(result, text + (n > most_stretches ? ", ..." : ""));
}

double size_of(const SignalOrbit &signal)
{
  return std::max(std::abs(signal.max), std::abs(signal.min));
}

/// The largest value of a signal among all motions, and where.
KeyNumber largest_of(const PeriodicResult &result, std::size_t signal)
{
  const auto smaller = [&](const PeriodicEntry &a, const PeriodicEntry &b)
  { return size_of(a.signals[signal]) < size_of(b.signals[signal]); };
  const PeriodicEntry &most = *std::max_element(result.entries.begin(), result.entries.end(), smaller);
  const SignalOrbit   &of   = most.signals[signal];
  return {quantity_text(std::abs(of.max) >= std::abs(of.min) ? of.max : of.min, of.unit),
          "largest " + of.name +
              (result.parameter.empty() ? "" : ", at " + with_unit_of_parameter(result, short_text(most.parameter)))};
}

} // namespace

Headline headline_of(const PeriodicResult &result)
{
  if (result.entries.empty())
    return {"No periodic solution was found" + (result.failure.empty() ? std::string(".") : ": " + result.failure)};
  const auto count = [&](auto is)
  {
    return std::count_if(result.entries.begin(), result.entries.end(),
                         [&](const PeriodicEntry &entry) { return is(entry.solution); });
  };
  const auto stable  = count([](const coupling::PeriodicSolution &s) { return s.stable(); });
  const auto unknown = count([](const coupling::PeriodicSolution &s) { return !s.stability_is_known(); });
  const auto others  = long(result.entries.size()) - stable - unknown;
  Headline   headline{count_text(result.entries.size(), "periodic solution")};
  if (result.parameter.empty())
    headline.sentence += ", the first with a period of " + short_text(result.entries.front().solution.period, 6) + " s";
  else
  {
    const auto [low, high] =
        std::minmax_element(result.entries.begin(), result.entries.end(),
                            [](const PeriodicEntry &a, const PeriodicEntry &b) { return a.parameter < b.parameter; });
    headline.sentence += " with " + result.parameter + " from " + short_text(low->parameter) + " to " +
                         with_unit_of_parameter(result, short_text(high->parameter));
    headline.numbers.push_back({stable_stretches(result), "stable"});
  }
  headline.sentence +=
      ": " + std::to_string(stable) + " stable, " + std::to_string(others) + " unstable" +
      (unknown > 0 ? ", " + std::to_string(unknown) + " of unknown stability" : "") +
      (result.special_points.empty() ? "" : "; " + count_text(result.special_points.size(), "special point")) + ".";
  constexpr std::size_t           most_signals = 3; // each of another unit: a row of numbers
  const std::vector<SignalOrbit> &signals      = result.entries.front().signals;
  std::vector<std::string>        units;
  for (std::size_t j = 0; j < signals.size() && units.size() < most_signals; ++j)
    if (std::find(units.begin(), units.end(), signals[j].unit) == units.end())
    {
      units.push_back(signals[j].unit);
      headline.numbers.push_back(largest_of(result, j));
    }
  return headline;
}

} // namespace gestell::apps
