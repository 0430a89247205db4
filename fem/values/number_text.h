#pragma once

#include <cstddef>
#include <string>

namespace gestell
{

/// Appends the shortest decimal text that reads back as exactly x; "nan", "inf", "-inf" for other values.
void append_exact(std::string &text, double x);

/// The same as a separate string.
std::string exact_text(double x);

/// x with few significant digits, for people, without an exponent between 1e-3 and 1e6; "-0" becomes "0".
std::string short_text(double x, int digits = 4);

/// A number for notes and messages.
std::string rounded(double value, int digits = 4);

/// "2.5 %" for a share of 0.025.
std::string percent(double share, int digits = 3);

/// "1 file", "2 files"; or "2 bodies" with an irregular plural.
std::string count_text(std::size_t n, const std::string &one, const std::string &many = "");

/// Number of characters in a UTF-8 string, not of its bytes.
std::size_t n_letters(const std::string &text);

/// A display unit: a value in SI times `factor` is the number in `unit`.
struct DisplayUnit
{
  double      factor = 1.;
  std::string unit;
};

/// The decimal multiple of an SI unit that suits values up to `magnitude`: 1.06e6 "N" becomes 1060 "kN", 6e-4 "m"
/// becomes 600 "µm".  Units without prefixes (rad, Hz, 1/min, ...) are unchanged.
DisplayUnit display_unit(const std::string &si_unit, double magnitude);

} // namespace gestell
