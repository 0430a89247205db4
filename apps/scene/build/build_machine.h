#pragma once

#include "apps/scene/scene.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/simulation.h"

#include <Eigen/Core>

#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// How the frame of a scene is inserted into the machine.
enum class FramePath
{
  none,     ///< build_machine(scene)
  dense,    ///< small matrices: build_machine(scene) as well
  sparse,   ///< build_machine(scene, matrices): assembled by the service or given, unreduced
  reduce,   ///< build_machine(scene, reduced): by the FrameService from geometry or matrices
  from_file ///< build_machine(scene, reduced): read from scene.frame.reduced_file
};
FramePath frame_path(const Scene &scene);

/// The finished machine of a scene.  Throws std::invalid_argument with the location in the scene.
coupling::Machine build_machine(const Scene &scene); ///< FramePath none or dense
coupling::Machine build_machine(const Scene &scene, coupling::ReducedFrame frame);
coupling::Machine build_machine(const Scene &scene, fem::FrameMatrices frame);

/// The machine without computations: a frame that must be made first is replaced by a placeholder with its interfaces.
coupling::Machine machine_to_check(const Scene &scene);

/// The signals of the scene; throws std::invalid_argument with location and most similar name for an unknown path.
std::vector<coupling::Signal> scene_signals(const Scene &scene, const coupling::Machine &machine);

/// State at the start of the run, by the rule of the scene.
coupling::InitialState initial_state(const Scene &scene, coupling::Machine &machine);

/// Sign of the motion coordinate_name() in coordinate i: -1 if the row of a frame from matrices is the opposite motion
/// ("-uz").
double coordinate_sign(const coupling::Machine &machine, int i);

/// q [n] of the configuration for the modes.
Eigen::VectorXd modes_configuration(const Scene &scene, coupling::Machine &machine);

/// The same with its given coordinates, which an equilibrium there keeps.
coupling::KnownStart modes_position(const Scene &scene, coupling::Machine &machine);

/// Builds the machine with all signals and states, to find errors that read_scene() cannot find; nothing is computed.
/// A frame that must be computed first is replaced by one with the right names.  Joints are assembled if
/// places_known(): a body rotates about its interface.  @return all warnings, including those of read_scene()
std::vector<std::string> check_scene(const Scene &scene);

/// Whether the scene contains the positions of all interfaces of its frame; centroids need the CAD file.
bool places_known(const Scene &scene);

/// Rejects names in [start] and [modes] that the machine does not have.
void check_start_names(const Scene &scene, const coupling::Machine &machine);

/// Error about an initial state, with the location of the joint or element that it names, or else that of [start].
std::invalid_argument against_start(const Scene &scene, const std::string &message);

/// Checks that the machine can move from its initial state, as far as that is known without its frame.
/// @throws std::invalid_argument with the location of the element or joint that must be changed
void check_start(const Scene &scene);
/// The same for a machine at its initial state: rejects elements that stick to something constrained.
void require_free_motion(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &initial);

/// Rejects a scene without the keys that `gestell run` needs.
void require_run(const Scene &scene);

} // namespace gestell::apps
