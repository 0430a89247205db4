#pragma once

#include <string>

namespace gestell::apps
{

/// Difference between two values in magnitude, the same wording for either sign: "9.1 % larger" for -120 compared with
/// -110, "the same", "of the other sign"; empty if one is not a number or `there` is zero.
std::string change_text(double here, double there);

/// "1060 kN" for 1.06e6 "N".
std::string quantity_text(double value, const std::string &si_unit, int digits = 4);

} // namespace gestell::apps
