#pragma once

#include "fem/values/sparse_matrix.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// Linear combination  sum weight * value(index).
using Combination = std::vector<std::pair<int, double>>;

/**
 * Dependent nodal displacements u [3 n_nodes]. Values are numbered: first the displacements, 3 node + direction; then
 * new coordinates, starting at 3 n_nodes.
 */
struct MultipointConstraints
{
  explicit MultipointConstraints(int n_nodes);

  std::vector<char>          held;     ///< [3 n_nodes] displacement is fixed to zero
  std::map<int, std::string> holder;   ///< name of the support of a node, for messages
  std::vector<int>           tie_of;   ///< [3 n_nodes] index into ties, or -1
  std::vector<Combination>   ties;     ///< tied displacement as a combination of other values, tied before it or free
  std::vector<Combination>   measures; ///< new coordinate k as a functional of u; empty for coordinates of interfaces
  int                        n_interface_coordinates = 0; ///< the first of the new coordinates; they end up last in q

  int  first_new() const { return static_cast<int>(held.size()); }
  void tie(int displacement, Combination combination);
};

/// Cells that are summed, and the coordinates of the sum, ascending: all, or those of a part.
struct Extent
{
  std::vector<int> cells, coordinates;
};

/// Matrices of one cell.
struct CellMatrices
{
  Eigen::MatrixXd C; ///< [3 n x 3 n], with the displacements of a node beside each other
  Eigen::MatrixXd M; ///< [n x n], the same for each direction
};

/// Sums over cells, symmetric to the last bit.
struct MatrixSums
{
  SparseMatrix C, M;
};

/**
 * The transformation  u = G q  to the coordinates q of the constrained frame, by deal.II's AffineConstraints.
 *
 * q contains the displacements that are neither fixed nor tied, in the order of u; then inner coordinates of averaged
 * surfaces; then six coordinates for every interface, or three.
 */
class AffineConstraints
{
public:
  /// @throws std::invalid_argument for ties to displacements that are tied later.
  explicit AffineConstraints(const MultipointConstraints &constraints);

  const MultipointConstraints &constraints() const { return constraints_; }

  int n_coordinates() const { return static_cast<int>(G_.cols()); }
  /// New coordinates follow the free displacements.
  int n_free() const { return n_coordinates() - static_cast<int>(constraints_.measures.size()); }
  /// The last coordinates are those of the nodes of interfaces and masses.
  int first_of_nodes() const { return n_coordinates() - constraints_.n_interface_coordinates; }
  int n_displacements() const { return static_cast<int>(G_.rows()); }

  /// Index in q of a value as numbered in MultipointConstraints, or -1 if it is fixed or tied.
  int coordinate(int value) const { return index_[value] < n_coordinates() ? index_[value] : -1; }
  /// Row of G as pairs (coordinate, weight).
  Combination row(int displacement) const;

  Eigen::VectorXd expand(const Eigen::VectorXd &q) const { return G_ * q; } ///< u = G q
  /// G^T f: forces on nodes to forces on coordinates
  Eigen::VectorXd gather(const Eigen::VectorXd &f) const { return G_.transpose() * f; }

  /// G^T A G, symmetric to the last bit as A is.
  Eigen::SparseMatrix<double> project(const Eigen::SparseMatrix<double> &A) const;

  /// G^T A G of the sums A of the matrices of cells.
  MatrixSums sum(const Extent &extent, const std::function<std::vector<int>(int cell)> &nodes,
                 const std::function<CellMatrices(int cell)> &matrices) const;

private:
  struct Lines;

  MultipointConstraints                        constraints_;
  std::vector<int>                             index_; // of every value: coordinate, or beyond them if it is not free
  Eigen::SparseMatrix<double, Eigen::RowMajor> G_;
  std::shared_ptr<const Lines>                 lines_; // of the dependent indices
};

} // namespace gestell::fem
