#include "fem/values/modal_ratios.h"

#include "fem/values/two_pi.h"

#include <algorithm>
#include <sstream>

namespace gestell::fem
{

namespace
{

template <typename Values, typename Write>
void write_list(std::ostringstream &out, const Values &values, const Write &write)
{
  constexpr std::size_t n_shown = 6; // numbers of a list or table: a line of text
  for (std::size_t i = 0; i < std::min(values.size(), n_shown); ++i)
  {
    out << (i > 0 ? ", " : "");
    write(values[i]);
  }
  if (values.size() > n_shown)
    out << ", ...";
}

} // namespace

bool ModalRatios::any() const
{
  const auto positive = [](double zeta) { return zeta > 0.; };
  return constant > 0. || std::any_of(by_mode.begin(), by_mode.end(), positive) ||
         std::any_of(by_frequency.begin(), by_frequency.end(), [&](const auto &row) { return positive(row.second); });
}

double ModalRatios::at(int mode, double omega) const
{
  if (!by_mode.empty())
    return by_mode[std::min<std::size_t>(mode, by_mode.size() - 1)];
  if (by_frequency.empty())
    return constant;
  const double hz = omega / two_pi;
  const auto   above =
      std::find_if(by_frequency.begin(), by_frequency.end(), [&](const auto &row) { return row.first >= hz; });
  if (above == by_frequency.begin())
    return above->second;
  if (above == by_frequency.end())
    return by_frequency.back().second;
  const auto &[f0, z0] = *(above - 1);
  const auto &[f1, z1] = *above;
  return z0 + (z1 - z0) * (hz - f0) / (f1 - f0);
}

Eigen::VectorXd ModalRatios::modal_dampers(const Eigen::VectorXd &omega) const
{
  Eigen::VectorXd d = Eigen::VectorXd::Zero(omega.size());
  for (Eigen::Index j = 0, elastic = 0; j < omega.size(); ++j)
    if (omega[j] > 0.)
      d[j] = 2. * at(static_cast<int>(elastic++), omega[j]) * omega[j];
  return d;
}

std::string ModalRatios::text() const
{
  std::ostringstream out;
  out.precision(4);
  if (!by_mode.empty())
  {
    write_list(out, by_mode, [&](double zeta) { out << 100. * zeta << " %"; });
    out << " of critical in the elastic modes of the frame one by one, the last in all above";
  }
  else if (!by_frequency.empty())
  {
    write_list(out, by_frequency, [&](const auto &row) { out << 100. * row.second << " % at " << row.first << " Hz"; });
    out << " of critical, linear between, in the modes of the frame";
  }
  else if (constant > 0.)
    out << 100. * constant << " % of critical in every mode of the frame";
  else
    out << "none in the modes of the frame";
  return out.str();
}

} // namespace gestell::fem
