#pragma once

#include "apps/sizing/model_variant.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Elements that a model could omit, and elements that are missing, as text.
struct Omissions
{
  std::vector<std::string> left_out, missing;
  std::vector<std::string> unasked; ///< tests that were too expensive
};

/// The model to be tested.
struct QuestionedModel
{
  const Scene                   &scene;
  const ModelAnswer             &answer; ///< of the model itself
  const std::vector<OutputName> &outputs;
  std::vector<double>            scales; ///< sizes of the outputs, for relative changes
  double                         tolerance = 0.;
  /// A coarser mesh of the same model with its answer, for changes of the frame, which need no fine mesh.
  const Scene       &coarse;
  const ModelAnswer &coarse_answer;
  /// Whether a test may take this CPU time [s]; none: always.
  std::function<bool(double)> affords{};
};

/**
 * Runs the model without gravity, without each element, without friction of each joint, with each spring and the whole
 * frame rigid (1e4 times as stiff).  Lists the parts that change no output by half of the allowed error, and branches
 * of elements that no event has reached.  It also averages each rigid interface instead, and lists those whose wall is
 * too soft for a rigid interface (changes above the allowed error), and loads with frequencies near the highest
 * retained mode of the frame.
 *
 * A part is needed if the model fails without it.  Tests that were too expensive are listed.
 */
Omissions find_omissions(const QuestionedModel &model, const std::atomic<bool> *stop = nullptr);

} // namespace gestell::apps
