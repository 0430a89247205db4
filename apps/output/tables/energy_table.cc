#include "apps/output/tables/energy_table.h"

#include "apps/output/text/csv.h"
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
  if (own.array().isNaN().all()) // or there is no spring
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

void append_rows(std::string &csv, const std::string &head, const char *energy, const std::vector<std::string> &names,
                 const Eigen::MatrixXd &shares, Eigen::Index mode)
{
  for (std::size_t i = 0; i < names.size(); ++i)
    csv += head + energy + "," + csv_field(names[i]) + "," + exact_text(shares(Eigen::Index(i), mode)) + "\n";
}

} // namespace

std::string mode_energies_csv(const Result &result)
{
  std::string                   csv    = "mode,frequency [Hz],energy,part,share\n";
  const coupling::EnergyShares &shares = *result.energy_shares;
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
  {
    const std::string head = std::to_string(j + 1) + ',' + exact_text(result.coupled_modes[j].frequency_hz) + ',';
    append_rows(csv, head, "strain", shares.springs, shares.strain, Eigen::Index(j));
    append_rows(csv, head, "kinetic", shares.masses, shares.kinetic, Eigen::Index(j));
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
