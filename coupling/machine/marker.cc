#include "coupling/machine/marker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// a + sign b without weights that cancel: along the axis of a rotor in a tilted plane, a_d - a_d (a.a) is 1e-17, which
/// a joint across its plane would treat as a motion.
Measure combine(const Measure &a, const Measure &b, double sign)
{
  std::map<int, double> sum(a.begin(), a.end());
  for (const auto &[coordinate, weight] : b)
  {
    double      &own   = sum[coordinate];
    const double terms = std::max(std::abs(own), std::abs(weight));
    own += sign * weight;
    // Relative to the larger of two terms: their rounding error if they cancel. Each is a product of components of unit
    // vectors with an error of 2 epsilon each, or a sum of three such products.
    constexpr double rounding = 16. * std::numeric_limits<double>::epsilon();
    if (std::abs(own) <= rounding * terms)
      own = 0.;
  }
  Measure result;
  for (const auto &term : sum)
    if (term.second != 0.)
      result.push_back(term);
  return result;
}

Measure projection(const std::array<Measure, 3> &motion, const Vector3 &direction)
{
  const double length =
      std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  if (!(length > 0.))
    throw std::invalid_argument(
        "marker: the direction has length zero; at least one of its three numbers must not be zero");
  Measure result;
  for (int d = 0; d < 3; ++d)
    if (direction[d] != 0.)
      result = result + (direction[d] / length) * motion[d];
  return result;
}
} // namespace

Measure operator+(const Measure &a, const Measure &b)
{
  return combine(a, b, 1.);
}
Measure operator-(const Measure &a, const Measure &b)
{
  return combine(a, b, -1.);
}

Measure operator*(double s, const Measure &a)
{
  Measure result;
  for (const auto &[coordinate, weight] : a)
    if (s * weight != 0.)
      result.emplace_back(coordinate, s * weight);
  return result;
}

Measure Marker::along(const Vector3 &direction) const
{
  return projection(translation, direction);
}
Measure Marker::about(const Vector3 &axis) const
{
  if (turns_freely)
    throw std::invalid_argument("\"" + name +
                                "\" is a free spatial body, which has no angle about a constant axis; use a [measure] "
                                "of type \"angle\", or a rotor connected to the body by a rigid joint");
  return projection(rotation, axis);
}

} // namespace gestell::coupling
