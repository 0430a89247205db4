#pragma once

#include "apps/session/session.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace gestell::python
{

/// What was computed, with the session that it refers to.
class PythonResult
{
public:
  PythonResult(std::shared_ptr<apps::Session> session, apps::Result result)
      : session_(std::move(session)), result_(std::move(result))
  {
  }

  const apps::Result &result() const { return result_; }
  /// @throws std::invalid_argument if nothing was run
  const coupling::RunResult &run() const;

private:
  std::shared_ptr<apps::Session> session_;
  apps::Result                   result_;
};

/// A frame that scenes share.
struct PythonFrame
{
  explicit PythonFrame(std::shared_ptr<const coupling::ReducedFrame> made) : frame(std::move(made)) {}

  std::shared_ptr<const coupling::ReducedFrame> frame;

  std::vector<std::string> coordinates() const; ///< "frame.crown.ux", ..., "mode 1"
};

/// The history [rows x columns] of a result, whose memory it shows and keeps alive; it cannot be written to.
pybind11::array history_view(const pybind11::object &result);
/// One column of it, by the name of a signal, "t", or an energy.
/// @throws std::invalid_argument with the nearest name
pybind11::array column_view(const pybind11::object &result, const std::string &name);

/// Shapes of modes in columns.
Eigen::MatrixXd shapes_of(const std::vector<coupling::Mode> &modes);

/// Largest and smallest values in a table, and the first charts, for a notebook.
std::string notebook_text(const PythonResult &result);

} // namespace gestell::python
