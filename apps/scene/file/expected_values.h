#pragma once

#include "apps/scene/language/quantity.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * What speaks against the value of a key: "is 1500 rad/s; expected: at most 400 rad/s, as ..."; empty if nothing does.
 *
 * Ranges of keys and, for all others, of kinds stand in one table (docs/scene/magnitudes.md): what machines have, not
 * what laws allow.  Zero is always expected.
 */
std::string unexpected_words(const std::string &key, const Kind &kind, double value);

/// A value that machines hardly have, by docs/scene/magnitudes.md.
struct UnexpectedValue
{
  std::string place;       ///< "press.toml:12: element.rod.stiffness"
  std::string words;       ///< "yields by 0.7 m; expected: at most 50 mm, ...; check ..."
  double      excess = 1.; ///< the value over the limit it is above, or the limit over the value
};

/// Whether a warning compares a value with an expected range.
bool compares_magnitudes(const std::string &warning);

/**
 * One mistake makes several values unexpected: the warning that is there already, which is nearer to its cause, names
 * them; else one is made of the value farthest out of its range, which names the others.
 *
 * @param warnings  of what was looked at before
 */
void warn_of_magnitudes(std::vector<UnexpectedValue> found, std::vector<std::string> &warnings);

} // namespace gestell::apps
