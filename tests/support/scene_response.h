#pragma once

#include "apps/analysis/frf/response_search.h"
#include "apps/session/session.h"

#include <string>
#include <vector>

namespace gestell::tests
{

struct SceneResponse
{
  apps::Result            result;
  apps::FrequencyResponse response;
};

/// Frequency responses of a scene, as `gestell frf` finds them.
inline SceneResponse scene_response(const std::string &path, const apps::FrfOptions &options,
                                    const std::vector<std::string> &overrides = {})
{
  apps::check_frf_options(options);
  apps::Session session(path, overrides);
  SceneResponse found;
  found.result = session.answered("frf",
                                  [&](apps::Result &result)
                                  {
                                    found.response =
                                        apps::frequency_response_of(session.scene(), session.machine(), options,
                                                                    session.progress(), result.warnings);
                                  });
  return found;
}

} // namespace gestell::tests
