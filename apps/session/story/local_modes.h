#pragma once

#include "apps/output/values/result.h"
#include "apps/scene/scene.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/energy_shares.h"

#include <deque>
#include <string>
#include <vector>

namespace gestell::apps
{

/// All modes of the machine linearised where it stands at an instant of a run, undamped.
struct LocalModes
{
  double                      t = 0.; ///< [s]
  std::string                 place;  ///< of the first rotors and sliders: "crank 160.2 deg, slide 152 mm"
  std::vector<coupling::Mode> modes;
  std::vector<int>            numbers; ///< [modes] which one of Result::coupled_modes it is, from 0 on; -1: none
  coupling::EnergyShares      shares;
  std::string                 unknown; ///< why there are no modes; empty: there are

  std::string strain(std::size_t mode) const; ///< the part with most of its strain energy: "rod by 75 %"; may be empty
};

/**
 * The machine linearised at states of its run, each instant once.  A mode there is the one of Result::coupled_modes,
 * found where the scene says, whose shape it has,
 *
 *     (v^T M v_j)^2 >= 0.8.
 *
 * Of large machines as many states as some seconds allow.
 */
class ModesOfRun
{
public:
  ModesOfRun(const Scene &scene, const coupling::Machine &machine, const Result &result);

  const LocalModes &at(const coupling::KeptState &state);

  int most() const; ///< how many the scene asks for

private:
  LocalModes found(const coupling::KeptState &state) const;

  const Scene             &scene_;
  const coupling::Machine &machine_;
  const Result            &result_;
  std::size_t              most_states_;
  std::deque<LocalModes>   found_; ///< references stay
};

} // namespace gestell::apps
