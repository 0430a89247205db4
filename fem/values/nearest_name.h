#pragma once

#include <string>
#include <vector>

namespace gestell
{

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn a into b.
int edit_distance(const std::string &a, const std::string &b);

/// The names that are near enough to be meant, the nearest first; a path such as "frame.guide" by its part "guide",
/// too.
std::vector<std::string> near_names(const std::string &name, const std::vector<std::string> &names);

/// The name most like `name`, or "" if none is near enough to be meant.
std::string nearest_name(const std::string &name, const std::vector<std::string> &names);

/// "; did you mean 'stiffness'?" or, if nothing is near, "; valid: a, b, c" (or nothing for no names at all); of very
/// many names the nearest few.
std::string suggestion(const std::string &name, const std::vector<std::string> &names);

/// Names in quotes with commas.
std::string listed(const std::vector<std::string> &names);

/// "the nearest names are "feet", "face", "table"": at most three of the known names, for a message.
/// @param what  the known names stand for, "surface"
std::string nearest_names(const std::string &name, const std::vector<std::string> &known,
                          const std::string &what = "surface");

} // namespace gestell
