#include "fem/values/named_file.h"

#include <stdexcept>
#include <system_error>

namespace gestell::fem
{
namespace fs = std::filesystem;

std::string why_unreachable(const fs::path &name)
{
  std::error_code error;
  return fs::status_known(fs::status(name, error))
             ? std::string()
             : "cannot be accessed (" + error.message() + "); use another path, or fix the cause";
}

std::string other_than_file(const fs::path &name)
{
  std::error_code none;
  switch (fs::status(name, none).type())
  {
  case fs::file_type::directory:
    return "a folder";
  case fs::file_type::block:
  case fs::file_type::character:
    return "a device";
  case fs::file_type::fifo:
  case fs::file_type::socket:
    return "a pipe";
  default:
    return "";
  }
}

bool names_something(const fs::path &name)
{
  if (const std::string reason = why_unreachable(name); !reason.empty())
    throw std::invalid_argument(name.string() + ": " + reason);
  std::error_code none;
  return fs::exists(name, none);
}

} // namespace gestell::fem
