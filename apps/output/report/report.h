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
 * One self-contained page without external references: warnings, the machine, the peaks with their times, histories of
 * forces and motion, events, the energy balance as a measure of the error, modes, model and work.  Sections without
 * data are omitted.
 */
Report make_report(const Result &result);

} // namespace gestell::apps
