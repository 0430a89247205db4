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

constexpr int finer = 4; ///< times the largest number of modes, of the reference

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

ReductionPoint point_of(const Scene &scene, const std::string &method, int modes,
                        const std::vector<OutputName> &outputs, const std::atomic<bool> *stop, ModelAnswer &answer)
{
  ModelVariant variant;
  variant.reduction = method;
  variant.modes     = modes;
  answer            = answer_of(scene, variant, outputs, stop);
  ReductionPoint point;
  point.method      = method;
  point.modes       = std::max(0, answer.modes);
  point.coordinates = answer.interface + point.modes;
  point.from_cache  = answer.from_cache;
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
                                       const ComparisonOptions &asked)
{
  ComparisonOptions options = asked;
  if (frame_path(scene) != FramePath::reduce)
    throw std::invalid_argument(scene.file +
                                ": --reductions compares reductions of a frame, and this scene's frame is not reduced; "
                                "give it a [reduction]");
  ReductionComparison comparison;
  comparison.outputs = outputs;
  const int most     = most_modes(scene);
  std::sort(options.modes.begin(), options.modes.end());
  options.modes.erase(std::unique(options.modes.begin(), options.modes.end()), options.modes.end());
  if (options.usual)
    options.modes.erase(std::upper_bound(options.modes.begin(), options.modes.end(), most), options.modes.end());
  if (options.modes.empty())
    options.modes = {most};
  const int    largest  = options.modes.back();
  const double duration = scene.run.options.end - scene.run.options.begin;
  if (largest > most)
    throw std::invalid_argument("--modes: " + std::to_string(largest) + " modes, but the inside of the frame has " +
                                std::to_string(most) + " coordinates; name no more");
  ModelAnswer reference, answer;
  comparison.reference = options.full ? point_of(scene, "condensation", -1, outputs, options.stop, reference)
                                      : point_of(scene, "craig-bampton", std::min(most, finer * largest), outputs,
                                                 options.stop, reference);
  if (options.on_point)
    options.on_point(comparison.reference);
  for (const coupling::ReductionEntry &entry : coupling::Reductions::entries())
  {
    if (entry.makes == coupling::ReductionEntry::Makes::no_frame)
      continue;
    for (const int modes : entry.takes("modes") ? options.modes : std::vector<int>{0})
    {
      ReductionPoint point;
      try
      {
        point = point_of(scene, entry.name, modes, outputs, options.stop, answer);
        measure_error(outputs, reference, duration, point);
      }
      catch (const std::exception &failure)
      {
        if (options.stop && *options.stop)
          return comparison;
        point.method  = entry.name;
        point.modes   = modes;
        point.failure = failure.what();
      }
      comparison.points.push_back(point);
      if (options.on_point)
        options.on_point(point);
    }
  }
  return comparison;
}

} // namespace gestell::apps
