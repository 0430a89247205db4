#include "apps/output/text/write_file.h"

#include "coupling/frame/atomic_file.h"

namespace gestell::apps
{
namespace fs = std::filesystem;

void write_file(const fs::path &path, const std::string &content)
{
  if (path.has_parent_path())
    fs::create_directories(path.parent_path());
  coupling::AtomicFile file(path.string());
  file.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  file.finish();
}

} // namespace gestell::apps
