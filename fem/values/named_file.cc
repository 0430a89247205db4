#include "fem/values/named_file.h"

#include <stdexcept>
#include <system_error>

namespace gestell::fem
{
namespace fs = std::filesystem;

std::string unreachable(const fs::path &name)
{
  std::error_code       error;
  const fs::file_status status = fs::status(name, error);
  return fs::status_known(status) ? std::string() : error.message();
}

bool is_there(const fs::path &name)
{
  if (const std::string reason = unreachable(name); !reason.empty())
    throw std::invalid_argument(name.string() + ": cannot be reached (" + reason +
                                "); give another name, or see to it");
  std::error_code none;
  return fs::exists(name, none);
}

} // namespace gestell::fem
