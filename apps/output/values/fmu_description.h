#pragma once

#include <array>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A scalar of a machine that other programs set or read, in SI units.
struct FmuVariable
{
  std::string        name, unit; ///< unit empty: a plain number, or one of unknown dimension
  double             start = 0.; ///< unused for outputs
  std::array<int, 4> base{};     ///< exponents of kg, m, s, rad of the unit
};

/// Value references count parameters, then inputs, then outputs, from 0.
struct FmuInterface
{
  std::vector<FmuVariable> parameters, inputs, outputs;

  std::size_t size() const { return parameters.size() + inputs.size() + outputs.size(); }
};

/// The content of modelDescription.xml.
struct FmuDescription
{
  std::string  name, description, identifier, guid, version;
  FmuInterface variables;
  double       begin = 0., end = 0.; ///< [s] of the scene's run
  double       step = 0.;            ///< [s] of communication, as a proposal
};

} // namespace gestell::apps
