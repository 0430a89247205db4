#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Kinds of transition of all laws, joints and switches; kinks of a formula are in addition named NAME_rises and
/// NAME_falls.
const std::vector<std::string> &event_kinds();

bool is_event_kind(const std::string &word);

} // namespace gestell::apps
