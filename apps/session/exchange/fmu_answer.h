#pragma once

#include "apps/output/values/fmu_description.h"
#include "apps/session/session.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Contents of an FMU besides the library: its description, and its files by their names in the archive.
struct FmuAnswer
{
  FmuDescription                     fmu;
  std::map<std::string, std::string> files; ///< "resources/scene.toml": bytes
  std::vector<std::string>           notes; ///< for people
};

/**
 * The scene with its frame, reduced if that is possible, as the resources of an FMU.  The machine is initialised once
 * from them as a test.
 *
 * @throws std::invalid_argument for parts that an FMU does not support, with the remedy; ConvergenceFailure if the
 *   initialisation fails
 */
FmuAnswer fmu_of(Session &session);

} // namespace gestell::apps
