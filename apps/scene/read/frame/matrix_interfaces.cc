#include "apps/scene/read/frame/matrix_interfaces.h"

#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/scene/read/names.h"
#include "coupling/exchange/node_places.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{
namespace
{

using coupling::place_text;
using Owners = std::map<int, std::string>; ///< "top.uz" by rows from 1

constexpr double one_place = 1e-6; ///< of the extent of the nodes

const std::vector<std::string> motion_names{"ux", "uy", "uz", "rx", "ry", "rz"};

/// rows = { "-uz" = 1 }: row 1 of q is the displacement against z.
void read_rows(const SceneTable &table, Eigen::Index n, fem::Interface &interface)
{
  const auto rows = table.table("rows");
  for (const auto &key : rows.keys())
  {
    const bool minus = key[0] == '-';
    const auto found = std::find(motion_names.begin(), motion_names.end(), key.substr(minus));
    if (found == motion_names.end())
      throw rows.error(key, "is no motion; valid: " + listed(motion_names) +
                                ", each with '-' before it if the row counts "
                                "against the axis");
    const int motion = found - motion_names.begin(), row = rows.integer(key, 0);
    if (row < 1 || row > n)
      throw rows.error(key,
                       "there is no row " + std::to_string(row) + "; the matrices have rows 1 to " + std::to_string(n));
    if (interface.coordinate[motion] >= 0)
      throw rows.error(key, "the motion " + *found + " has a row already");
    interface.coordinate[motion] = row - 1;
    interface.sign[motion]       = minus ? -1. : 1.;
  }
  if (rows.keys().empty())
    throw rows.error("needs at least one row such as { uz = 1 }");
}

double distance(const Vector3 &a, const Vector3 &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Shortest side of what counts as one place [m].
double tolerance_of(const FrameNodes &nodes)
{
  double extent = 0.;
  for (const TableNode &node : nodes.all)
    extent = std::max(extent, distance(node.motions.position, nodes.all.front().motions.position));
  return one_place * extent;
}

const TableNode &node_of_number(const SceneTable &table, const FrameNodes &nodes)
{
  const long number = table.whole("node");
  const auto found  = std::find_if(nodes.all.begin(), nodes.all.end(),
                                   [number](const TableNode &node) { return node.number == number; });
  if (found == nodes.all.end())
    throw table.error(
        "node",
        "node " + std::to_string(number) + " has no row in the matrices" +
            (nodes.all.empty() ? "" : "; node " + std::to_string(nodes.all.front().number) + " has, for example"));
  return *found;
}

const TableNode &node_at(const SceneTable &table, const FrameNodes &nodes)
{
  if (nodes.places.empty())
    throw table.error("position",
                      "finds a node where the places of nodes are known; add nodes = the file that has them, "
                      "or name the node: node = 12");
  const Vector3 x       = table.vector_or("position", {});
  const auto   &nearest = *std::min_element(
        nodes.all.begin(), nodes.all.end(),
        [&](const auto &a, const auto &b) { return distance(a.motions.position, x) < distance(b.motions.position, x); });
  if (const double off = distance(nearest.motions.position, x); off > tolerance_of(nodes))
    throw table.error("position", "there is no node with rows; the nearest is " + std::to_string(nearest.number) +
                                      " at " + place_text(nearest.motions.position) + ", " + rounded(off) + " m away");
  return nearest;
}

/// By `node` or `position`, of matrices whose rows are known.
void read_node(const SceneTable &table, const FrameNodes &nodes, fem::Interface &interface)
{
  const TableNode &node = table.has("node") ? node_of_number(table, nodes) : node_at(table, nodes);
  interface.coordinate  = node.motions.coordinate;
  interface.sign        = node.motions.sign;
  if (nodes.places.empty())
    return; // at its `position`
  if (table.has("position") && distance(interface.position, node.motions.position) > tolerance_of(nodes))
    throw table.error("position", "node " + std::to_string(node.number) + " is at " +
                                      place_text(node.motions.position) + "; leave one of 'node' and 'position' out");
  interface.position = node.motions.position;
}

void own_rows(const SceneTable &table, const fem::Interface &interface, Owners &owner)
{
  for (int motion = 0; motion < 6; ++motion)
    if (const int row = interface.coordinate[motion] + 1; row > 0)
      if (const auto [first, is_new] = owner.emplace(row, interface.name + "." + motion_names[motion]); !is_new)
        throw table.error(table.has("rows")   ? "rows"
                          : table.has("node") ? "node"
                                              : "position",
                          "row " + std::to_string(row) + " is " + first->second + " already");
}

void add_interface(const SceneTable &any, const GivenMatrices &given, const FrameNodes &nodes, Eigen::Index n,
                   Owners &owner, std::vector<fem::Interface> &interfaces)
{
  const SceneTable table = any.declared(matrix_interface_keys());
  check_thing_name(table);
  for (const auto &other : interfaces)
    if (other.name == table.name())
      throw table.error("is a node of the table of nodes already; rename one of them");
  fem::Interface interface;
  interface.name     = table.name();
  interface.position = table.vector_or("position", {});
  const bool by_node = table.has("node") || (!given.rows.empty() && !table.has("rows"));
  if (table.has("node") && (given.rows.empty() || table.has("rows")))
    throw table.error("node", table.has("rows")
                                  ? "leave one of 'node' and 'rows' out"
                                  : "is for matrices that tell the nodes of their rows; give rows = { uz = 1 }, "
                                    "or 'rows' of [frame]");
  if (by_node && !table.has("node") && !table.has("position"))
    throw table.error("needs node = the number of its node, or its 'position'");
  if (by_node)
    read_node(table, nodes, interface);
  else
    read_rows(table, n, interface);
  own_rows(table, interface, owner);
  interfaces.push_back(std::move(interface));
}

/// Nodes that have a name in the table of nodes are interfaces.
std::vector<fem::Interface> named_nodes(const SceneTable &frame, const std::vector<TableNode> &nodes, Owners &owner)
{
  std::map<std::string, std::string> place_of;
  std::vector<fem::Interface>        interfaces;
  for (const TableNode &node : nodes)
  {
    const fem::Interface &motions = node.motions;
    if (motions.name.empty())
      continue;
    const auto refused = [&](const std::string &what)
    { return frame.error("nodes", node.place + "node '" + motions.name + "' " + what); };
    if (const auto [first, is_new] = place_of.emplace(motions.name, node.place); !is_new)
      throw refused("is there already: " + first->second);
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = motions.coordinate[motion] + 1; row > 0)
        if (const auto [first, is_new] = owner.emplace(row, motions.name + "." + motion_names[motion]); !is_new)
          throw refused("has row " + std::to_string(row) + ", which is " + first->second + " already");
    if (*std::max_element(motions.coordinate.begin(), motions.coordinate.end()) < 0)
      throw refused("has no row; a node with a name is an interface and needs one at least");
    interfaces.push_back(motions);
  }
  return interfaces;
}

} // namespace

std::vector<fem::Interface> read_matrix_interfaces(const SceneTable &frame, const GivenMatrices &given,
                                                   const FrameNodes &nodes, Eigen::Index n)
{
  Owners                      owner;
  std::vector<fem::Interface> interfaces = named_nodes(frame, nodes.all, owner);
  for (const auto &table : frame.tables("interface"))
    add_interface(table, given, nodes, n, owner, interfaces);
  if (interfaces.empty())
    throw frame.error(
        given.rows.empty()
            ? "has no interface; declare at least one [frame.interface.NAME] with rows = { uz = 1 }, or name a "
              "node in the table of nodes"
            : "has no interface; declare at least one [frame.interface.NAME] with node = the number of its "
              "node");
  return interfaces;
}

} // namespace gestell::apps
