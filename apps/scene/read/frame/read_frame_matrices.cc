#include "apps/scene/read/frame/given_matrices.h"
#include "apps/scene/read/frame/matrix_interfaces.h"
#include "apps/scene/read/frame/matrix_keys.h"
#include "apps/scene/read/frame/matrix_units.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/frame/read_node_table.h"
#include "apps/scene/read/names.h"
#include "coupling/exchange/rigid_motion_check.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// Those of x, y, z that a support has tables of.
std::vector<std::string> directions_of(const SceneTable &support)
{
  std::vector<std::string> directions;
  for (const std::string direction : {"x", "y", "z"})
    if (support.has(direction))
      directions.push_back(direction);
  return directions;
}

/// A force read off the frame: stiffness_row . q + damping_row . q' + acceleration_row . g.
fem::FrameOutput read_output(const SceneTable &any, const std::string &before, Eigen::Index n)
{
  const SceneTable table = any.declared(matrix_output_keys());
  check_thing_name(table);
  const auto row = [&](const std::string &key, const Kind &kind, Eigen::Index size, const std::string &needed)
  {
    const auto values = table.numbers(key, kind);
    if (static_cast<Eigen::Index>(values.size()) != size)
      throw table.error(key, "has " + std::to_string(values.size()) + " entries, but " + needed);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), size));
  };
  const std::string coordinates = "the frame has " + std::to_string(n) + " coordinates";
  fem::FrameOutput  output;
  output.name = before + table.name();
  output.unit = "N";
  output.on_q = row("stiffness_row", kind::stiffness_entry, n, coordinates);
  output.on_v =
      table.has("damping_row") ? row("damping_row", kind::damping_entry, n, coordinates) : Eigen::VectorXd::Zero(n);
  if (table.has("acceleration_row"))
    output.under_acceleration = row("acceleration_row", kind::mass_entry, 3, "x, y, z take three");
  return output;
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

/// [kg] as given, or by the rigid translations if those of all rows are known; else 0.
double total_mass(const SceneTable &frame, const fem::FrameMatrices &matrices, bool has_translations)
{
  if (!has_translations && !frame.has("total_mass"))
    return 0.;
  const Eigen::Matrix3d mass = matrices.translations.transpose() * Eigen::MatrixXd(matrices.M * matrices.translations);
  return frame.value_or("total_mass", mass.diagonal().maxCoeff());
}

/// By the places of all nodes that have rows; tells what was found, and warns of what does not fit.
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
  for (const auto &table : frame.tables("cut"))
    matrices.outputs.push_back(read_output(table, "cut.", n));
  for (const auto &table : frame.tables("support")) // by matrix_support_keys()
    if (const auto directions = directions_of(table); directions.empty())
      matrices.outputs.push_back(read_output(table, "support.", n));
    else
      for (const auto &direction : directions)
        matrices.outputs.push_back(read_output(table.table(direction), "support." + table.name() + ".", n));

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
    matrices.statements.push_back("mass of the frame: not known, and effective masses count the rows of interfaces and "
                                  "nodes alone; 'translations' says how all rows move, 'total_mass' what it weighs");
  std::vector<fem::Interface> placed = matrices.interfaces;
  for (const TableNode &node : nodes.all)
    placed.push_back(node.motions);
  for (const std::string &suspicion : suspect_units(matrices, placed))
    frame.warn("mass", suspicion);
  return matrices;
}

} // namespace gestell::apps
