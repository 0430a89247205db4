#include "apps/scene/read/frame/given_matrices.h"
#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/scene/read/frame/matrix_units.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/frame/read_node_table.h"
#include "apps/scene/read/names.h"
#include "coupling/exchange/node_places.h"
#include "coupling/exchange/rigid_motion_check.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace gestell::apps
{
namespace
{

using coupling::place_text;
using Owners = std::map<int, std::string>; ///< "top.uz" by rows from 1

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
      throw rows.error(key, "is not a DOF; valid: " + listed(motion_names) +
                                ", with '-' in front if the row is positive in the negative direction of the axis");
    const int motion = found - motion_names.begin(), row = rows.integer(key, 0);
    if (row < 1 || row > n)
      throw rows.error(key,
                       "there is no row " + std::to_string(row) + "; the matrices have rows 1 to " + std::to_string(n));
    if (interface.coordinate[motion] >= 0)
      throw rows.error(key, "the DOF " + *found + " already has a row");
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
  constexpr double one_place = 1e-6; // of the extent of the nodes: digits of files
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
            (nodes.all.empty() ? "" : "; the first node with rows is " + std::to_string(nodes.all.front().number)));
  return *found;
}

const TableNode &node_at(const SceneTable &table, const FrameNodes &nodes)
{
  if (nodes.places.empty())
    throw table.error(
        "position",
        "needs the positions of nodes; add nodes = the file that contains them, or name the node: node = 12");
  const Vector3 x       = table.vector_or("position", {});
  const auto   &nearest = *std::min_element(
        nodes.all.begin(), nodes.all.end(),
        [&](const auto &a, const auto &b) { return distance(a.motions.position, x) < distance(b.motions.position, x); });
  if (const double off = distance(nearest.motions.position, x); off > tolerance_of(nodes))
    throw table.error("position", "there is no node with rows; the nearest is " + std::to_string(nearest.number) +
                                      " at " + place_text(nearest.motions.position) + ", " + rounded(off) + " m away");
  return nearest;
}

/// Reads an interface by `node` or `position`; the rows of the matrices are known.
void read_node(const SceneTable &table, const FrameNodes &nodes, fem::Interface &interface)
{
  const TableNode &node = table.has("node") ? node_of_number(table, nodes) : node_at(table, nodes);
  interface.coordinate  = node.motions.coordinate;
  interface.sign        = node.motions.sign;
  if (nodes.places.empty())
    return; // at its `position`
  if (table.has("position") && distance(interface.position, node.motions.position) > tolerance_of(nodes))
    throw table.error("position", "node " + std::to_string(node.number) + " is at " +
                                      place_text(node.motions.position) + "; remove 'node' or 'position'");
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
      throw table.error("is already a node of the table of nodes; rename one of them");
  fem::Interface interface;
  interface.name     = table.name();
  interface.position = table.vector_or("position", {});
  const bool by_node = table.has("node") || (!given.rows.empty() && !table.has("rows"));
  if (table.has("node") && (given.rows.empty() || table.has("rows")))
    throw table.error(
        "node",
        table.has("rows")
            ? "remove 'node' or 'rows'"
            : "needs matrices that define the nodes of their rows; give rows = { uz = 1 }, or 'rows' of [frame]");
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
      throw refused("already exists: " + first->second);
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = motions.coordinate[motion] + 1; row > 0)
        if (const auto [first, is_new] = owner.emplace(row, motions.name + "." + motion_names[motion]); !is_new)
          throw refused("has row " + std::to_string(row) + ", which is " + first->second + " already");
    if (*std::max_element(motions.coordinate.begin(), motions.coordinate.end()) < 0)
      throw refused("has no row; a named node is an interface and needs at least one");
    interfaces.push_back(motions);
  }
  return interfaces;
}

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

/// A force read off the frame: stiffness_row . q + damping_row . q' + inertia_row . q'' + acceleration_row . g.
fem::FrameOutput read_output(const SceneTable &table, const std::string &name, const std::string &unit, Eigen::Index n)
{
  const auto row = [&](const std::string &key, const Kind &kind, Eigen::Index size, const std::string &needed)
  {
    const auto values = table.numbers(key, kind);
    if (static_cast<Eigen::Index>(values.size()) != size)
      throw table.error(key, "has " + std::to_string(values.size()) + " entries, but " + needed);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
  };
  const std::string coordinates = "the frame has " + std::to_string(n) + " coordinates";
  fem::FrameOutput  output;
  output.name = name;
  output.unit = unit;
  output.on_q = row("stiffness_row", kind::stiffness_entry, n, coordinates);
  output.on_v =
      table.has("damping_row") ? row("damping_row", kind::damping_entry, n, coordinates) : Eigen::VectorXd::Zero(n);
  if (table.has("inertia_row"))
    output.on_a = row("inertia_row", kind::mass_entry, n, coordinates);
  if (table.has("acceleration_row"))
    output.under_acceleration = row("acceleration_row", kind::mass_entry, 3, "x, y, z take three");
  return output;
}

