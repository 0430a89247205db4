#pragma once

#include "coupling/frame/reduced_frame.h"

#include <string>
#include <vector>

namespace gestell::apps
{

enum class MatrixFormat
{
  matrix_market, ///< .mtx
  petsc,         ///< PETSc's binary format, .petsc
  dmig           ///< mass, damping and stiffness as Nastran DMIG cards, frame.pch, with the interface nodes
};

/// "matrix-market", "petsc" or "dmig".  @throws std::invalid_argument for others.
MatrixFormat matrix_format(const std::string &name);

/// Names of the files that export_frame() may write.
std::vector<std::string> exported_names(MatrixFormat format);

/**
 * Writes a reduced frame for other programs: mass, damping, stiffness and translations as matrices, nodes.csv with
 * interfaces and skin, triangles.csv, node_displacements (rows of the nodes times q), and frame.toml, the [frame] of a
 * scene that reads these files as a frame given by matrices.  Rows are the interface coordinates, then modes.
 *
 * `translations` are M^-1 f, where f is the load of a unit acceleration: the best approximation of a unit translation
 * of the whole frame in the coordinates of the reduced frame, with unchanged gravity load.
 *
 * In Nastran cards interfaces are grid points 1, 2, ... with DOFs along the axes; all other coordinates are scalar
 * points starting at 1001 (or the next power of ten plus one).  Rows are in this order, and numbers have ten digits.
 *
 * @param remark  about the scene of the frame, for people.
 * @return the files written.
 * @throws coupling::WriteFailure if one cannot be written; also the exceptions of OwnFolder::claim().
 */
std::vector<std::string> export_frame(const std::string &folder, const coupling::ReducedFrame &frame,
                                      MatrixFormat format, const std::string &remark);

} // namespace gestell::apps
