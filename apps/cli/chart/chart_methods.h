#pragma once

#include "apps/peers/peer.h"
#include "coupling/integration/integration_methods.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A method of the chart, to be run with several steps or tolerances.
struct ChartMethod
{
  std::string                       key;  ///< on the command line: "exact-6"
  std::string                       name; ///< in the chart: "exact, collocation 6"
  std::string                       family;
  bool                              controlled = false; ///< by a tolerance, else by a fixed step
  coupling::MethodOptions           own;
  std::optional<peers::PeerOptions> peer;               ///< set: a general-purpose library
  bool                              on_request = false; ///< shown only when it is named
};

/// All of them; peers last, none if this build has no library to compare with.
std::vector<ChartMethod> chart_methods();

enum class PeerChoice
{
  with,
  without
};

/// Those named by keys or their beginnings followed by '*' ("exact*"), in the order of chart_methods(); no names: those
/// worth while for a model of n coordinates.
/// @throws std::invalid_argument naming a key that does not exist, with the nearest
std::vector<ChartMethod> choose_methods(const std::vector<std::string> &keys, PeerChoice peers, int n_coordinates);

/// Keys of the few methods of a quick chart: the best of ours and of the peers, and those most in use.
std::vector<std::string> quick_methods(PeerChoice peers);

/// False for those that can only pass over events.
bool locates_events(const ChartMethod &method);

/// The entries of [run] with which a scene runs that method, one per line, by step or by tolerance.
std::string scene_settings(const ChartMethod &method, double value, bool events);

} // namespace gestell::apps
