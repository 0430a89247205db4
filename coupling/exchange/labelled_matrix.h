#pragma once

#include <Eigen/SparseCore>

#include <map>
#include <string>
#include <vector>

namespace gestell::coupling
{

class TextFile;

/// Label of a matrix row: a DOF of a node, or a coordinate without a position, such as that of a mode.
struct RowLabel
{
  long node      = 0;
  int  component = 0; ///< 1..3 displacements x, y, z; 4..6 rotations; 0: not a nodal DOF

  bool is_displacement() const { return component >= 1 && component <= 3; }
  bool is_rotation() const { return component >= 4; }
  bool operator==(const RowLabel &other) const { return node == other.node && component == other.component; }
  bool operator<(const RowLabel &other) const; ///< nodal DOFs first
};

std::string text_of(const RowLabel &row); ///< "node 12, uz", "point 1001"

/// A matrix of another program, both triangles, in units of its file.
struct LabelledMatrix
{
  Eigen::SparseMatrix<double> A;
  std::vector<RowLabel>       rows{}; ///< [n], or empty: unknown
};

/// One entry of a file.
struct FileEntry
{
  int    row, column;
  double value;
  long   line;
};

/// Storage of a matrix in a file.
enum class Triangles
{
  both,
  one ///< each pair i, j once; the other triangle by symmetry
};

/**
 * The matrix of entries of a file.
 *
 * @param n         rows and columns.
 * @param rows      labels for messages; empty: by their numbers.
 * @throws std::invalid_argument  with both lines, for a duplicate entry.
 */
Eigen::SparseMatrix<double> assembled(const TextFile &file, std::vector<FileEntry> entries, int n, Triangles triangles,
                                      const std::vector<RowLabel> &rows);

/// Index of each row of `from` in `in`; -1 if missing.
std::vector<int> places_of(const std::vector<RowLabel> &from, const std::vector<RowLabel> &in);

/// The matrix with its rows where `rows` has them, zero elsewhere; all of its rows must be there.
Eigen::SparseMatrix<double> spread(const LabelledMatrix &matrix, const std::vector<RowLabel> &rows);

} // namespace gestell::coupling
