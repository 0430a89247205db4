#pragma once

// Scenes whose periodic motions are looked for.

#include "apps/analysis/periodic/periodic_motions.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"

#include <cmath>
#include <string>
#include <vector>

namespace gestell::tests
{

using apps::PeriodicEntry;
using apps::PeriodicRequest;
using apps::PeriodicResult;
using apps::Session;

inline const std::string press_minimal = std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/press_minimal.toml";

inline PeriodicResult periodic_of(Session &&session, const PeriodicRequest &request = {})
{
  apps::Result run;
  begin_branches(session, request);
  return periodic_motions(session, request, run);
}

inline PeriodicResult periodic_of(const std::string &text, const PeriodicRequest &request = {},
                                  const std::vector<std::string> &overrides = {})
{
  const test::SceneFolder folder;
  const std::string       path = folder.write("scene.toml", text);
  return periodic_of(Session(path, overrides), request);
}

/// A load F cos(Omega t) on a marker along x.
inline std::string cosine_load(const std::string &marker, double F, double Omega, double constant = 0.)
{
  return element("load", "force",
                 {{"from", marker},
                  {"to", "ground"},
                  {"direction", "[1, 0, 0]"},
                  {"constant", number(constant)},
                  {"harmonics", "[{ amplitude = '" + number(F) + " N', frequency = '" + number(Omega / (2. * M_PI)) +
                                    " Hz', phase = '90 deg' }]"}});
}

inline const std::string output_x = "[output.signals]\nx = 'slide.displacement'\n";

inline std::string duffing(double zeta, double beta, double F, double Omega)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1"}, {"damping", number(2. * zeta)}}) +
         element("cubic", "cubic spring", {{"from", "slide"}, {"cubic", number(beta)}}) +
         cosine_load("slide", F, Omega) + test::quoted(output_x);
}

} // namespace gestell::tests
