#pragma once

#include "apps/scene/read/names.h"

namespace gestell::apps
{

// Keys shared by several types of joints and measures, and functions that read and check them.

std::vector<Key> two_places();                             ///< `from` and `to`, each with its own point
std::vector<Key> place_on_ground();                        ///< the same; `to` is by default the ground
std::vector<Key> one_point();                              ///< or with one common point `at`
std::vector<Key> point_joint(const std::vector<Key> &own); ///< with one point; it can be compliant

Key axis_key(const std::string &meaning = "axis, which rotates with `from`");

/// Reads two points, and the other keys of the joint.
void read_two_places(const SceneTable &table, const Names &names, JointRequest &joint);
/// If one point is given it is used for both.
void read_joined_places(const SceneTable &table, const Names &names, JointRequest &joint);
/// One of them is required.
void read_one_point(const SceneTable &table, const Names &names, JointRequest &joint);

/// @throws the table's error for two points on one body
void check_two_places(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to);
bool turns_about_own_axis(const BodyRequest *body); ///< a rotor or planar body
bool turns_freely(const Names &names, const std::string &marker);
/// For joints that count revolutions: rejects a free spatial body, which has no continuous angle.
void refuse_in_space(const SceneTable &table, const std::string &key, const std::string &marker, const Names &names);

} // namespace gestell::apps
