#include "coupling/integration/step/law_values.h"

#include <sstream>

namespace gestell::coupling
{

LawWithoutValue law_without_value(const SecondOrderSystem &system, const LocalState &state)
{
  const auto     &forces = system.forces();
  const auto      blocks = forces.blocks();
  Eigen::VectorXd p      = state.p, tangent(tangent_size(blocks));
  tangent.setZero();
  forces.tangent_blocks(state, 1., 1., 0., p, tangent);
  Eigen::Index first = 0;
  for (const ForceBlock &block : blocks)
  {
    const int  n      = block.n_measures;
    const bool value  = p.segment(block.first_measure, n).allFinite();
    const bool slopes = tangent.segment(first, n * n).allFinite();
    first += n * n;
    if (value && slopes)
      continue;
    std::ostringstream words;
    words << "the force law of \"" << forces.element_of(block.first_measure) << "\" has "
          << (value ? "an infinite slope" : "no finite value") << " at t = " << state.t;
    for (int j = 0; j < n; ++j)
      words << ", u = " << state.u[block.first_measure + j] << ", u' = " << state.v[block.first_measure + j];
    words << " (SI units); keep its arguments within the range of the law (if or max in a formula), or end the run "
             "before";
    return {forces.element_of(block.first_measure), words.str()};
  }
  return {};
}

LawWithoutValue law_at_fault(const SecondOrderSystem &system, const LocalState &state)
{
  if (!(state.u.lpNorm<Eigen::Infinity>() < beyond_machines && state.v.lpNorm<Eigen::Infinity>() < beyond_machines))
    return {};
  return law_without_value(system, state);
}

void require_law_values(const SecondOrderSystem &system, const LocalState &state)
{
  if (const LawWithoutValue law = law_at_fault(system, state); !law.words.empty())
    throw ConvergenceFailure(law.words, without_value, law.element);
}

} // namespace gestell::coupling
