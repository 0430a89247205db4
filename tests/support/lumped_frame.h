#pragma once

#include <Eigen/Dense>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gestell::tests
{

/// Node and direction of a row, 1 to 6; 0: a mode.
using FileRow = std::pair<long, int>;

/// Matrices of a frame in SI, with what their rows are.
struct LumpedFrame
{
  Eigen::MatrixXd                                     M, C;
  std::vector<FileRow>                                rows;
  std::vector<std::pair<long, std::array<double, 3>>> nodes;
  double                                              mass = 0.;

  /// The same in units of length and mass, seconds, N / (kg m/s^2) such units of force: displacements in the unit,
  /// rotations in rad, coordinates of modes with unit mass as they are.
  LumpedFrame in_units(double length, double mass_unit) const;
};

/**
 * Four bodies of six motions in space, each tied to each other by springs against shift and turn halfway, which makes
 * rigid motions free of strain: 24 rows, node after node.
 *
 * @param grounded  node 7 stands on springs as well.
 */
LumpedFrame lumped_frame(bool grounded);

/// Craig and Bampton's: nodes 11 and 12 stay, the rest becomes the lowest `n_modes` modes, points 1001, ....
LumpedFrame craig_bampton_frame(const LumpedFrame &whole, int n_modes);

/// Texts of other programs.
enum class CardFields
{
  small_,
  large,
  free_
};
std::string dmig_text(const std::string &name, const Eigen::MatrixXd &A, const std::vector<FileRow> &rows,
                      CardFields fields);
std::string grid_text(const LumpedFrame &frame);
std::string indexed_text(const Eigen::MatrixXd &A); ///< .sti, .mas: upper triangle
std::string dof_text(const std::vector<FileRow> &rows);
std::string mapping_text(const std::vector<FileRow> &rows);
std::string inp_text(const LumpedFrame &frame);
std::string nblock_text(const LumpedFrame &frame);
std::string node_table_text(const LumpedFrame &frame, const std::string &unit, bool named);
/// @param by_direction  a node for each row, as CalculiX writes; else one line for each node, as Abaqus does
std::string element_matrix_text(const std::vector<std::pair<std::string, Eigen::MatrixXd>> &matrices,
                                const std::vector<FileRow> &rows, bool by_direction);
std::string harwell_boeing_text(const Eigen::MatrixXd &A, bool symmetric);
std::string matrix_market_text(const Eigen::MatrixXd &A);

} // namespace gestell::tests
