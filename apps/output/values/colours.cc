#include "apps/output/values/colours.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gestell::apps
{

Colour scale_colour(double s)
{
  static const std::array<Colour, 5> stops = {
      {{64, 67, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double      place = 4. * std::clamp(s, 0., 1.);
  const std::size_t i     = std::min<std::size_t>(static_cast<std::size_t>(place), 3);
  Colour            mixed;
  for (std::size_t k = 0; k < 3; ++k)
    mixed[k] = stops[i][k] + (place - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k]);
  return mixed;
}

Colour face_colour(int index)
{
  // Hues a golden ratio apart, in three lightnesses.
  const double hue   = std::fmod(0.11 + 0.618033988749895 * index, 1.);
  const double light = 0.62 + 0.1 * (index % 3), chroma = 0.42;
  Colour       colour;
  for (int k = 0; k < 3; ++k)
  {
    const double at = std::fmod(hue + (3. - k) / 3., 1.), ramp = std::abs(6. * at - 3.) - 1.;
    colour[static_cast<std::size_t>(k)] =
        255. * (light + chroma * (std::min(std::max(ramp, 0.), 1.) - 0.5) * (1. - std::abs(2. * light - 1.)) * 1.6);
  }
  return colour;
}

std::string hex(const Colour &colour)
{
  const auto part = [&](std::size_t k) { return std::clamp(static_cast<int>(colour[k]), 0, 255); };
  char       text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(0), part(1), part(2));
  return text;
}

} // namespace gestell::apps
