// Derivatives by all parameters of the scenes that we ship, against quotients of converged runs.

#include "apps/session/session.h"
#include "fem/values/number_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>

namespace gestell::tests
{
namespace
{

using apps::SensitivityOutput;
using apps::Session;

using Values = std::map<std::string, double>;

/// Values of a run that are told as outputs with a derivative.
Values told(const apps::Result &result)
{
  Values values;
  for (const auto &signal : result.run->signals)
    for (const auto &[name, value] :
         {std::pair(".min", signal.min), std::pair(".max", signal.max), std::pair(".final", signal.final),
          std::pair(".t_min", signal.t_min), std::pair(".t_max", signal.t_max)})
      values[signal.name + name] = value;
  for (std::size_t i = 0; i < result.run->events.size(); ++i)
    values["events." + std::to_string(i + 1) + ".t"] = result.run->events[i].t;
  for (std::size_t i = 0; i < result.coupled_modes.size(); ++i)
    values["modes." + std::to_string(i + 1)] = result.coupled_modes[i].frequency_hz;
  return values;
}

bool is_time(const std::string &output)
{
  const std::string what = output.substr(output.rfind('.') + 1);
  return what == "t" || what == "t_min" || what == "t_max";
}

/// What an output is compared with: the largest value of its signal, the end of the run, its own value.
double size_of(const std::string &output, const Values &values, double end)
{
  if (output.compare(0, 6, "modes.") == 0)
    return std::abs(values.at(output));
  if (is_time(output))
    return end;
  const std::string signal = output.substr(0, output.rfind('.'));
  return std::max(std::abs(values.at(signal + ".min")), std::abs(values.at(signal + ".max")));
}

struct Quotient
{
  double value = 0., off = 0.; ///< x dy/dx and its error
};

/// Of central quotients over h, 2 h and 4 h, extrapolated to order 6; they differ from those of order 4 by their error.
Quotient quotient(const std::array<double, 6> &y, double h)
{
  const auto   central = [&](int i) { return (y[2 * i + 1] - y[2 * i]) / (2. * h * std::exp2(i)); };
  const double near = (4. * central(0) - central(1)) / 3., far = (4. * central(1) - central(2)) / 3.;
  return {(16. * near - far) / 15., std::abs(near - far) / 15.};
}

struct Shipped
{
  std::string              scene;
  std::vector<std::string> overrides; ///< by which its runs are converged
  double                   h;         ///< share of a value
};

/// How many derivatives were compared and how far off they are, relative to the largest value of their signal.
struct Found
{
  int                                         compared = 0, unclear = 0, none = 0;
  std::vector<std::pair<double, std::string>> off;

  void tell(const std::string &scene)
  {
    std::sort(off.rbegin(), off.rend());
    const auto beyond = [&](double limit)
    { return std::count_if(off.begin(), off.end(), [&](const auto &one) { return one.first > limit; }); };
    std::cout << scene << ": " << compared << " compared, " << unclear << " quotients not converged, " << none
              << " without derivative; beyond 1e-6: " << beyond(1e-6) << ", 1e-5: " << beyond(1e-5)
              << ", 1e-4: " << beyond(1e-4) << '\n';
    for (std::size_t i = 0; i < std::min<std::size_t>(off.size(), 8); ++i)
      std::cout << "  " << off[i].first << "  " << off[i].second << '\n';
  }
};

Found compare(const Shipped &shipped)
{
  const auto  path = std::string(GESTELL_SOURCE_DIR "/apps/scenes/") + shipped.scene;
  const auto  base = Session(path, shipped.overrides).run("all");
  const auto &all  = *base.sensitivities;
  EXPECT_EQ(all.failure, "");
  for (const std::string &warning : base.warnings)
    std::cout << "  warning: " << warning << '\n';
  const Values values = told(base);
  const double end    = base.run->rows[base.run->rows.size() - base.run->columns.size()];
  Found        found;
  for (std::size_t k = 0; k < all.keys.size(); ++k)
  {
    std::array<Values, 6> runs;
    for (int i = 0; i < 6; ++i)
    {
      const double share = (i % 2 == 0 ? -1. : 1.) * shipped.h * std::exp2(i / 2);
      auto         more  = shipped.overrides; // values in SI, read with their unit
      more.push_back(all.keys[k].key + "=" + exact_text(all.keys[k].value * (1. + share)) +
                     (all.keys[k].unit.empty() ? "" : " " + all.keys[k].unit));
      runs[std::size_t(i)] = told(Session(path, more).run());
    }
    for (const SensitivityOutput &output : all.outputs)
    {
      std::array<double, 6> y;
      bool                  has = true;
      for (std::size_t i = 0; i < 6; ++i)
      {
        const auto at = runs[i].find(output.output);
        has           = has && at != runs[i].end();
        y[i]          = has ? at->second : 0.;
      }
      const Quotient of   = quotient(y, shipped.h);
      const double   size = size_of(output.output, values, end),
                   given  = output.derivative[Eigen::Index(k)] * all.keys[k].value;
      if (!std::isfinite(given))
      {
        EXPECT_NE(output.note, "") << output.output;
        ++found.none;
      }
      else if (!has || !(of.off < 1e-6 * std::max(size, std::abs(of.value))))
        ++found.unclear;
      else if (size > 0.)
      {
        ++found.compared;
        found.off.emplace_back(std::abs(given - of.value) / std::max(size, std::abs(of.value)),
                               output.output + " by " + all.keys[k].key + ": " + exact_text(given) + " for " +
                                   exact_text(of.value) + " +- " + short_text(of.off) + " of " + short_text(size) +
                                   ' ' + output.unit);
      }
    }
  }
  found.tell(shipped.scene);
  return found;
}

class OfShippedScenes : public ::testing::TestWithParam<Shipped>
{
};

TEST_P(OfShippedScenes, AreQuotientsOfConvergedRuns)
{
  const Found found = compare(GetParam());
  EXPECT_GT(found.compared, 20);
  EXPECT_LT(found.off.front().first, 1e-4) << found.off.front().second;
}

// Other scenes take minutes to hours of CPU time each, or move chaotically.
const std::vector<std::string> converged = {"run.tolerance=1e-11"};
INSTANTIATE_TEST_SUITE_P(LongSensitivities, OfShippedScenes,
                         ::testing::Values(Shipped{"crane_minimal.toml", converged, 1e-4},
                                           Shipped{"press_minimal_light.toml", converged, 1e-4},
                                           Shipped{"crank_press_joints.toml", converged, 1e-4},
                                           Shipped{"double_four_bar.toml", converged, 1e-4}),
                         [](const auto &info) { return info.param.scene.substr(0, info.param.scene.find('.')); });

} // namespace
} // namespace gestell::tests
