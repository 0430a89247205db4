#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The report and its pictures.
struct Report
{
  std::string html;
  Pictures    charts;
};

/**
 * One self-contained page without references to anything outside it: warnings, the machine, the answer (peaks with
 * their times), histories of forces and motion, events, the energy balance as a statement of the error, modes, model
 * and work.  What a result does not have is left out.
 */
Report make_report(const Result &result);

} // namespace gestell::apps
