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
             : "cannot be reached (" + error.message() + "); give another name, or see to it";
}

bool names_something(const fs::path &name)
{
  if (const std::string reason = why_unreachable(name); !reason.empty())
    throw std::invalid_argument(name.string() + ": " + reason);
  std::error_code none;
  return fs::exists(name, none);
}

} // namespace gestell::fem
