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
  return constant > 0. ||
         std::any_of(by_frequency.begin(), by_frequency.end(), [&](const auto &row) { return positive(row.second); }) ||
         std::any_of(named.begin(), named.end(), [&](const NamedRatio &one) { return positive(one.ratio); });
}

double ModalRatios::at(int mode, double omega) const
{
  const double hz   = omega / two_pi;
  const auto   find = [&](const auto &names) { return std::find_if(named.begin(), named.end(), names); };
  auto         own  = find([&](const NamedRatio &one) { return one.mode == mode; });
  if (own == named.end())
    own = find([&](const NamedRatio &one) { return one.mode < 0 && one.from <= hz && hz < one.to; });
  if (own != named.end())
    return own->ratio;
  if (by_frequency.empty())
    return constant;
  const auto above =
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
  if (!named.empty())
  {
    write_list(out, named,
               [&](const NamedRatio &one)
               {
                 out << 100. * one.ratio << " % ";
                 if (one.mode >= 0)
                   out << "in mode " << one.mode + 1;
                 else if (one.is_measured())
                   out << "measured at " << one.from << " Hz";
                 else
                   out << "from " << one.from << " to " << one.to << " Hz";
               });
    out << "; of the others ";
  }
  if (!by_frequency.empty())
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
