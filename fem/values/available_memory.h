#pragma once

#include <string>

namespace gestell::fem
{

/// Memory [byte] this process may still take: what the system has available, or its container or its own limit
/// (ulimit -v) allows; infinite where none tells.
double available_memory();

/// "1.2 GiB"
std::string memory_text(double bytes);

/// Judges a size before memory is taken for it.
/// @param what    needs it, such as "--points 1000000000: their rows"
/// @param advice  what would do, such as "Ask for fewer points."
/// @throws std::invalid_argument if more memory is needed than there is: what, how much, what there is, and the advice.
void require_available(const std::string &what, double bytes, const std::string &advice);

} // namespace gestell::fem
