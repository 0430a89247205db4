#pragma once

#include "apps/scene/joints/joint_type.h"

namespace gestell::apps
{

/// All types of joints; to add one, write joints/x.cc and its line in joint_types.cc.
const std::vector<JointType> &joint_types();
const JointType              &joint_type(const std::string &name);

/// A type of measures.
struct MeasureType
{
  std::string      name, does, signals;
  std::vector<Key> keys; ///< including `type`

  MeasureRequest (*read)(const SceneTable &table, const Names &names); ///< without name and location
};
const std::vector<MeasureType> &measure_types();

/// Keys of [place.NAME].
const std::vector<Key> &place_keys();

/// Reads all [place.NAME] and [measure.NAME] and adds them to `names`.
void read_places(const SceneTable &scene, Names &names, Scene &result);

/// Reads all [joint.NAME] into the scene.
void read_joints(const SceneTable &scene, const Names &names, Scene &result);

} // namespace gestell::apps
