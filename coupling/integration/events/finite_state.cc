#include "coupling/integration/events/finite_state.h"

#include "coupling/integration/step/law_values.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace gestell::coupling
{

bool is_finite(const LocalState &state)
{
  return std::isfinite(state.u.sum() + state.v.sum() + state.p.sum() + state.lambda.sum());
}

std::string non_finite_state_message(const SecondOrderSystem &system, const LocalState &state)
{
  const std::string  law = law_at_fault(system, state).words;
  std::ostringstream message;
  message << "no finite value at t = " << state.t << " s for ";
  for (const auto &[values, what] :
       {std::pair(&state.u, "the motion of "), {&state.v, "the rate of "}, {&state.p, "the force on "}})
    for (Eigen::Index i = 0; i < values->size(); ++i)
      if (!std::isfinite((*values)[i]))
      {
        const Eigen::SparseMatrix<double>::InnerIterator acts(system.forces().directions(), i);
        message << what << (acts ? system.linear().coordinate_name(int(acts.row())) : "a measure") << "; "
                << (law.empty() ? "the motion diverged" : law);
        return message.str();
      }
  message << "the forces of joints; the motion diverged";
  return message.str();
}

void make_step(TimeIntegrator &integrator, const SecondOrderSystem &system)
{
  integrator.advance();
  if (is_finite(integrator.local()))
    return;
  const LawWithoutValue law   = law_at_fault(system, integrator.local());
  const std::string     words = non_finite_state_message(system, integrator.local());
  integrator.cut(integrator.step_begin());
  throw ConvergenceFailure(words, law.words.empty() ? "" : without_value, law.element);
}

} // namespace gestell::coupling
