#pragma once

#include "tests/random_machines/judge.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <unistd.h>

namespace gestell::tests
{

/// A line for each finding of the machine; empty if there is none.
inline std::string findings_of(std::uint64_t seed)
{
  const auto    folder  = std::filesystem::temp_directory_path() / ("random_machine_" + std::to_string(::getpid()));
  const Verdict verdict = judge(random_machine(seed), folder);
  std::filesystem::remove_all(folder);
  std::ostringstream text;
  for (const Finding &finding : verdict.findings)
    text << finding.kind << ", " << finding.way << ": " << finding.what << ", " << finding.value << " for "
         << finding.bound << '\n';
  return text.str();
}

} // namespace gestell::tests
