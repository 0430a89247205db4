#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// The place of a word among those of a choice.
/// @param what  it is, such as "search method"
/// @throws std::invalid_argument for another word, with the nearest one
std::size_t word_choice(const std::string &word, const std::vector<std::string> &words, const std::string &what);

} // namespace gestell::apps
