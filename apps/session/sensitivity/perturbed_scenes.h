#pragma once

#include "apps/scene/variant.h"
#include "apps/session/reduced_frame_store.h"
#include "apps/session/sensitivity/sensitivity_keys.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Scenes a little below and above the value of every key, and what is differentiated of them.
struct PerturbedScenes
{
  std::vector<PreparedScene>            scenes; ///< of key k: 2k below, 2k + 1 above
  std::vector<coupling::ParameterTwins> twins;
  std::vector<std::string>              warnings;
};

/// The frame of all is that of `prepared`; with entries on which it depends it is moved by its derivative, a quotient
/// of two reductions.
/// @param keys      without those that are left out; those of the frame are told how its derivative was found
/// @param left_out  gets a sentence for each key that has no derivative, and is left out; null: it is refused
/// @param progress  of reductions
/// @throws std::invalid_argument where a scene is refused at such a value, or its machine is of another structure
PerturbedScenes perturbed_scenes(const Variant &file, const Scene &scene, PreparedMachine &prepared,
                                 std::vector<VariedKey> &keys, std::vector<std::string> *left_out,
                                 const coupling::Progress &progress);

} // namespace gestell::apps
