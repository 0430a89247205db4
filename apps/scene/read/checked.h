#pragma once

#include "apps/scene/file/scene_table.h"

namespace gestell::apps
{

/// Runs `make`, and heads what the element says against its parameters with the place of the table.
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
