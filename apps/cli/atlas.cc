#include "apps/cli/atlas.h"

#include "apps/atlas/atlas.h"
#include "apps/cli/command.h"
#include "apps/cli/progress.h"
#include "apps/output/result_folder.h"
#include "apps/output/text/write_file.h"

#include <cmath>
#include <iostream>

namespace gestell::apps
{

int write_atlas(const std::filesystem::path &file, bool quiet)
{
  const std::filesystem::path beside  = file.parent_path().empty() ? "." : file.parent_path();
  const std::filesystem::path figures = beside / file.stem();
  require_writable(beside);
  ProgressLine progress(quiet);
  progress.show("failure atlas");
  const std::vector<AtlasEntry> entries = failure_atlas();
  progress.done();

  std::filesystem::create_directories(figures);
  int failed = 0;
  for (const AtlasEntry &entry : entries)
  {
    for (const NamedSvg &figure : entry.figures)
      write_file(figures / (figure.name + ".svg"), figure.svg);
    for (const AtlasComparison &c : entry.comparisons)
      if (!(std::abs(c.measured - c.predicted) <= c.tolerance))
      {
        ++failed;
        std::cout << entry.title << ": " << c.what << ": predicted " << c.predicted << ", measured " << c.measured
                  << '\n';
      }
  }
  write_file(file, atlas_markdown(entries, file.stem().string()));
  std::cout << entries.size() << " places where methods fail: " << file.string() << '\n';
  return failed == 0 ? exit_done : exit_failed;
}

} // namespace gestell::apps
