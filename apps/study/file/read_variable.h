#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/study/file/study_file.h"

namespace gestell::apps
{

/// A number and the unit behind it; empty text of no number.
struct NumberWithUnit
{
  bool        is_number = false;
  double      value     = 0.;
  std::string unit{};
};
NumberWithUnit number_with_unit(const SceneNode &value);

/// [variables.NAME]
VariableRequest read_variable(const SceneNode &node, const SceneTable &table);

} // namespace gestell::apps
