#pragma once

#include "coupling/reduction/team.h"
#include "fem/cell_sums.h"

namespace gestell::coupling
{

/// The ranks of this run, summing up the cells of frames; nullptr in a run of one process.
const fem::CellAssembly *team_assembly();

/// Number of the SharedMatrices that an assembly of this run has left on all ranks; 0 if there are none.
int number_of(const fem::RowsOnRanks *rows);

/// @throws std::invalid_argument if there are more ranks than `parts` of a frame.
void require_work_for_all(const Team &team, int parts, const char *called);

} // namespace gestell::coupling
