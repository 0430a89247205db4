#pragma once

#include <string>
#include <vector>

namespace gestell::fuzz
{

/**
 * The k-th mutation of some seeds, the same on every machine: one of them with one to eight changes, each a byte
 * flipped, a piece cut out, doubled, moved or taken from another seed, a line lost or repeated, a number replaced by
 * an extreme one, or what editors leave behind (a mark of UTF-8, a zero, an end of line of Windows).
 *
 * @param seeds  one or more
 */
std::string mutation(const std::vector<std::string> &seeds, unsigned k);

/// Seeds of a target: the files of tests/fuzz/seeds/TARGET, or the lines of tests/fuzz/seeds/TARGET.txt.
std::vector<std::string> seeds_of(const std::string &target, const std::string &source_folder);

/// Contents of the files of a folder, in the order of their names; none if there is no folder.
std::vector<std::pair<std::string, std::string>> files_in(const std::string &folder);

} // namespace gestell::fuzz
