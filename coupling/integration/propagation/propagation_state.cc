#include "coupling/integration/propagation/modal_propagation.h"
#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

/// Tables are not stored: they follow from the step lengths.
void ModalPropagation::exchange(StateArchive &archive)
{
  std::vector<int> rungs;
  for (const auto &[rung, table] : tables_)
    rungs.push_back(rung);
  double partial = partial_.h;
  archive(rungs, partial);
  std::vector<const StepTable *> tables;
  const auto                     fill = [&](StepTable &table, double h)
  {
    if (table.h != h)
      table.fill(context_.measures, force_->basis(), h);
    tables.push_back(&table);
  };
  for (const int rung : rungs)
    fill(tables_[rung], spacing(rung));
  fill(partial_, partial);
  force_->exchange(archive, tables);
  archive(context_, t_origin_, t_begin_, t_full_, tick_, on_grid_, cut_, stepped_, rung_, last_error_, target_, local_,
          local_begin_, x_);
  forget_inside();
}

} // namespace gestell::coupling
