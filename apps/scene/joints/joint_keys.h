#pragma once

#include "apps/scene/read/names.h"

namespace gestell::apps
{

// What several types of joints and measures share: keys, and what reads and checks them.

std::vector<Key> two_places();                             ///< `from` and `to`, each with a point of its own
std::vector<Key> place_on_ground();                        ///< the same; `to` is by default the ground
std::vector<Key> one_point();                              ///< or with one point `at` of both
std::vector<Key> point_joint(const std::vector<Key> &own); ///< with one point, and it may yield

Key axis_key(const std::string &meaning = "the line, which turns with `from`");

/// Two places, and what else goes into the joint.
void read_two_places(const SceneTable &table, const Names &names, JointRequest &joint);
/// One place tells the other.
void read_joined_places(const SceneTable &table, const Names &names, JointRequest &joint);
/// One of them is demanded.
void read_one_point(const SceneTable &table, const Names &names, JointRequest &joint);

/// @throws the table's error for places on one body
void check_two_places(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to);
bool turns_about_own_axis(const BodyRequest *body); ///< a rotor or planar body
bool turns_freely(const Names &names, const std::string &marker);
/// Joints that count turns: a body that turns freely in space has no angle without end.
void refuse_in_space(const SceneTable &table, const std::string &key, const std::string &marker, const Names &names);

} // namespace gestell::apps
