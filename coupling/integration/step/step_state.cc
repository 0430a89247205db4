#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

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
}

void ConsistentStart::exchange(StateArchive &archive)
{
  archive(linear_, tangent_, a_, shift_, step_is_near_);
  holding_.clear();
}

} // namespace gestell::coupling
