#include "coupling/simulation/kept_size.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double most_bytes = 1e9; ///< what a laptop has to spare

template <typename... Parts>
[[noreturn]] void too_large(const Parts &...parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

} // namespace

KeptBytes kept_bytes(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  const double length = options.end - options.begin, columns = 1. + double(n_signals) + (options.energy ? 3. : 0.),
               picture_rate = options.picture_step > 0. ? 1. / options.picture_step : 0.,
               state_rate   = options.states.step > 0. ? 1. / options.states.step : 0.;
  return {8. * columns * (length / output_step(options) + 1.), 32. * machine.size() * (length * picture_rate + 1.),
          8. * machine.size() * (length * state_rate + 1.)};
}

void require_size(const Machine &machine, const RunOptions &options, std::size_t n_signals)
{
  constexpr double most_pictures = 2e4;
  const double     count = options.picture_step > 0. ? (options.end - options.begin) / options.picture_step : 0.;
  if (!options.allow_large && count > most_pictures)
    too_large("output.picture_step makes ", count, " pictures of several files each; give it a larger value than ",
              options.picture_step, " s, or say output.allow_large = true if that is what you want");
  const auto [history, pictures, states] = kept_bytes(machine, options, n_signals);
  if (!options.allow_large && states > most_bytes)
    too_large("the run would keep ", states / 1e9,
              " GB of states to look for the largest stress; give output.stress.step ", "a larger value than ",
              options.states.step, " s, or say output.allow_large = true");
  if (options.allow_large || history + pictures <= most_bytes)
    return;
  too_large("the run would keep ", history / 1e9, " GB of history and ", pictures / 1e9,
            " GB of states for pictures; give output.step", history > pictures ? "" : " or output.picture_step",
            " a larger value than ", history > pictures ? output_step(options) : options.picture_step,
            " s, or say output.allow_large = true if that is what you want");
}

} // namespace gestell::coupling
