#include "apps/scene/read/frame/read_damping.h"

#include "apps/scene/file/expected_values.h"

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
  if (const std::string words = unexpected_words("ratio of damping", kind::number, zeta); !words.empty())
    table.warn("ratio", words + ", percent are written \"0.5 %\"");
}

fem::ModalRatios read_ratios(const SceneTable &damping)
{
  fem::ModalRatios ratios;
  if (damping.is_matrix("ratio"))
    for (const auto &[hz, zeta] : damping.pairs("ratio", kind::frequency, kind::number))
    {
      if (!(hz > (ratios.by_frequency.empty() ? 0. : ratios.by_frequency.back().first)))
        throw damping.error("ratio", "needs frequencies above zero in ascending order");
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
    ratios.constant = damping.value("ratio");
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
    omega[i] = 2. * M_PI * pairs[i].value("frequency");
    zeta[i]  = pairs[i].value("ratio");
    check_ratio(pairs[i], zeta[i]);
  }
  if (!(omega[1] > omega[0]))
    throw pairs[1].error("frequency", "must be above that of the first pair");
  const double squares = omega[1] * omega[1] - omega[0] * omega[0];
  result.beta          = 2. * (zeta[1] * omega[1] - zeta[0] * omega[0]) / squares;
  result.alpha         = 2. * omega[0] * omega[1] * (zeta[0] * omega[1] - zeta[1] * omega[0]) / squares;
  if (result.alpha < 0. || result.beta < 0.)
    throw damping.error("rayleigh", "would amplify some vibrations: the two ratios differ by a larger factor than "
                                    "their frequencies; use more similar ratios");
}

} // namespace

const std::vector<Key> &damping_keys()
{
  static const std::vector<Key> keys = {
      key::number("ratio", kind::number,
                  "damping ratio of all elastic modes of the supported frame; `[0.01, 0.02]`: of the first, and of the "
                  "second and all higher modes; `[[\"20 Hz\", 0.01], [\"90 Hz\", 0.02]]`: over frequency, linear "
                  "between the rows, constant beyond")
          .also({Key::Form::numbers, Key::Form::matrix})
          .by_default("`rayleigh`"),
      key::composed("rayleigh", Key::Form::tables, kind::number,
                    {key::number("frequency", kind::frequency, "frequency of a pair").above_zero(),
                     key::number("ratio", kind::number, "damping ratio at this frequency")},
                    "two pairs that determine B = αM + βC, proportional to mass and stiffness of the solids; modes "
                    "below and above both frequencies are damped more. With clamped supports, steps with many modes "
                    "are cheaper than for `ratio`")
          .by_default("`ratio`")};
  return keys;
}

FrameDamping read_damping(const SceneTable &any)
{
  const SceneTable damping = any.declared(damping_keys());
  FrameDamping     result;
  if (!damping.has("rayleigh"))
    result.ratios = read_ratios(damping);
  else if (damping.has("ratio"))
    throw damping.error("rayleigh", "defines the damping of all modes, as `ratio` does; remove one of them");
  else
    read_rayleigh(damping, result);
  return result;
}

} // namespace gestell::apps
