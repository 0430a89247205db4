#pragma once

#include "apps/scene/file/scene_node.h"

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace gestell::tests
{

// Values of the tree of a scene, made from others: texts stay expressions of the scene's parameters.

apps::SceneNode text_node(const std::string &text);
apps::SceneNode number_node(double value);
apps::SceneNode array_node(std::vector<apps::SceneNode> elements);

/// sum of weight times value, + constant; plain numbers get the unit that their key understands, such as " m".
apps::SceneNode weighted_sum(const std::vector<std::pair<double, apps::SceneNode>> &terms, const std::string &unit,
                             double constant = 0.);
/// T matrix T^T of an array of rows.
apps::SceneNode transformed_matrix(const apps::SceneNode &matrix, const Eigen::MatrixXd &T, const std::string &unit);

/// The value stands where the other one does in its file, for messages.
void put_at(apps::SceneNode &value, const apps::SceneNode &as);

/// The table of the tree, made where it is missing.
apps::SceneNode &table_of(apps::SceneNode &parent, const std::string &key);

} // namespace gestell::tests
