#pragma once

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/session/prepared_machine.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// A machine with its configuration from [modes].
struct MachineAt
{
  const coupling::Machine *machine;
  Eigen::VectorXd          q;
};

/**
 * Compares modes of two scenes at the measures that both have with the same name and unit: coordinates of bodies, DOFs
 * of interfaces, [measure]; if there are none of these, the displacements of elements.  Modes above the frequency limit
 * of a reduced frame are omitted.
 *
 * @return none if no common measure moves
 */
std::optional<ComparedShapes> compared_shapes(const Result &a, const MachineAt &at_a, const Result &b,
                                              const MachineAt &at_b);

/// Error text: no common measures, with some DOFs of both.
std::string nothing_shared(const Result &a, const MachineAt &at_a, const Result &b, const MachineAt &at_b);

} // namespace gestell::apps
