#pragma once

#include <string>

namespace gestell::fem
{

/// Limits of reading a file.
struct ReadingLimits
{
  double seconds = 0.; ///< of processor time; 0: no limit
  double bytes   = 0.; ///< of memory in addition to that of the process; 0: no limit
};

/// How a file determines the work to read it.
enum class FileContent
{
  geometry, ///< proportional to its size
  program   ///< it draws, meshes, or names other files
};

/**
 * Limits from the size S of the file: 300 s + 60 s per MB of processor time and 2 GB + 400 S of memory; for programs at
 * least 1200 s and all available memory; never below 0.5 GB. A STEP file of 0.5 MB takes less than a second and 0.1 GB.
 *
 * The environment variable GESTELL_READING_SECONDS sets another time, 0 for no limit.
 *
 * @param available  memory [byte]
 * @throws std::invalid_argument if that variable is not a number.
 */
ReadingLimits reading_limits(const std::string &path, FileContent content, double available);

/// The size of a file as text: "0.5 MB"
std::string size_text(const std::string &path);

} // namespace gestell::fem
