#pragma once

#include "apps/scene/file/scene_table.h"
#include "fem/values/modal_ratios.h"

namespace gestell::apps
{

/// Damping of a frame: ratios of its modes, or Rayleigh damping B = alpha M + beta C.
struct FrameDamping
{
  fem::ModalRatios ratios;
  double           alpha = 0., beta = 0.; ///< [1/s], [s]
};

/// `damping` of a frame: { ratio = 0.02 }, { ratio = [0.01, 0.02] } by mode, { ratio = [["20 Hz", 0.01], ["90 Hz",
/// 0.02]] } by frequency, with single modes by { modes = [{ mode, ratio }, { from, to, ratio }, { file }] }, or {
/// rayleigh = [{ frequency, ratio }, { frequency, ratio }] }.
FrameDamping read_damping(const SceneTable &damping);

/// Keys of that table.
const std::vector<Key> &damping_keys();

} // namespace gestell::apps
