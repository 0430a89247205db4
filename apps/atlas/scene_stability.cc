#include "apps/atlas/scene_stability.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

MethodVerdict verdict(const coupling::LinearSpectrum &spectrum, const MappedMethod &method, double step)
{
  coupling::MethodOptions options = method.options;
  options.step                    = step;
  const coupling::StabilityGuard guard(spectrum, options);
  const auto                    &modes = guard.modes();
  MethodVerdict                  result;
  result.method = options.method == "exact" ? "exact, " + method.name : method.name;
  for (const auto &mode : modes)
    if (mode.unstable)
    {
      ++result.growing;
      if (mode.spectral_radius > result.growth)
      {
        result.growth   = mode.spectral_radius;
        result.worst_hz = mode.mode.omega / (2. * M_PI);
      }
    }
  result.only_closed = result.growing > 0 && options.method == "exact";
  if (result.growing > 0)
    result.step_that_works = guard.largest_stable_step();
  const auto closed = std::find_if(modes.begin(), modes.end(),
                                   [](const auto &mode) { return mode.origin == coupling::ModeOrigin::closed; });
  if (closed != modes.begin())
  {
    result.lowest_period_error  = modes.front().period_error;
    result.highest_period_error = std::prev(closed)->period_error;
  }
  return result;
}

} // namespace

void lay_methods_over(const Scene &scene, PreparedMachine &prepared, double step,
                      const std::vector<MethodFamily> &families, StabilityStudy &study)
{
  RunRequest run = scene.run;
  keep_stable_step(prepared, run);
  const bool                   in_modes = prepared.in_modes != nullptr;
  const coupling::Machine     &machine  = in_modes ? prepared.machine : prepared.small();
  const coupling::InitialState start =
      in_modes ? prepare_start(scene, prepared) : initial_state(scene, prepared.small());
  coupling::MethodOptions method = run.options.method;
  if (step > 0.)
    method.step = step;
  if (!(method.step > 0.))
    throw std::invalid_argument("stability: the scene has no fixed step; give one, such as --step 1e-4");
  if (method.tolerance > 0.)
    study.notes.push_back("The scene has step control; its modes are shown for a fixed step of " +
                          short_text(method.step) + " s.");
  method.tolerance = 0.;
  if (prepared.companion && !in_modes)
    study.notes.push_back("The frame is unreduced; the modes are those of the reduced frame.");

  std::ostringstream name;
  name << coupling::method_name(method) << " with a step of " << method.step << " s";
  study.method                            = name.str();
  const coupling::LinearSpectrum spectrum = coupling::linear_spectrum(machine, start);
  const coupling::StabilityGuard guard(spectrum, method);
  study.modes = guard.modes();
  for (const MethodFamily &family : families)
    for (const MappedMethod &other : family.methods)
      study.verdicts.push_back(verdict(spectrum, other, method.step));
  try
  {
    guard.check();
  }
  catch (const std::invalid_argument &unstable)
  {
    study.notes.push_back(unstable.what());
  }
  for (const std::string &warning : guard.warnings())
    study.notes.push_back(warning);
}

} // namespace gestell::apps
