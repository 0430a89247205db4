#pragma once

#include <cstddef>
#include <string>

namespace gestell
{

/// Appends the shortest decimal text that reads back as exactly x; "nan", "inf", "-inf" where there is none.
void append_exact(std::string &text, double x);

/// The same as a separate string.
std::string exact_text(double x);

/// x with few significant digits for a reader, without an exponent between 1e-3 and 1e6; "-0" is written "0".
std::string short_text(double x, int digits = 4);

/// A number as notes and messages print it.
std::string rounded(double value, int digits = 4);

/// "2.5 %" of a share of 0.025.
std::string percent(double share, int digits = 3);

/// "1 file", "2 files"; or "2 bodies" with an irregular plural.
std::string count_text(std::size_t n, const std::string &one, const std::string &many = "");

/// Characters of a text in UTF-8, not its bytes.
std::size_t n_letters(const std::string &text);

/// A unit as shown: value in SI times `factor` is the number in `unit`.
struct DisplayUnit
{
  double      factor = 1.;
  std::string unit;
};

/// The decimal multiple of an SI unit in which values up to `magnitude` read well: 1.06e6 "N" becomes 1060 "kN",
/// 6e-4 "m" becomes 600 "µm".  Units that take no prefix (rad, Hz, 1/min, ...) stay.
DisplayUnit display_unit(const std::string &si_unit, double magnitude);

} // namespace gestell
