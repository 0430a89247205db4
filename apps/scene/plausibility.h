#pragma once

#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Warnings of numbers that a scene may have but machines hardly do, as a unit that was forgotten or mistaken makes
/// them: masses, radii of gyration, places, angles of the start, gravity that acts upwards.
std::vector<std::string> implausible_numbers(const Scene &scene);

} // namespace gestell::apps
