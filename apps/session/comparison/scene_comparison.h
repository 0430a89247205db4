#pragma once

#include "apps/session/session.h"

namespace gestell::apps
{

/// Adds to the result of a session its modes beside those of another one, see compared_shapes().
void add_compared_modes(Session &session, Result &result, Session &other, const Result &of_other);

} // namespace gestell::apps
