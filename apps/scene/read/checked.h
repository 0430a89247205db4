#pragma once

#include "apps/scene/file/scene_table.h"

namespace gestell::apps
{

/// Runs `make`, and adds the location of the table to its errors about parameters.
template <typename Make>
auto checked(const SceneTable &table, Make make)
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error(e.what());
  }
}

} // namespace gestell::apps
