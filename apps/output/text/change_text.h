#pragma once

#include <string>

namespace gestell::apps
{

/// How a value differs from another in magnitude, the same words for thrust and pull: "9.1 % larger" of -120 beside
/// -110, "the same", "of the other sign"; empty where one is no number, and beside zero.
std::string change_text(double here, double there);

} // namespace gestell::apps
