#pragma once

#include "apps/scene/file/scene_node.h"

namespace gestell::apps
{

/// Whether a value was given by `--set`.
bool from_command_line(const SceneNode &node);

/// ": with --set life.curve.class=70" for a table of a file with keys that were given by `--set`, in it or its inner
/// tables; "": there are none.
std::string changes_words(const SceneNode &table);

/// The place of a key of a table with this place: "press.toml:9: element.rod" becomes "press.toml:9: element.rod.gap",
/// before the words of changes.
std::string place_of_key(const std::string &table_place, const std::string &key);

/// " (with --set parameters.F=3 kg)" for an error that quotes a value of parameters, or of others that depend on them;
/// "": none of them was given by `--set`, or the error names it.
std::string parameter_changes_words(const SceneNode &scene, const std::string &error);

/**
 * Lets a newer layer of [run], from an extending file or the command line, replace keys of an older layer without
 * resetting each of them: another method removes the parameters of the former one; a tolerance replaces a fixed step
 * and the order that belongs to it.  Values from the command line remain.
 */
void make_way(SceneNode &older, const SceneNode &newer);

/**
 * The same for [frame] in a whole scene: a reduced frame replaces the older layer's keys of its frame and of
 * [reduction], because its file contains both; another frame replaces a reduced one.
 */
void make_way_for_frame(SceneNode &older_scene, const SceneNode &newer_frame);

/// The same for [start]: a steady initial state with angles, speeds and a driver replaces given coordinates, and vice
/// versa.
void make_way_for_start(SceneNode &older, const SceneNode &newer);

} // namespace gestell::apps
