#pragma once

#include "apps/output/values/periodic_result.h"
#include "apps/session/periodic_request.h"
#include "apps/session/session.h"

namespace gestell::apps
{

/// Moves the session to the first value of the parameter along which branches are followed, if there is one.
/// @throws std::invalid_argument if its branches cannot be followed
void begin_branches(Session &session, const PeriodicRequest &request);

/// Periodic solutions of the session's machine, with their stability.
/// @param result  its run becomes a period of the first stable solution
PeriodicResult periodic_motions(Session &session, const PeriodicRequest &request, Result &result);

} // namespace gestell::apps
