#pragma once

#include "fem/assembly/block_matrix.h"
#include "fem/assembly/constraint_closure.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

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
  std::vector<Combination>   ties;     ///< tied displacement as a combination of other values, see closed_ties()
  std::vector<Combination>   measures; ///< new coordinate k as a functional of u; empty for coordinates of interfaces
  int                        n_interface_coordinates = 0; ///< the first of the new coordinates; they end up last in q

  int  first_new() const { return static_cast<int>(held.size()); }
  void tie(int displacement, Combination combination);
};

/**
 * The transformation  u = G q  to the coordinates q of the constrained frame.
 *
 * q contains the displacements that are neither fixed nor tied, in the order of u; then inner coordinates of averaged
 * surfaces; then six coordinates for every interface, or three.  G has a one in most rows, so only the others are
 * stored.
 */
class AffineConstraints
{
public:
  explicit AffineConstraints(const MultipointConstraints &constraints);

  /// The same for a subset of nodes, as plain lists for sending: free coordinates first, in the order of the nodes;
  /// ties in the order of the whole frame, so that project() sums in the same order.
  struct Lists
  {
    int                 n_free = 0, n_coordinates = 0;
    std::vector<int>    column, tied_row, tied; ///< as the members below
    std::vector<int>    tie_begin, tie_column;  ///< compressed rows of the tied displacements
    std::vector<double> tie_weight;
    std::vector<int>    coordinates; ///< [n_coordinates] numbers in the whole frame
  };
  explicit AffineConstraints(const Lists &lists);
  /// @param nodes ascending.
  Lists of_nodes(const std::vector<int> &nodes) const;

  int n_coordinates() const { return n_coordinates_; }
  /// The last coordinates are those of the nodes of interfaces and masses.
  int first_of_nodes() const { return n_coordinates_ - n_of_nodes_; }
  int n_displacements() const { return static_cast<int>(column_.size()); }

  /// Index in q of a value as numbered in MultipointConstraints, or -1 if it is fixed or tied.
  int coordinate(int value) const;
  /// Row of G as pairs (coordinate, weight).
  Combination row(int displacement) const;

  Eigen::VectorXd expand(const Eigen::VectorXd &q) const; ///< u = G q
  Eigen::VectorXd gather(const Eigen::VectorXd &f) const; ///< G^T f: forces on nodes to forces on coordinates

  /// G^T A G; a matrix with blocks of one stands for A (x) I_3.
  Eigen::SparseMatrix<double> project(const BlockMatrix &A) const;

private:
  /// G^T A G + `beside` [n x n], both symmetric, summed in one pass.
  Eigen::SparseMatrix<double> project_free(const BlockMatrix &A, const Eigen::SparseMatrix<double> &nearby) const;

  std::vector<int>                             column_;     // [3 n_nodes] coordinate or -1
  std::vector<int>                             new_column_; // coordinates of the new values
  std::vector<int>                             tied_row_;   // [3 n_nodes] row of G_t or -1
  std::vector<int>                             tied_;       // displacement of every row of G_t
  Eigen::SparseMatrix<double, Eigen::RowMajor> G_t_;        // rows of the tied displacements
  int                                          n_free_ = 0, n_coordinates_ = 0, n_of_nodes_ = 0;
};

} // namespace gestell::fem
