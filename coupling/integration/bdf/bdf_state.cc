#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/bdf/bdf_controlled.h"
#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

void Bdf::Point::exchange(StateArchive &archive)
{
  archive(t, q, v, w, u, u_rate, a, p, lambda);
}

/// Data that follow from the newest point are not stored, but computed again on request.
void Bdf::exchange(StateArchive &archive)
{
  bool is_consistent = consistent_ != nullptr;
  archive(is_consistent);
  if (is_consistent && has_consistent())
    consistent_->exchange(archive);
  archive(implicit_, t_begin_, index_, points_, newest_, n_past_, cut_point_, cut_, local_, base_, work_);
  now_known_  = false;
  load_known_ = false;
}

void BdfControlled::exchange(StateArchive &archive)
{
  bool is_consistent = consistent_ != nullptr;
  archive(is_consistent);
  if (is_consistent && has_consistent())
    consistent_->exchange(archive);
  archive(scale_, implicit_, differences_, order_, rung_, wanted_order_, wanted_rung_, since_change_, barred_, fresh_,
          started_, solves_inside_, lambda_size_, cut_, anchor_, steps_, t_begin_, t_end_);
  archive(z_begin_, z_cut_, z_, predicted_, difference_, history_, chain_, middle_, end_);
  archive(dp_du_, dp_dv_, stiffness_, moved_, reason_, reason_id_, reason_place_, local_, base_, f_t_, load_known_,
          work_);
  now_known_ = false;
}

} // namespace gestell::coupling
