#include "apps/output/pictures/chosen_pictures.h"

#include <algorithm>

namespace gestell::apps
{

std::vector<std::size_t> chosen_pictures(const Result &result, std::size_t most)
{
  const std::vector<double> &times = result.run->picture_times;
  const std::size_t          n     = times.size();
  std::vector<std::size_t>   chosen;
  for (std::size_t i = 0; i < std::min(n, most); ++i)
    chosen.push_back(n <= most ? i : i * (n - 1) / (most - 1));
  if (n <= most || !result.peak)
    return chosen;
  // The first state behind the peak is the one at it, if there is one.
  const std::size_t peak = std::lower_bound(times.begin(), times.end() - 1, result.peak->t) - times.begin();
  if (peak > 0 && peak < n - 1)
    *std::lower_bound(chosen.begin() + 1, chosen.end() - 2, peak) = peak;
  return chosen;
}

} // namespace gestell::apps