/// Rows of an output itself, required if it has no components, and of those.
void read_outputs(const SceneTable &any, const OutputFamily &family, Eigen::Index n,
                  std::vector<fem::FrameOutput> &outputs)
{
  const SceneTable table = any.declared(family.keys);
  check_thing_name(table);
  const std::string             name = family.name + "." + table.name();
  std::vector<fem::FrameOutput> components;
  for (const auto &[component, unit] : family.components)
    if (table.has(component))
      components.push_back(read_output(table.table(component), name + "." + component, unit, n));
  if (components.empty() || table.has("stiffness_row"))
    outputs.push_back(read_output(table, name, family.name == "stress" ? "Pa" : "N", n));
  outputs.insert(outputs.end(), components.begin(), components.end());
}

/// q of a unit translation in x, y, z: given, or read off the nodes and interfaces if every row belongs to one.
Eigen::MatrixXd read_translations(const SceneTable &frame, const fem::FrameMatrices &matrices,
                                  const std::vector<TableNode> &nodes, bool &known)
{
  const Eigen::Index n = matrices.M.rows();
  known                = true;
  if (frame.has("translations"))
  {
    const Eigen::MatrixXd R = read_plain_matrix(frame, "translations", kind::number);
    if (R.rows() != n || R.cols() != 3)
      throw frame.error("translations", "is " + shape_text(R.rows(), R.cols()) + ", but must be " + shape_text(n, 3));
    return R;
  }
  std::vector<bool> known_row(n, false);
  Eigen::MatrixXd   R    = Eigen::MatrixXd::Zero(n, 3);
  const auto        read = [&](const fem::Interface &motions)
  {
    for (int motion = 0; motion < 6; ++motion)
      if (const int row = motions.coordinate[motion]; row >= 0)
      {
        known_row[row] = true;
        if (motion < 3)
          R(row, motion) = motions.sign[motion];
      }
  };
  for (const auto &interface : matrices.interfaces)
    read(interface);
  for (const auto &node : nodes)
    read(node.motions);
  known = std::find(known_row.begin(), known_row.end(), false) == known_row.end();
  return R;
}

/// Mass of the frame [kg]: as given, or from the rigid translations if these are known for all rows; otherwise 0.
double total_mass(const SceneTable &frame, const fem::FrameMatrices &matrices, bool has_translations)
{
  if (!has_translations && !frame.has("total_mass"))
    return 0.;
  const Eigen::Matrix3d mass = matrices.translations.transpose() * Eigen::MatrixXd(matrices.M * matrices.translations);
  return frame.value_or("total_mass", mass.diagonal().maxCoeff());
}

/// Computes the rigid motions from the positions of all nodes that have rows; states the result and warns.
void prove_rigid_motions(const SceneTable &frame, fem::FrameMatrices &matrices, const GivenMatrices &given,
                         const FrameNodes &nodes)
{
  const auto check = coupling::check_rigid_motions(matrices.M, matrices.C, given.rows, nodes.places);
  if (const std::string suspicion = suspicion_of(check, given.rows); !suspicion.empty())
    frame.warn("stiffness", suspicion);
  matrices.statements.push_back(statement_of(check));
  matrices.rigid_motions = check.R;
  matrices.centre        = {check.centre[0], check.centre[1], check.centre[2]};
  matrices.translations  = check.R.leftCols(3);
}

} // namespace

fem::FrameMatrices read_frame_matrices(const SceneTable &frame, bool &has_translations)
{
  GivenMatrices      given = read_given_matrices(frame);
  const Eigen::Index n     = given.M.rows();
  const FrameNodes   nodes = read_frame_nodes(frame, given, n);
  turn_to_global(frame, nodes.axes, given);
  fem::FrameMatrices matrices;
  matrices.M          = std::move(given.M);
  matrices.C          = std::move(given.C);
  matrices.statements = given.statements;
  matrices.B.resize(n, n);
  if (given.B)
    matrices.B = std::move(*given.B);
  else if (frame.has("damping"))
  {
    const FrameDamping damping   = read_damping(frame.table("damping"));
    matrices.modal_damping_ratio = damping.ratios;
    if (damping.alpha > 0. || damping.beta > 0.)
      matrices.B = damping.alpha * matrices.M + damping.beta * matrices.C;
  }

  matrices.interfaces = read_matrix_interfaces(frame, given, nodes, n);
  matrices.picture    = read_node_picture(frame, nodes, n);
  for (const OutputFamily &family : output_families())
    for (const auto &table : frame.tables(family.name))
      read_outputs(table, family, n, matrices.outputs);

  if (!given.rows.empty())
  {
    has_translations      = true;
    matrices.translations = coupling::rigid_translations(matrices.C, given.rows);
    if (!nodes.places.empty())
      prove_rigid_motions(frame, matrices, given, nodes);
  }
  if (given.rows.empty() || frame.has("translations"))
    matrices.translations = read_translations(frame, matrices, nodes.all, has_translations);
  matrices.mass = total_mass(frame, matrices, has_translations);
  if (matrices.mass == 0.)
    matrices.statements.push_back("mass of the frame: unknown, so effective masses include only the rows of interfaces "
                                  "and nodes; 'translations' defines the motion of all rows, 'total_mass' the mass");
  std::vector<fem::Interface> placed = matrices.interfaces;
  for (const TableNode &node : nodes.all)
    placed.push_back(node.motions);
  for (const std::string &suspicion : suspect_units(matrices, placed))
    frame.warn("mass", suspicion);
  return matrices;
}

} // namespace gestell::apps
