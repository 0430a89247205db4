#pragma once

#include "apps/sizing/model_variant.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// What a model may do without, and what it lacks, in words.
struct Omissions
{
  std::vector<std::string> left_out, missing;
  std::vector<std::string> unasked; ///< questions that cost too much
};

/// The model that is questioned.
struct QuestionedModel
{
  const Scene                   &scene;
  const ModelAnswer             &answer; ///< its own
  const std::vector<OutputName> &outputs;
  std::vector<double>            scales; ///< against which changes of outputs count
  double                         tolerance = 0.;
  /// A coarser mesh of the same model with its answer, on which frames are changed: changes need no fine mesh.
  const Scene       &coarse;
  const ModelAnswer &coarse_answer;
  /// Whether a question may take so much time of the processor [s]; none: any.
  std::function<bool(double)> affords{};
};

/**
 * Runs the model without gravity, without each element, without friction of each joint, with each spring and the whole
 * frame rigid (1e4 times as stiff), and tells what changes no output by half of what is allowed; a branch of an element
 * that no event has touched, too.  With each rigid interface averaged instead it tells those whose wall is softer than
 * they are, by changes above what is allowed, and loads near the highest mode that the frame keeps.
 *
 * What fails without a part needs it.  Questions that may not take what they cost are named.
 */
Omissions find_omissions(const QuestionedModel &model, const std::atomic<bool> *stop = nullptr);

} // namespace gestell::apps
