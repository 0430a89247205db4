#pragma once

#include "apps/output/values/error_budget.h"
#include "apps/sizing/model_variant.h"

namespace gestell::apps
{

/// The outputs of a list, see outputs_named().
/// @throws std::invalid_argument if one does not exist, or the scene starts on a periodic motion
std::vector<OutputName> budget_outputs(const Scene &scene, const std::string &list);

/**
 * Errors of the outputs of a run.  Each part follows from two models that differ only in it.  v_0 is the run, and each
 * comparison starts with the finer model of the previous one, so that the sum is at least the difference to the finest
 * model:
 *
 *     time       |v_0 - v_1|, v_1 integrated by `exact` of order 8 to 1e-10, as all others then
 *     mesh       |v_1 - v_2| + 1.25 |v_2 - v_3|, v_2 on the same mesh with sides that follow the geometry, v_3 on
 *                that mesh with elements of degree three
 *     reduction  |v_3(m) - v_3(2 m)|, m modes, at least eight more in the second model
 *
 * Exceptions of the mesh error: v_2 = v_1 if the sides follow the geometry already, or all faces are planes.  If the
 * frame has more than 60 000 DOFs, v_2 - v_3 is computed on the finest of three meshes with 3/2, 9/4, 27/8 of the
 * element size that has no more DOFs than that, and divided by r^(3/2), where r^3 is the ratio of the numbers of DOFs:
 * the order 3/2 in h is between 1 (sharp corner) and 4 (smooth fields).  If elements of degree three do not give an
 * output, |v_2(h) - v_2(3/2 h)|/(r^(3/2) - 1) is used.
 *
 * If `exact` cannot treat the machine, the time error is computed last: |v_3 - v_4| with half the step (a sixteenth of
 * the tolerance), times 2^p/(2^p - 1) (16/15).
 *
 * If two models differ in the order of their events before the instant that determines an output, their difference is
 * no error estimate; the result is then only the range of the values of all models.
 *
 * @param run  the answer of the scene itself.
 * @throws coupling::ConvergenceFailure if it is interrupted
 *
 * Source: docs/theory/mesh_error.md (4a, 4b); Roache, J. Fluids Eng. 116, 1994, 405-413 (two meshes);
 * docs/how_to/error_and_model_size.md.
 */
ErrorBudget error_budget(const Scene &scene, const std::vector<OutputName> &outputs, const ModelAnswer &run,
                         const std::atomic<bool> *stop = nullptr);

/// A model with its budget.
struct JudgedModel
{
  ErrorBudget budget;
  ModelAnswer run;
  ModelAnswer finest; ///< of the finest model of the comparisons
  std::string what;   ///< description of the finest model, for people
};

/// The same for one of the models of a scene.
JudgedModel judged(ModelAnswers &models, const ModelVariant &model);

} // namespace gestell::apps
