#pragma once

#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

namespace gestell::coupling
{

/// What a run keeps in memory [bytes].
struct KeptBytes
{
  double history, pictures, states;
};
KeptBytes kept_bytes(const Machine &machine, const RunOptions &options, std::size_t n_signals);

/// A run keeps its history, pictures and states in memory.
/// @throws std::invalid_argument if they are larger than 1 GB, or the pictures more than 20 000, and options.allow_large
///         does not ask for it
void require_size(const Machine &machine, const RunOptions &options, std::size_t n_signals);

} // namespace gestell::coupling
