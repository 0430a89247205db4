#pragma once

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/analysis/comparison/run_comparison.h"
#include "apps/output/text/csv.h"

namespace gestell::apps
{

/// `mode, frequency [Hz], other mode, other frequency [Hz], ratio, MAC, seen, other seen`: a row for each mode of the
/// scene, with empty cells if no mode matches; then those modes of the other scene that match none.
CsvTable compared_modes_csv(const ComparedShapes &shapes);

/// The whole MAC matrix: a row for each mode of the scene, a column for each of the other scene.
CsvTable mac_csv(const ComparedShapes &shapes);

/// `signal, unit, extreme, value, t [s], other value, other t [s], ratio`: two rows for each common signal of both
/// runs.
CsvTable compared_run_csv(const coupling::RunResult &run, const ComparedRun &other);

/// f_b / f_a; nan if the first mode does not vibrate.
double frequency_ratio(const ComparedShapes &shapes, const coupling::ModePair &pair);

} // namespace gestell::apps
