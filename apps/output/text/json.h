#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace gestell::apps
{

/// A JSON value whose members keep their order.  It takes two seconds to compile: for sources alone, no headers.
using Json = nlohmann::ordered_json;

/// Indented text with a line end.  Numbers read back exactly; nan and infinities, which JSON lacks, become null; bytes
/// that are no UTF-8 become U+FFFD.
std::string json_text(const Json &value);

} // namespace gestell::apps
