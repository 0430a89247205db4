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

/// All undamped modes of the machine linearised at an instant of a run.
struct LocalModes
{
  double                      t = 0.; ///< [s]
  std::string                 place;  ///< positions of the first rotors and sliders: "crank 160.2 deg, slide 152 mm"
  std::vector<coupling::Mode> modes;
  std::vector<int>            numbers; ///< [modes] index in Result::coupled_modes, from 0; -1: none
  coupling::EnergyShares      shares;
  std::string                 unknown; ///< why there are no modes; empty: there are

  std::string strain(std::size_t mode) const; ///< part with most of its strain energy: "rod by 75 %"; may be empty
};

/**
 * The machine linearised at states of its run, each instant once.  A mode v there is identified with the mode v_j of
 * Result::coupled_modes if their shapes agree:
 *
 *     (v^T M v_j)^2 >= 0.8.
 *
 * For large machines the number of states is limited to a few seconds of computing time.
 */
class ModesOfRun
{
public:
  ModesOfRun(const Scene &scene, const coupling::Machine &machine, const Result &result);

  const LocalModes &at(const coupling::KeptState &state);

  int most() const; ///< number of modes requested in the scene

private:
  LocalModes found(const coupling::KeptState &state) const;

  const Scene             &scene_;
  const coupling::Machine &machine_;
  const Result            &result_;
  std::size_t              most_states_;
  std::deque<LocalModes>   found_; ///< a deque, so that references stay valid
};

} // namespace gestell::apps
