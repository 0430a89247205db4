#pragma once

#include "apps/output/values/error_budget.h"
#include "apps/sizing/model_variant.h"

namespace gestell::apps
{

/// The outputs of a list, see outputs_named().
/// @throws std::invalid_argument if one does not exist, or the scene starts on a periodic motion
std::vector<OutputName> budget_outputs(const Scene &scene, const std::string &list);

/**
 * Errors of the outputs of a run, each part by two models that differ in it alone.  v_0 is the run, and each comparison
 * begins with the finer model of the one before, so that the sum of all is at least the difference to the finest:
 *
 *     time       |v_0 - v_1|, v_1 integrated by `exact` of order 8 to 1e-10, as all others then
 *     mesh       |v_1 - v_2| + 1.25 |v_2 - v_3|, v_2 on the same cells with sides that follow the geometry, v_3 on
 * these in elements of degree three; of a frame with more than 60 000 coordinates v_2 - v_3 of the finest with cells of
 * 3/2, 9/4, 27/8 of the size that has no more, over r^(3/2), r^3 the ratio of the numbers of coordinates: order 3/2 in
 * h is between 1 of a sharp corner and 4 of smooth fields.  Where degree three does not tell an output,
 * |v_2(h) - v_2(3/2 h)|/(r^(3/2) - 1).  v_2 = v_1 where sides follow the geometry already, or faces are planes
 *     reduction  |v_3(m) - v_3(2 m)|, m modes, eight more at least
 *
 * Where `exact` does not treat the machine the time comes last, |v_3 - v_4| with half the step (a sixteenth of the
 * tolerance), times 2^p/(2^p - 1) (16/15).
 *
 * Where two models differ in the order of their events up to the instant that decides an output, their difference says
 * nothing of its error: no number is given then, but the range of the values of all models.
 *
 * @param run  the scene's own answer.
 * @throws coupling::ConvergenceFailure if it is interrupted
 *
 * Source: docs/theory/mesh_error.md (4a, 4b); Roache, J. Fluids Eng. 116, 1994, 405-413 (two meshes); docs/size.md.
 */
ErrorBudget error_budget(const Scene &scene, const std::vector<OutputName> &outputs, const ModelAnswer &run,
                         const std::atomic<bool> *stop = nullptr);

/// A model with its budget.
struct JudgedModel
{
  ErrorBudget budget;
  ModelAnswer run;
  ModelAnswer finest; ///< of the last model of the comparisons
  std::string what;   ///< that is, for people
};

/// The same of one of the models of a scene.
JudgedModel judged(ModelAnswers &models, const ModelVariant &model);

} // namespace gestell::apps
