#include "apps/cli/atlas.h"

#include "apps/analysis/result_folder.h"
#include "apps/atlas/atlas.h"
#include "apps/cli/command.h"
#include "apps/cli/progress.h"
#include "apps/output/text/write_file.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Only an atlas is replaced, with the figures beside it.
void require_atlas(const std::filesystem::path &file, const std::filesystem::path &figures)
{
  std::ifstream in(file);
  std::string   heading;
  std::getline(in, heading);
  const bool there = std::filesystem::exists(std::filesystem::symlink_status(file));
  if (there ? heading != "# Failure atlas" : std::filesystem::exists(std::filesystem::symlink_status(figures)))
    throw std::invalid_argument(
        "--atlas: " + (there ? file : figures).string() +
        " is there already and is no failure atlas, so that it is not replaced; give another name");
}

} // namespace

int write_atlas(const std::filesystem::path &file, bool quiet)
{
  const std::filesystem::path nearby  = file.parent_path().empty() ? "." : file.parent_path();
  const std::filesystem::path figures = nearby / file.stem();
  require_writable(nearby);
  require_atlas(file, figures);
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
