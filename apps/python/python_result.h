#pragma once

#include "apps/session/session.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace gestell::python
{

/// Results of a computation, with the session to which they refer.
class PythonResult
{
public:
  PythonResult(std::shared_ptr<apps::Session> session, apps::Result result)
      : session_(std::move(session)), result_(std::move(result))
  {
  }

  const apps::Result &result() const { return result_; }
  /// With spectra and orders, which otherwise only files contain: computed at the first call.
  const apps::Result &whole_result();
  /// @throws std::invalid_argument if there is no run
  const coupling::RunResult &run() const;

private:
  std::shared_ptr<apps::Session> session_;
  apps::Result                   result_;
  bool                           whole_ = false;
};

/// Numbers of an object as a read-only array that keeps it alive.
pybind11::array read_only(const pybind11::object &result, std::vector<pybind11::ssize_t> shape,
                          std::vector<pybind11::ssize_t> strides, const double *first);

/// The history [rows x columns] of a result as a read-only view that keeps it alive.
pybind11::array history_view(const pybind11::object &result);
/// One column of it, by the name of a signal, "t", or an energy.
/// @throws std::invalid_argument with the most similar name
pybind11::array column_view(const pybind11::object &result, const std::string &name);

/// Shapes of modes in columns.
Eigen::MatrixXd shapes_of(const std::vector<coupling::Mode> &modes);

/// Largest and smallest values in a table, and the first charts, for a notebook.
std::string notebook_text(const PythonResult &result);

} // namespace gestell::python
