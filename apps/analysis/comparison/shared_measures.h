#pragma once

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/session/prepared_machine.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// A machine in the configuration of [modes].
struct MachineAt
{
  const coupling::Machine *machine;
  Eigen::VectorXd          q;
};

/**
 * Modes of two scenes at the measures that both have under the same name and with the same unit: coordinates of
 * bodies, motions of interfaces, [measure]; where there are none of these the displacements of elements.  Modes above
 * the frequency up to which a reduced frame holds are left out.
 *
 * @return none if they share none that moves
 */
std::optional<ComparedShapes> compared_shapes(const Result &a, const MachineAt &at_a, const Result &b,
                                              const MachineAt &at_b);

/// That they share none, with some motions of both.
std::string nothing_shared(const Result &a, const MachineAt &at_a, const Result &b, const MachineAt &at_b);

} // namespace gestell::apps
