#pragma once

#include "apps/output/values/result.h"
#include "coupling/plugin/mesh_report.h"

namespace gestell::apps
{

/// A made-up machine with all that can be written: a frame with a skin (a box that shears and lifts), crank, rod and
/// slide, n rows of history with one shock, events, modes.
Result example_result(int n_rows = 1000);

/// The same with stresses at 0.2341 s: corner i of the box is pulled along z by 10 (i + 1) MPa; point 0 is told as
/// beside the feet, with neighbours that disagree by a fifth.
Result with_stress(Result result);

/// A plate of n x n faces, each of m x m squares; the fourth has a name that ends a script.
coupling::MeshReport chequered(int n, int m);

} // namespace gestell::apps
