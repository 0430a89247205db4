#pragma once

#include "apps/peers/peer.h"
#include "coupling/integration/integration_methods.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A method of the chart, run with several steps or tolerances.
struct ChartMethod
{
  std::string                       key;  ///< on the command line: "exact-6"
  std::string                       name; ///< in the chart: "exact, collocation 6"
  std::string                       family;
  bool                              controlled = false; ///< by a tolerance, else by a fixed step
  coupling::MethodOptions           own;
  std::optional<peers::PeerOptions> peer;               ///< set: a general-purpose library
  bool                              on_request = false; ///< shown only if requested by name
};

/// All methods; other solvers last, none if this build has no such library.
std::vector<ChartMethod> chart_methods();

enum class PeerChoice
{
  with,
  without
};

/// Methods selected by keys or by prefixes followed by '*' ("exact*"), in the order of chart_methods(); without names
/// those useful for a model of n coordinates.
/// @throws std::invalid_argument with a key that does not exist and the most similar one
std::vector<ChartMethod> choose_methods(const std::vector<std::string> &keys, PeerChoice peers, int n_coordinates);

/// Keys of the few methods of a quick chart: the best of Gestell and of the other solvers, and the most common ones.
std::vector<std::string> quick_methods(PeerChoice peers);

/// False for methods that can only skip events.
bool locates_events(const ChartMethod &method);

/// The keys of [run] that select this method with a step or a tolerance, one per line.
std::string scene_settings(const ChartMethod &method, double value, bool events);

} // namespace gestell::apps
