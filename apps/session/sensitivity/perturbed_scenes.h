#pragma once

#include "apps/scene/variant.h"
#include "apps/session/reduced_frame_store.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Scenes a little below and above the value of every key, for difference quotients.
struct PerturbedScenes
{
  std::vector<PreparedScene>            scenes; ///< of key k: 2k below, 2k + 1 above
  std::vector<coupling::ParameterTwins> twins;
  std::vector<std::string>              warnings;
};

/// All scenes use the frame of `prepared`; for a key that changes the frame, the derivative of the frame, a difference
/// quotient of two reductions, is added.
/// @param keys      omitted keys are removed; for keys of the frame the method of its derivative is noted
/// @param left_out  receives a sentence for each omitted key, which has no derivative; null: such a key is an error
/// @param progress  of reductions
/// @throws std::invalid_argument if a scene is invalid at such a value, or its machine has another structure
PerturbedScenes perturbed_scenes(const Variant &file, const Scene &scene, PreparedMachine &prepared,
                                 std::vector<VariedKey> &keys, std::vector<std::string> *left_out,
                                 const coupling::Progress &progress);

} // namespace gestell::apps
