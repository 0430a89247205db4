#pragma once

#include <string>

namespace gestell::apps
{

/**
 * Help on a topic of the scene language: the list of tables for "", the keys of a table ("element.rope", "rope"), all
 * keys of a name ("stiffness", "element.rope.stiffness"), or the tables for a word of the workshop ("gib", synonyms.h).
 *
 * @throws std::invalid_argument with the most similar names.
 */
std::string help_text(const std::string &topic);

} // namespace gestell::apps
