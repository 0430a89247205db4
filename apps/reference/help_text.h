#pragma once

#include <string>

namespace gestell::apps
{

/**
 * What the scene language says about `topic`: the list of tables for "", the keys of a table ("element.rope", "rope"),
 * or every key of that name ("stiffness", "element.rope.stiffness").
 *
 * @throws std::invalid_argument with the nearest names.
 */
std::string help_text(const std::string &topic);

} // namespace gestell::apps
