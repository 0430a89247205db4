#pragma once

#include "coupling/frame/reduced_frame.h"
#include "fem/values/frame_matrices.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace gestell::python
{

/// A reduced frame shared by scenes.
struct PythonFrame
{
  explicit PythonFrame(std::shared_ptr<const coupling::ReducedFrame> made) : frame(std::move(made)) {}

  std::shared_ptr<const coupling::ReducedFrame> frame;

  std::vector<std::string> coordinates() const; ///< "frame.crown.ux", ..., "mode 1"
};

/// A frame that is not reduced: sparse matrices, which numpy and scipy use without copies.
struct PythonFullFrame
{
  fem::FrameMatrices frame;

  pybind11::dict interface_rows() const; ///< name -> {"ux": row, ...}, rows from 0
  std::size_t    nbytes() const;         ///< of M, B, C
};

/// (values, rows, begins of columns, n) of a sparse matrix by columns, as views that keep `owner` alive.
pybind11::tuple csc_views(const pybind11::object &owner, const fem::SparseMatrix &matrix);

/// Frame and FullFrame.
void bind_frames(pybind11::module_ &module);

} // namespace gestell::python
