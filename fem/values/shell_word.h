#pragma once

#include <string>

namespace gestell::fem
{

/// A text as one word of a shell: in single quotes.
std::string shell_word(const std::string &text);

/// The same for commands that are shown: in quotes only where the shell needs them.
std::string typed_word(const std::string &text);

} // namespace gestell::fem
