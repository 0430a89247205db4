#pragma once

#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// How the frame of a scene is damped, for people; empty if there is no frame.
std::string damping_text(const FrameRequest &frame);

} // namespace gestell::apps
