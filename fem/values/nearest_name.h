#pragma once

#include <string>
#include <vector>

namespace gestell
{

/// Smallest number of insertions, deletions, replacements and swaps of neighbours that change a into b.
int edit_distance(const std::string &a, const std::string &b);

/// The names similar enough to be intended, the most similar first; a path such as "frame.guide" is also found by its
/// part "guide".
std::vector<std::string> near_names(const std::string &name, const std::vector<std::string> &names);

/// The name most similar to `name`, or "" if none is similar enough.
std::string nearest_name(const std::string &name, const std::vector<std::string> &names);

/// "; did you mean 'stiffness'?" or, if none is similar, "; valid: a, b, c" (or nothing without names); of very many
/// names only the most similar ones.
std::string suggestion(const std::string &name, const std::vector<std::string> &names);

/// Quoted names, separated by commas.
std::string listed(const std::vector<std::string> &names);

/// "the nearest names are "feet", "face", "table"": at most three of the known names, for a message.
/// @param what  kind of the known names, "surface"
std::string nearest_names(const std::string &name, const std::vector<std::string> &known,
                          const std::string &what = "surface");

} // namespace gestell
