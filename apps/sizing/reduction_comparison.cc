#include "apps/sizing/reduction_comparison.h"

#include "apps/session/prepared_machine.h"
#include "coupling/reduction/reductions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

/// Largest number of modes a frame can keep; where it is not known, any.
int most_modes(const Scene &scene)
{
  if (scene.frame.source != FrameSource::matrices)
    return 1 << 20;
  int interface = 0;
  for (const fem::Interface &one : scene.frame.matrices.interfaces)
    interface += int(std::count_if(one.coordinate.begin(), one.coordinate.end(), [](int i) { return i >= 0; }));
  return int(scene.frame.matrices.M.rows()) - interface;
}

/// Ascending, each once.
std::vector<int> modes_of(const ComparisonOptions &options, int most)
{
  std::vector<int> modes        = options.modes;
  constexpr int    most_unasked = 64; // modes: more than machines need at low frequencies
  for (int number = 2; options.modes.empty() && number <= std::min(most, most_unasked); number *= 2)
    modes.push_back(number);
  if (modes.empty())
    modes.push_back(most);
  std::sort(modes.begin(), modes.end());
  modes.erase(std::unique(modes.begin(), modes.end()), modes.end());
  return modes;
}

ReductionPoint point_of(const Scene &scene, const std::string &method, int modes,
                        const std::vector<OutputName> &outputs, const std::atomic<bool> *stop, ModelAnswer &answer)
{
  ModelVariant variant;
  variant.reduction = method;
  variant.modes     = modes;
  answer            = answer_of(scene, variant, outputs, stop);
  ReductionPoint point;
  point.method      = method;
  point.modes       = answer.whole ? 0 : std::max(0, answer.modes);
  point.coordinates = answer.whole ? answer.n_frame : answer.interface + point.modes;
  point.prepare_cpu = answer.prepare_cpu;
  point.run_cpu     = answer.run_cpu;
  point.values      = answer.values;
  return point;
}

void measure_error(const std::vector<OutputName> &outputs, const ModelAnswer &reference, double duration,
                   ReductionPoint &point)
{
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const bool   instant = outputs[i].kind.rfind("t_", 0) == 0;
    const double size    = instant ? duration : reference.sizes[i];
    const double error   = std::abs(point.values[i] - reference.values[i]) / (size > 0. ? size : 1.);
    if (error >= point.error)
    {
      point.error = error;
      point.worst = outputs[i].text;
    }
  }
}

} // namespace

ReductionComparison compare_reductions(const Scene &scene, const std::vector<OutputName> &outputs,
                                       const ComparisonOptions &options)
{
  if (frame_path(scene) != FramePath::reduce && !scene.reduction.superposition)
    throw std::invalid_argument(
        scene.file +
        ": --reductions compares reductions of a frame, but the frame of this scene is not reduced; add [reduction]");
  ReductionComparison comparison;
  comparison.outputs    = outputs;
  const int    most     = most_modes(scene);
  const auto   modes    = modes_of(options, most);
  const int    largest  = modes.back();
  const double duration = scene.run.options.end - scene.run.options.begin;
  if (largest > most)
    throw std::invalid_argument("--modes: " + std::to_string(largest) + " modes, but the frame has " +
                                std::to_string(most) + " internal DOFs; request no more modes");
  ModelAnswer   reference, answer;
  constexpr int finer  = 4; // times the largest number of modes, of the reference: its error is far smaller
  comparison.reference = options.full ? point_of(scene, "condensation", -1, outputs, options.stop, reference)
                                      : point_of(scene, "craig-bampton", std::min(most, finer * largest), outputs,
                                                 options.stop, reference);
  if (options.on_point)
    options.on_point(comparison.reference);
  for (const coupling::ReductionEntry &entry : coupling::Reductions::entries())
  {
    if (entry.makes == coupling::ReductionEntry::Makes::no_frame)
      continue;
    for (const int number : entry.takes("modes") ? modes : std::vector<int>{0})
    {
      ReductionPoint point;
      try
      {
        // the same number of coordinates as the others, interface included
        const bool in_modes = entry.makes == coupling::ReductionEntry::Makes::modes_of_machine;
        const int  kept     = in_modes ? number + reference.interface : number;
        point               = point_of(scene, entry.name, kept, outputs, options.stop, answer);
        measure_error(outputs, reference, duration, point);
      }
      catch (const std::exception &failure)
      {
        if (options.stop && *options.stop)
          return comparison;
        point.method     = entry.name;
        point.modes      = number;
        point.failure    = failure.what();
        const auto &last = comparison.points.empty() ? comparison.reference : comparison.points.back();
        if (last.method == point.method && last.failure == point.failure)
          break; // whatever the number of modes
      }
      comparison.points.push_back(point);
      if (options.on_point)
        options.on_point(point);
    }
  }
  return comparison;
}

} // namespace gestell::apps
