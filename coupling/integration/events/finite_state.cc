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
  if (state.u.allFinite() && state.v.allFinite())
    if (const LawWithoutValue none = law_without_value(system, state); !none.element.empty())
      return none.words;
  std::ostringstream message;
  message << "there is no finite number at t = " << state.t << " s for ";
  for (const auto &[values, what] :
       {std::pair(&state.u, "the motion of "), {&state.v, "the rate of "}, {&state.p, "the force on "}})
    for (Eigen::Index i = 0; i < values->size(); ++i)
      if (!std::isfinite((*values)[i]))
      {
        const Eigen::SparseMatrix<double>::InnerIterator acts(system.forces().directions(), i);
        message << what << (acts ? system.linear().coordinate_name(int(acts.row())) : "a measure")
                << "; a formula or law gives none there, or the motion grew beyond all numbers";
        return message.str();
      }
  message << "the forces of joints; the motion grew beyond all numbers";
  return message.str();
}

void make_step(TimeIntegrator &integrator, const SecondOrderSystem &system)
{
  integrator.advance();
  if (is_finite(integrator.local()))
    return;
  const std::string words = non_finite_state_message(system, integrator.local());
  integrator.cut(integrator.step_begin());
  throw ConvergenceFailure(words);
}

} // namespace gestell::coupling
