#include "apps/output/tables/sensitivity_table.h"

#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{

namespace
{

/// Why there is no derivative, or how the frame's share was found.
std::string note_of(const SensitivityOutput &output, const SensitivityKey &key, Eigen::Index k)
{
  return std::isfinite(output.derivative[k]) ? key.frame : output.note;
}

std::string number(double x)
{
  return std::isfinite(x) ? exact_text(x) : "";
}

} // namespace

std::string derivative_unit(const SensitivityOutput &output, const SensitivityKey &key)
{
  if (key.unit.empty())
    return output.unit;
  const std::string above = output.unit.empty() ? "1" : output.unit;
  return above + "/(" + key.unit + ')';
}

std::vector<Eigen::Index> by_influence(const SensitivityResult &result, const SensitivityOutput &output)
{
  std::vector<Eigen::Index> order;
  const auto       change    = [&](Eigen::Index k) { return std::abs(output.percent(result.keys[std::size_t(k)], k)); };
  constexpr double no_change = 1e-9; // [%] 1e-11 of the value: rounding
  for (Eigen::Index k = 0; k < Eigen::Index(result.keys.size()); ++k)
    if (const double size = change(k); std::isfinite(size) && size > no_change)
      order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return change(a) > change(b); });
  return order;
}

std::string sensitivities_csv(const SensitivityResult &result)
{
  std::string csv = "output,key,derivative,unit,change by 1 %,note\n";
  for (const SensitivityOutput &output : result.outputs)
    for (Eigen::Index k = 0; k < output.derivative.size(); ++k)
    {
      const SensitivityKey &key = result.keys[std::size_t(k)];
      csv += csv_field(output.output) + ',' + csv_field(key.key) + ',' + number(output.derivative[k]) + ',' +
             csv_field(derivative_unit(output, key)) + ',' + number(output.percent(key, k)) + ',' +
             csv_field(note_of(output, key, k)) + '\n';
    }
  return csv;
}

std::string sensitivities_text(const SensitivityResult &result)
{
  std::ostringstream text;
  text << "1 % more changes (+: away from zero)\n";
  for (const SensitivityOutput &output : result.outputs)
  {
    const std::string &name = output.output;
    const bool         peak =
        name.size() > 4 && (name.substr(name.size() - 4) == ".max" || name.substr(name.size() - 4) == ".min");
    const auto keys = by_influence(result, output);
    if (!peak || keys.empty())
      continue;
    text << "  " << std::left << std::setw(14) << name;
    constexpr std::size_t most_listed = 3; // keys of an output in a terminal
    for (std::size_t i = 0; i < std::min(most_listed, keys.size()); ++i)
    {
      const SensitivityKey &key    = result.keys[std::size_t(keys[i])];
      const double          change = output.percent(key, keys[i]);
      text << (i > 0 ? ", " : "") << key.key << ": " << (change > 0. ? "+" : "") << short_text(change, 3) << " %";
    }
    text << '\n';
  }
  return text.str();
}

} // namespace gestell::apps
