#include "apps/session/comparison/scene_comparison.h"

#include "apps/session/comparison/shared_measures.h"

namespace gestell::apps
{

namespace
{

MachineAt at_modes(Session &session)
{
  coupling::Machine &machine = session.machine().small();
  return {&machine, modes_configuration(session.scene(), machine)};
}

} // namespace

void add_compared_modes(Session &session, Result &result, Session &other, const Result &of_other)
{
  result.compared_shapes = compared_shapes(result, at_modes(session), of_other, at_modes(other));
}

} // namespace gestell::apps
