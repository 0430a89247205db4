#pragma once

#include "apps/analysis/analyses.h"

namespace gestell::tests
{

/// A run with what analyses find of every run, as its report has it.
inline apps::Result complete_run(apps::Session &session)
{
  apps::Result result = session.run();
  apps::add_answers(apps::analyses_of("run"), session, result);
  return result;
}

} // namespace gestell::tests
