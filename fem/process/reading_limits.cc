#include "fem/process/reading_limits.h"

#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

constexpr double megabyte = 1e6, least_memory = 5e8; // [byte]: the kernel judges better when there is little

double size_of(const std::string &path)
{
  std::error_code error;
  const auto      size = std::filesystem::file_size(path, error);
  return error ? 0. : static_cast<double>(size);
}

double chosen_seconds(const char *text)
{
  char        *end   = nullptr;
  const double value = std::strtod(text, &end);
  if (end == text || *end != '\0' || !(value >= 0.) || !std::isfinite(value))
    throw std::invalid_argument(std::string("GESTELL_READING_SECONDS: \"") + text +
                                "\" is not a number of seconds; give a number such as 3600, or 0 for no limit.");
  return value;
}

} // namespace

ReadingLimits reading_limits(const std::string &path, FileContent content, double available)
{
  const bool    program = content == FileContent::program;
  const double  size    = size_of(path);
  ReadingLimits limits;
  limits.seconds = std::max(program ? 1200. : 0., 300. + 60. * size / megabyte);
  limits.bytes   = std::max(least_memory, program ? available : std::min(available, 2e9 + 400. * size));
  if (const char *chosen = std::getenv("GESTELL_READING_SECONDS"))
    limits.seconds = chosen_seconds(chosen);
  if (!std::isfinite(limits.bytes))
    limits.bytes = 0.;
  return limits;
}

std::string size_text(const std::string &path)
{
  return text(std::max(0.001, std::round(1e3 * size_of(path) / megabyte) / 1e3)) + " MB";
}

} // namespace gestell::fem
