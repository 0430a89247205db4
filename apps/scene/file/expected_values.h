#pragma once

#include "apps/scene/language/quantity.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Why the value of a key is implausible: "is 1500 rad/s; expected: at most 400 rad/s, as ..."; else "".
 *
 * Ranges of keys and, for all other keys, of kinds are in one table (docs/reference/scene/magnitudes.md): typical
 * values of machines, not limits of the laws.  Zero is always plausible.
 */
std::string unexpected_words(const std::string &key, const Kind &kind, double value);

/// A value that is implausible by docs/reference/scene/magnitudes.md.
struct UnexpectedValue
{
  std::string place;       ///< "press.toml:12: element.rod.stiffness"
  std::string words;       ///< "yields by 0.7 m; expected: at most 50 mm, ...; check ..."
  double      excess = 1.; ///< ratio of the value to the limit that it exceeds, or of the limit to the value
};

/// Whether a warning is about a plausible range.
bool compares_magnitudes(const std::string &warning);

/**
 * One mistake makes several values implausible.  They are added to an existing warning, which is closer to the cause;
 * without one a warning is made for the value farthest outside its range, which lists the others.
 *
 * @param warnings  of earlier checks
 */
void warn_of_magnitudes(std::vector<UnexpectedValue> found, std::vector<std::string> &warnings);

} // namespace gestell::apps
