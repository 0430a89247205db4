#pragma once

#include "apps/analysis/life/damage/coarse_load.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// A coarse history V(t) and its trace, of which errors are known.
struct SignedHistory
{
  Eigen::Ref<const Eigen::MatrixXd> V;                ///< [chosen x rows]
  Eigen::Ref<const Eigen::VectorXd> trace;            ///< [chosen]
  double                            error       = 0.; ///< of |V|
  double                            trace_error = 0.;
  Eigen::VectorXd                   trace_parts; ///< [n] of the components in it, absolute
};

/**
 * Turning points of |V| with the sign of the trace along the lines of a coarse load, docs/theory/life.md (9).  Where
 * the trace may be zero, both signs are visited.
 */
struct SignedPath
{
  std::vector<double> history;
  LoadSequence        load;
  std::vector<Cycle>  flips;          ///< closed cycles of signs that may change again and again
  double              variation = 0.; ///< what is above that of the history: of the length of V(t)
};

void signed_path(const SignedHistory &of, const CoarseLoad &load, SignedPath &path);

} // namespace gestell::apps
