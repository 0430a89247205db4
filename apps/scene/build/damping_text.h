#pragma once

#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// The damping of the scene's frame, for people; empty if there is no frame.
std::string damping_text(const FrameRequest &frame);

} // namespace gestell::apps
