#include "apps/output/tables/mode_tables.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gestell::apps
{

namespace
{

std::string words(const std::vector<std::string> &names, const Eigen::MatrixXd &shares, std::size_t mode)
{
  const Eigen::VectorXd own = shares.col(Eigen::Index(mode));
  if (own.array().isNaN().all()) // or there are no springs
    return "not defined";
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), 0);
  const auto size = [&](std::size_t i) { return std::abs(own[Eigen::Index(i)]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  std::string           text;
  constexpr double      least_named = 0.01; // share of the energy from which on an element or body is named
  constexpr std::size_t most_parts  = 4;    // what fits one cell of a table
  for (std::size_t k = 0; k < std::min(order.size(), most_parts); ++k)
    if (size(order[k]) >= least_named) // not nan
      text +=
          (text.empty() ? "" : ", ") + names[order[k]] + ' ' + short_text(100. * own[Eigen::Index(order[k])], 3) + " %";
  return text;
}

} // namespace

CsvTable modes_csv(const Result &result)
{
  if (result.frame_modes.empty() && result.coupled_modes.empty())
    return {};
  CsvTable csv({"mode", "frequency [Hz]", "damped frequency [Hz]", "damping ratio", "effective mass x [kg]",
                "effective mass y [kg]", "effective mass z [kg]", "kind", "growth [1/s]", "refined frequency [Hz]"});
  for (const auto &[kind, modes] : {std::pair("frame", &result.frame_modes), {"coupled", &result.coupled_modes}})
    for (std::size_t i = 0; i < modes->size(); ++i)
    {
      const coupling::Mode &mode = modes->at(i);
      csv.add(i + 1, mode.frequency_hz, mode.damped_frequency_hz, mode.damping_ratio, mode.effective_mass, kind,
              mode.growth, mode.refined_hz);
    }
  return csv;
}

CsvTable mode_energies_csv(const Result &result)
{
  if (!result.energy_shares)
    return {};
  CsvTable    csv({"mode", "frequency [Hz]", "energy", "part", "share"});
  const auto &shares = *result.energy_shares;
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
  {
    const auto add = [&](const char *energy, const std::vector<std::string> &names, const Eigen::MatrixXd &of)
    {
      for (std::size_t i = 0; i < names.size(); ++i)
        csv.add(j + 1, result.coupled_modes[j].frequency_hz, energy, names[i], of(Eigen::Index(i), Eigen::Index(j)));
    };
    add("strain", shares.springs, shares.strain);
    add("kinetic", shares.masses, shares.kinetic);
  }
  return csv;
}

std::string strain_text(const coupling::EnergyShares &shares, std::size_t mode)
{
  return words(shares.springs, shares.strain, mode);
}

std::string kinetic_text(const coupling::EnergyShares &shares, std::size_t mode)
{
  return words(shares.masses, shares.kinetic, mode);
}

} // namespace gestell::apps
