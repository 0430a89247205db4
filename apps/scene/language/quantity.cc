#include "apps/scene/language/quantity.h"

#include "fem/values/two_pi.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gestell::apps
{
namespace
{

std::string printed(double value)
{
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}

} // namespace

bool equal(const Dimension &a, const Dimension &b)
{
  for (int i = 0; i < 3; ++i)
    if (std::abs(a[i] - b[i]) > 1e-9)
      return false;
  return true;
}

std::string describe(const Dimension &dimension)
{
  static const std::vector<std::pair<Dimension, std::string>> known = {{{1, 1, -2}, "N"},   {{2, 1, -2}, "N m"},
                                                                       {{0, 1, -2}, "N/m"}, {{0, 1, -1}, "N s/m"},
                                                                       {{-1, 1, -2}, "Pa"}, {{2, 1, -1}, "N m s"}};
  for (const auto &[d, name] : known)
    if (equal(d, dimension))
      return name;
  const std::array<std::string, 3> names{"m", "kg", "s"};
  std::string                      above, below;
  for (const int i : {1, 0, 2}) // kg m/s reads better than m kg/s
    if (const double e = dimension[i]; std::abs(e) > 1e-9)
    {
      const std::string part = names[i] + (std::abs(std::abs(e) - 1.) < 1e-9 ? "" : "^" + printed(std::abs(e)));
      std::string      &side = e > 0 ? above : below;
      side += (side.empty() ? "" : " ") + part;
    }
  if (above.empty() && below.empty())
    return "a plain number";
  if (below.find(' ') != std::string::npos)
    below = "(" + below + ")";
  return (above.empty() ? "1" : above) + (below.empty() ? "" : "/" + below);
}

std::string with_article(const Kind &kind)
{
  const bool vowel = std::string("aeiou").find(kind.name.front()) != std::string::npos;
  return (vowel ? "an " : "a ") + kind.name;
}

namespace
{

/// Distinguishes radians and revolutions.
void check_counts(Counts counts, const Kind &kind, const std::string &needs_and_text)
{
  const bool        radians = kind.refused == Counts::turns, hertz = kind.refused == Counts::radians;
  const std::string write_radians = "; write 1/min, rpm or rad/s";
  if (counts == Counts::turns && radians)
    throw std::invalid_argument(needs_and_text + ", which counts revolutions" + write_radians);
  if (counts == Counts::radians && hertz)
    throw std::invalid_argument(needs_and_text + ", which counts radians; write Hz or 1/min");
  if (counts == Counts::minutes && radians)
    throw std::invalid_argument(needs_and_text + ", which contains minutes or hours and may count revolutions; write "
                                                 "1500/min for revolutions, rad/min or seconds for radians");
  if (counts == Counts::shaft_turns && !radians && !hertz)
    throw std::invalid_argument(needs_and_text + ", which counts revolutions (1/min, rpm)");
}

} // namespace

double per_radian(Counts counts, const Kind &kind)
{
  return counts == Counts::shaft_turns && kind.refused == Counts::radians ? 1. / two_pi : 1.;
}

void check_kind(const Quantity &q, bool is_zero, const Kind &kind, const std::string &text, const std::string &shown)
{
  const std::string needs = "needs " + with_article(kind) + " such as \"" + kind.example + "\", got ";
  bool              fits  = !q.checked;
  for (int more = 0; more <= kind.metre_range; ++more)
    fits = fits || equal(q.dimension, {kind.dimension[0] + more, kind.dimension[1], kind.dimension[2]});
  if (!fits && is_zero && equal(q.dimension, {}))
    fits = true; // zero of anything is zero
  if (!fits && equal(q.dimension, {}))
    throw std::invalid_argument(needs + "\"" + text +
                                "\" without a unit; write a plain number in SI units without quotes");
  if (!fits)
    throw std::invalid_argument(needs + "\"" + text + "\", " + shown);
  if (!is_zero)
    check_counts(q.counts, kind, needs + "\"" + text + "\"");
}

double value_as(const Quantity &q, const Kind &kind, const std::string &text)
{
  check_kind(q, q.value == 0., kind, text, printed(q.value) + " " + describe(q.dimension));
  return q.value * per_radian(q.counts, kind);
}

} // namespace gestell::apps
