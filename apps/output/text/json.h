#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace gestell::apps
{

/// A JSON value whose members keep their order.  The header takes two seconds to compile: include it in .cc files only.
using Json = nlohmann::ordered_json;

/// Indented text with a final line end.  Numbers are read back exactly; nan and infinities, which JSON lacks, become
/// null; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json &value);

} // namespace gestell::apps
