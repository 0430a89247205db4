#pragma once

#include <string>

namespace gestell::apps
{

/**
 * The keys that `topic` names in Markdown: those of a table such as "run", or of all types of a family such as "joint",
 * keys that many of them share first, then each type with its sentence, its own keys, signals and examples.
 *
 * @throws std::invalid_argument for a topic that is neither
 */
std::string key_tables(const std::string &topic);

/// A document with the text between its markers as the declarations give it: "<!-- keys: run -->", or "<!-- result
/// files
/// -->", to "<!-- end -->".
std::string renewed(const std::string &document);

/// Renews the schema and all documents in the folder docs, those in its folder scene, scene.md and results.md.
void renew_reference(const std::string &docs);

} // namespace gestell::apps
