#pragma once

#include <string>

namespace gestell::fem
{

/// A string as one shell word, in single quotes.
std::string shell_word(const std::string &text);

/// The same for commands in messages: quoted only if necessary.
std::string typed_word(const std::string &text);

} // namespace gestell::fem
