#pragma once

#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// Adds warnings of numbers that a scene may have but machines hardly do, as a unit that was forgotten or mistaken
/// makes them: masses, radii of gyration, places, angles of the start, gravity that acts upwards.
void warn_of_implausible_numbers(Scene &scene);

} // namespace gestell::apps
