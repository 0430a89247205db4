#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A word of the workshop, and the tables of a scene that describe it.
struct Synonym
{
  std::string              word;
  std::vector<std::string> tables; ///< "element.belt"
};

/// All of them; to add one, write its line.
const std::vector<Synonym> &synonyms();

} // namespace gestell::apps
