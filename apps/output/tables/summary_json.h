#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// summary.json: the whole result in numbers, as describe() lists its members.
std::string summary_json(const Result &result);

/// Table rows of its members for docs/reference/summary_json.md, and its JSON schema, docs/summary.schema.json.
/// @param all  a result with an empty answer of every analysis
std::string summary_members(const Result &all);
std::string summary_schema(const Result &all);

} // namespace gestell::apps
