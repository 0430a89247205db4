#include "apps/scene/read/frame/read_damping.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

void check_ratio(const SceneTable &table, double zeta)
{
  if (zeta < 0.)
    throw table.error("ratio", "needs damping ratios of zero or more");
  if (zeta >= 1.)
    throw table.error("ratio", "a damping ratio of 1 or more leaves no vibration; steel frames have 0.01 to 0.03");
}

fem::ModalRatios read_ratios(const SceneTable &damping)
{
  fem::ModalRatios ratios;
  if (damping.is_matrix("ratio"))
    for (const auto &[hz, zeta] : damping.pairs("ratio", kind::frequency, kind::number))
    {
      if (!(hz > (ratios.by_frequency.empty() ? 0. : ratios.by_frequency.back().first)))
        throw damping.error("ratio", "needs frequencies above zero that grow from row to row");
      ratios.by_frequency.emplace_back(hz, zeta);
      check_ratio(damping, zeta);
    }
  else if (damping.is_array("ratio"))
  {
    ratios.by_mode = damping.numbers("ratio", kind::number);
    if (ratios.by_mode.empty())
      throw damping.error("ratio", "is empty; give one number for all modes, or one for each of the lowest");
    for (const double zeta : ratios.by_mode)
      check_ratio(damping, zeta);
  }
  else
  {
    ratios.constant = damping.number("ratio", kind::number);
    check_ratio(damping, ratios.constant);
  }
  return ratios;
}

/// zeta = (alpha / omega + beta omega) / 2 at two frequencies.
void read_rayleigh(const SceneTable &damping, FrameDamping &result)
{
  const auto pairs = damping.table_array("rayleigh");
  if (pairs.size() != 2)
    throw damping.error("rayleigh", "has " + std::to_string(pairs.size()) +
                                        " pairs; it needs two, [{ frequency = \"20 Hz\", ratio = 0.01 }, { ... }]");
  double omega[2], zeta[2];
  for (int i = 0; i < 2; ++i)
  {
    omega[i] = 2. * M_PI * pairs[i].positive("frequency", kind::frequency);
    zeta[i]  = pairs[i].number("ratio", kind::number);
    check_ratio(pairs[i], zeta[i]);
  }
  if (!(omega[1] > omega[0]))
    throw pairs[1].error("frequency", "must lie above that of the first pair");
  const double squares = omega[1] * omega[1] - omega[0] * omega[0];
  result.beta          = 2. * (zeta[1] * omega[1] - zeta[0] * omega[0]) / squares;
  result.alpha         = 2. * omega[0] * omega[1] * (zeta[0] * omega[1] - zeta[1] * omega[0]) / squares;
  if (result.alpha < 0. || result.beta < 0.)
    throw damping.error("rayleigh", "would feed some vibrations instead of damping them: the two ratios differ by more "
                                    "than their frequencies do; bring them nearer to each other");
}

} // namespace

FrameDamping read_damping(const SceneTable &damping)
{
  FrameDamping result;
  if (!damping.has("rayleigh"))
    result.ratios = read_ratios(damping);
  else if (damping.has("ratio"))
    throw damping.error("rayleigh", "says how all modes are damped, as `ratio` does; leave out one of them");
  else
    read_rayleigh(damping, result);
  return result;
}

} // namespace gestell::apps
