#pragma once

#include "apps/output/values/fmu_description.h"
#include "apps/session/session.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// What an FMU consists of, beside the library: its description, and its files by their names in the archive.
struct FmuAnswer
{
  FmuDescription                     fmu;
  std::map<std::string, std::string> files; ///< "resources/scene.toml": bytes
  std::vector<std::string>           notes; ///< what people should know of it
};

/**
 * The scene with its frame, reduced if it has one that is reduced, as the resources of an FMU.  The machine is started
 * once from them, to see whether it does.
 *
 * @throws std::invalid_argument for what an FMU cannot carry, with the way out; ConvergenceFailure if it does not start
 */
FmuAnswer fmu_of(Session &session);

} // namespace gestell::apps
