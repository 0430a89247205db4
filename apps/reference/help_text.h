#pragma once

#include <string>

namespace gestell::apps
{

/**
 * Help on a topic of the scene language: the list of tables for "", the keys of a table ("element.rope", "rope"), all
 * keys of a name or last parts of one, in inner tables, too ("stiffness", "rope.stiffness", "damping.ratio"), or the
 * tables for a word of the workshop ("gib", synonyms.h).
 *
 * @throws std::invalid_argument with the most similar names.
 */
std::string help_text(const std::string &topic);

} // namespace gestell::apps
