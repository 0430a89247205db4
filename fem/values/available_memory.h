#pragma once

#include <string>

namespace gestell::fem
{

/// Memory [byte] that this process can still allocate: the available memory of the system, limited by its container and
/// by its own limit (ulimit -v); infinite if none of them is known.
double available_memory();

/// "1.2 GiB"
std::string memory_text(double bytes);

/// Checks the memory for a result before it is allocated.
/// @param what    subject of the message, such as "--points 1000000000: their rows"
/// @param advice  remedy, such as "Ask for fewer points."
/// @throws std::invalid_argument if more memory is needed than is available: subject, need, available memory, and the
///   advice.
void require_available(const std::string &what, double bytes, const std::string &advice);

} // namespace gestell::fem
