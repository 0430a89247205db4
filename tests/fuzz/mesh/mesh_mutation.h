#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gestell::fuzz
{

/**
 * The file of this number: a seed with one to six changes, each a bit or a byte turned, a piece cut out, doubled, moved
 * or exchanged with another seed's, a line lost or repeated, lines or sections exchanged, the end lost, or a number
 * replaced by an extreme one, in its text or in its bytes.  Equal numbers give equal files on all machines.
 *
 * @param seeds  one or more, none empty
 */
std::string mutated(const std::vector<std::string> &seeds, std::uint64_t number);

} // namespace gestell::fuzz
