#pragma once

#include "apps/scene/joints/joined_pair.h"
#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"

namespace gestell::apps
{

coupling::Measure measure_of(const MotionMeasure &motion, const coupling::MachineModel &machine);

/// Measures of an element.  @throws std::invalid_argument if all are always zero, such as a node's rotation
std::vector<coupling::Measure> measures_of(const std::vector<MotionMeasure> &motions,
                                           const coupling::MachineModel     &machine);

void draw_places(coupling::MachineModel &machine, const PlaceRequest &from, const PlaceRequest &to);

/// Adds the measures of a scene to the machine, which must have its bodies.
void add_measures(coupling::MachineModel &machine, const Scene &scene);

/// Adds a joint with one equation on a measure of its own.
void add_measure_joint(coupling::MachineModel &machine, const JointRequest &joint);

/// Attaches a law of one measure, with its virtual coordinates, to a measure of the scene.
void attach_on_measure(coupling::MachineModel &machine, const ElementRequest &element);

} // namespace gestell::apps
