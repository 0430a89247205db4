#pragma once

#include "apps/scene/file/declaration.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Keys of [frame] given by matrices; of its file_units; of its [frame.interface.NAME]; rows of an output.
const std::vector<Key> &matrix_frame_keys();
const std::vector<Key> &file_unit_keys();
const std::vector<Key> &matrix_interface_keys();
const std::vector<Key> &matrix_output_keys();

/// Outputs "cut", "support" or "stress" of a frame given by matrices: rows of their own, or tables of components, their
/// names with units.
struct OutputFamily
{
  std::string                                      name;
  std::vector<std::pair<std::string, std::string>> components;
  std::vector<Key>                                 keys;
};
const std::vector<OutputFamily> &output_families();

} // namespace gestell::apps
