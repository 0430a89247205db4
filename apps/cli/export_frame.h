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
  dmig           ///< mass, damping and stiffness on cards of Nastran, frame.pch, with the nodes of the interfaces
};

/// "matrix-market", "petsc" or "dmig".  @throws std::invalid_argument for others.
MatrixFormat matrix_format(const std::string &name);

/// Names of the files that export_frame() may write.
std::vector<std::string> exported_names(MatrixFormat format);

/**
 * Writes a reduced frame for other programs: mass, damping, stiffness and translations as matrices, nodes.csv with
 * interfaces and skin, triangles.csv, node_displacements (rows of the nodes times q), and frame.toml, the [frame] of a
 * scene that takes all this back as a frame given by matrices.  Rows are the interface coordinates, then modes.
 *
 * `translations` are M^-1 f with f the load of a unit acceleration: in the coordinates of the reduced frame the best a
 * unit translation of the whole frame can be told by, and gravity is the same.
 *
 * On cards of Nastran interfaces are grid points 1, 2, ... with motions along the axes, all other coordinates scalar
 * points from 1001 on (or the next power of ten); rows are in this order, and numbers have ten digits.
 *
 * @param remark  of the scene the frame is from, for people.
 * @return the files written.
 * @throws coupling::WriteFailure if one cannot be written, as OwnFolder::claim() besides.
 */
std::vector<std::string> export_frame(const std::string &folder, const coupling::ReducedFrame &frame,
                                      MatrixFormat format, const std::string &remark);

} // namespace gestell::apps
