#include "coupling/integration/step/condensed_matrix.h"
#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

void CondensedMatrix::exchange(StateArchive &archive, const Compliance *S)
{
  archive(kept_tangent_, kept_held_);
  if (!archive.reads())
    return;
  std::vector<HeldMeasure> held;
  for (const int measure : kept_held_)
    held.push_back({measure, 0.});
  const Eigen::VectorXd tangent = kept_tangent_;
  kept_S_                       = nullptr;
  joints_known_                 = false;
  if (S)
    factorise_forces(*S, tangent, held);
}

void ImplicitStep::exchange(StateArchive &archive)
{
  std::vector<StepForm> forms;
  for (const auto &[key, condensed] : cache_)
    forms.push_back(condensed.form);
  archive(forms);
  IntegrationWork done_before;
  for (const StepForm &form : forms)
    condensed(form, done_before);
  archive(u_begin_, scale_, first_correction_, good_predictions_, contraction_, form_time_, seen_, seen_size_,
          first_size_, levers_age_, unseen_);
  if (!matrix_)
    return;
  std::vector<StepForm> kept; // one or none
  for (const auto &[key, condensed] : cache_)
    if (matrix_->is_of(condensed.S))
      kept.push_back(condensed.form);
  archive(kept);
  matrix_->exchange(archive, kept.empty() ? nullptr : &condensed(kept.front(), done_before).S);
}

void ConsistentStart::exchange(StateArchive &archive)
{
  archive(linear_, tangent_, a_, step_is_near_);
  holding_.clear();
  if (!matrix_)
    return;
  bool kept = matrix_->is_of(D_);
  archive(kept);
  matrix_->exchange(archive, kept ? &D_ : nullptr);
}

} // namespace gestell::coupling
