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

/// How a scene's frame gets into the machine.
enum class FramePath
{
  none,     ///< build_machine(scene)
  dense,    ///< matrices, small: build_machine(scene) as well
  sparse,   ///< build_machine(scene, matrices): assembled by the service or given, unreduced
  reduce,   ///< build_machine(scene, reduced): by the FrameService from geometry or matrices
  from_file ///< build_machine(scene, reduced): read from scene.frame.reduced_file
};
FramePath frame_path(const Scene &scene);

/// The finished machine of a scene.  Throws std::invalid_argument with the place in the scene.
coupling::Machine build_machine(const Scene &scene); ///< FramePath none or dense
coupling::Machine build_machine(const Scene &scene, coupling::ReducedFrame frame);
coupling::Machine build_machine(const Scene &scene, fem::FrameMatrices frame);

/// The machine as far as it is known without computing: a frame that must be made first is a stand-in with its
/// interfaces.
coupling::Machine machine_to_check(const Scene &scene);

/// The signals of the scene; throws std::invalid_argument with place and nearest name for a path that does not exist.
std::vector<coupling::Signal> scene_signals(const Scene &scene, const coupling::Machine &machine);

/// State at the beginning of the run by the rule of the scene.
coupling::InitialState initial_state(const Scene &scene, coupling::Machine &machine);

/// Of the motion that coordinate_name() names, in coordinate i: -1 where a frame from matrices has the opposite motion
/// ("-uz") in its row.
double coordinate_sign(const coupling::Machine &machine, int i);

/// q [n] of the configuration that modes are asked for.
Eigen::VectorXd modes_configuration(const Scene &scene, coupling::Machine &machine);

/// The same with what is given of it, which an equilibrium there holds.
coupling::KnownStart modes_position(const Scene &scene, coupling::Machine &machine);

/// Builds the machine, on a frame that only has the right names where the true one must be computed, and with it all
/// signals and states: what is wrong in a scene beyond read_scene() comes up here.  Computes nothing.  Joints are
/// closed if places_known(): a body turns about its interface.  @return all warnings, those of read_scene() included
std::vector<std::string> check_scene(const Scene &scene);

/// Whether the scene says where all interfaces of its frame are; the centroids of surfaces are known by the CAD file.
bool places_known(const Scene &scene);

/// Refuses names of [start] and [modes] that the machine does not have.
void check_start_names(const Scene &scene, const coupling::Machine &machine);

/// What is said against a start, headed with the place of the joint or element it names, or else that of [start].
std::invalid_argument against_start(const Scene &scene, const std::string &message);

/// Whether the machine gets moving from its start, as far as that is known without its frame.
/// @throws std::invalid_argument with the place of the element or joint that is to be changed
void check_start(const Scene &scene);
/// The same of a machine at its start: elements that stick to what is held already.
void require_free_motion(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &initial);

/// Refuses a scene without what `gestell run` needs.
void require_run(const Scene &scene);

} // namespace gestell::apps
