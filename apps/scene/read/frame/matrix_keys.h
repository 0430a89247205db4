#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// Keys of [frame] given by matrices; of its file_units; of its [frame.interface.NAME]; of cuts; of supports, which may
/// have one table for each direction.
const std::vector<Key> &matrix_frame_keys();
const std::vector<Key> &file_unit_keys();
const std::vector<Key> &matrix_interface_keys();
const std::vector<Key> &matrix_output_keys();
const std::vector<Key> &matrix_support_keys();

} // namespace gestell::apps
