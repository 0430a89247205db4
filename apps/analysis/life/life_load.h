#pragma once

#include "apps/analysis/life/damage/cycles.h"
#include "apps/scene/values/life_request.h"
#include "apps/session/session.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace gestell::apps
{

/// States of the frame during the load, one repetition of which is its runs with their repetitions.
struct LifeLoad
{
  Eigen::MatrixXd     states; ///< (p; g) [n1 + m + 3 x samples], see coupling::stress_state()
  std::vector<double> t;      ///< [samples] s, of the run of each
  LoadSequence        sequence;
  std::vector<double> windows;      ///< [s] of the runs
  double              service = 0.; ///< [s] of one repetition
  double              strokes = 0.; ///< of one repetition
  Eigen::MatrixXd     before; ///< states in the interval before that of the run, as long; empty: the run begins later
  double              step = 0.; ///< [s] between samples

  Eigen::Index n_samples() const { return states.cols(); }
};

/// The scene of a block with the changes that reach it, as data and read; errors begin with the place of the block.
Variant block_variant(const Variant &own, const BlockRequest &block);
Scene   block_scene(const Variant &own, const BlockRequest &block);

/// Sets what does not depend on states: repetitions, residue, service and strokes.
void weigh(LifeLoad &load, const Variant &own, const Scene &scene);

/// @throws std::invalid_argument for a block with another frame
void check_blocks(Session &session);

/// Another method of integration for a scene.
using Integration = std::function<coupling::MethodOptions(const Scene &)>;

void integrate_by(const Integration &integration, Scene &scene);

/// The load of [life] of a session with its finished run; runs the scenes of its blocks.
/// @param integration  of the blocks; empty: as their scenes say
/// @throws std::invalid_argument for a block with another frame, std::runtime_error if one does not come to its end
LifeLoad life_load(Session &session, const coupling::RunResult &run, const Integration &integration = {});

/// Some of its samples, in their order; damage of these is not larger.  @param chosen  ascending, some of each block
LifeLoad thinned(const LifeLoad &load, const std::vector<std::int64_t> &chosen);

} // namespace gestell::apps
