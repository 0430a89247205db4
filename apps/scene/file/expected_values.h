#pragma once

#include "apps/scene/language/quantity.h"

#include <string>

namespace gestell::apps
{

/**
 * What speaks against the value of a key: "is 1500 rad/s; expected: at most 400 rad/s, as ..."; empty if nothing does.
 *
 * Ranges of keys and, for all others, of kinds stand in one table (docs/scene/magnitudes.md): what machines have, not
 * what laws allow.  Zero is always expected.
 */
std::string unexpected_words(const std::string &key, const Kind &kind, double value);

} // namespace gestell::apps
