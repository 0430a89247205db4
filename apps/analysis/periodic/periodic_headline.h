#pragma once

#include "apps/output/text/html.h"
#include "apps/output/values/periodic_result.h"

namespace gestell::apps
{

/// The motions with their stability; where they are stable, and the largest values of some signals, over the range of
/// the parameter if there is one.
Headline headline_of(const PeriodicResult &result);

} // namespace gestell::apps
