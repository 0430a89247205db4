#include "apps/output/charts/chart_axis.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr double rounding = 1e-9; ///< of logarithms: a power of ten is its own decade

/// m times 10 to the n: from 0.01 to 10 000 in full, else with raised digits.
std::string power_text(double value)
{
  static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

  if (!(value > 0.) || !std::isfinite(value))
    return short_text(value, 6);
  const int exponent = static_cast<int>(std::floor(std::log10(value) + rounding));
  if (exponent >= -2 && exponent <= 3)
    return short_text(value, 6);
  const std::string factor = short_text(value * std::pow(10., -exponent), 3);
  std::string       text   = (factor == "1" ? "" : factor + "·") + (exponent < 0 ? "10⁻" : "10");
  for (const char digit : std::to_string(std::abs(exponent)))
    text += raised[digit - '0'];
  return text;
}

std::vector<double> logarithmic_ticks(double begin, double end, int count)
{
  const double first = std::log10(begin), last = std::log10(end);
  const bool   few   = last - first < 2.5;
  const int    every = static_cast<int>(std::ceil((last - first) / count));

  std::vector<double> ticks;
  for (int n = static_cast<int>(std::floor(first - rounding)); n <= last + rounding; ++n)
    for (const double part : {1., 2., 5.})
    {
      const double value = part * std::pow(10., n), place = std::log10(value);
      if (place >= first - rounding && place <= last + rounding && (few || (part == 1. && n % every == 0)))
        ticks.push_back(value);
    }
  return ticks;
}

} // namespace

std::vector<double> nice_ticks(double low, double high, int count)
{
  if (!(high > low) || count < 1)
    return {};
  const double rough = (high - low) / count, power = std::pow(10., std::floor(std::log10(rough)));
  const double step = power * (rough <= 1.5 * power ? 1. : rough <= 3.5 * power ? 2. : rough <= 7.5 * power ? 5. : 10.);

  std::vector<double> ticks;
  for (long i = static_cast<long>(std::ceil(low / step - 1e-9)); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

bool ChartAxis::has_place(double value) const
{
  return std::isfinite(value) && (scale == Scale::linear || value > 0.);
}

ChartAxis fitted(ChartAxis axis, double low, double high, double room)
{
  const bool logarithmic = axis.scale == Scale::logarithmic;
  if (!(low <= high))
  {
    low  = logarithmic ? 1. : -1.;
    high = logarithmic ? 10. : 1.;
  }
  if (logarithmic)
  {
    const double wider =
        std::pow(10., std::max(0.08, 0.4 - 0.5 * std::log10(high / low))); // at least two ticks in sight
    low /= wider;
    high *= wider;
  }
  else
  {
    const double span = high - low, least = 1e-9 * std::max({std::abs(low), std::abs(high), 1e-30});
    const double wider = span > least ? room * span : high == 0. ? 1. : std::max(0.05 * std::abs(high), 1e-12);
    low -= wider;
    high += wider;
  }
  axis.begin = std::isnan(axis.begin) ? low : axis.begin;
  axis.end   = std::isnan(axis.end) ? high : axis.end;
  if (!(axis.end > axis.begin) || !axis.has_place(axis.begin))
    throw std::invalid_argument("chart: the axis \"" + axis.label + "\" from " + exact_text(axis.begin) + " to " +
                                exact_text(axis.end) + " is empty; begin below the end, a logarithmic one above zero.");
  return axis;
}

std::vector<Tick> ticks_of(const ChartAxis &axis, int count)
{
  const bool        logarithmic = axis.scale == Scale::logarithmic;
  std::vector<Tick> ticks;
  for (const double value : !axis.ticks.empty() ? axis.ticks
                            : logarithmic       ? logarithmic_ticks(axis.begin, axis.end, 2 * count)
                                                : nice_ticks(axis.begin, axis.end, count))
    ticks.push_back({value, axis.tick_text ? axis.tick_text(value)
                            : logarithmic  ? power_text(value)
                                           : short_text(value, 6)});
  return ticks;
}

AxisMap::AxisMap(const ChartAxis &axis, double first, double last)
    : scale_(axis.scale), begin_(scale_ == Scale::logarithmic ? std::log10(axis.begin) : axis.begin), first_(first)
{
  const double end = scale_ == Scale::logarithmic ? std::log10(axis.end) : axis.end;
  factor_          = (last - first) / (end - begin_);
}

double AxisMap::at(double value) const
{
  const double v = scale_ == Scale::logarithmic ? std::log10(value) : value;
  return std::clamp(first_ + (v - begin_) * factor_, -2000., 5000.);
}

} // namespace gestell::apps
