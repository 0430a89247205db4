#pragma once

#include <string>

namespace gestell::apps
{

/**
 * Keys of a topic in Markdown: of a table such as "run", or of all types of a family such as "joint".  Common keys are
 * first, then each type with its description, its own keys, signals and examples.
 *
 * @throws std::invalid_argument for a topic that is neither
 */
std::string key_tables(const std::string &topic);

/// The document with the text between its markers replaced by the generated one: from "<!-- keys: run -->", or "<!--
/// result files -->", to "<!-- end -->".
/// @param options  text for the marker "options"; empty: that section is left unchanged
std::string renewed(const std::string &document, const std::string &options = "");

/// Regenerates the schemas and all documents in the folder `reference` of the folder docs.
void renew_reference(const std::string &docs, const std::string &options);

} // namespace gestell::apps
