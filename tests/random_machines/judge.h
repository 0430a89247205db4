#pragma once

#include "tests/random_machines/random_machine.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::tests
{

/// An invariant that does not hold.
struct Finding
{
  std::string kind, way, what;
  double      value = 0., bound = 0.;
};

struct Verdict
{
  std::vector<Finding> findings;
  double               cpu_s     = 0.;
  bool                 sensitive = false; ///< the motion enlarges errors so much that histories were not compared
};

/// Computes the machine in all ways and judges their motions; files of the scene go to `folder`.
Verdict judge(const RandomMachine &machine, const std::filesystem::path &folder);

} // namespace gestell::tests
