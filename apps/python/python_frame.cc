#include "apps/python/python_frame.h"

#include "apps/python/python_result.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using namespace pybind11::literals;

const char *const motions[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

template <typename Number>
py::array frozen(const py::object &owner, const Number *first, Eigen::Index n)
{
  py::array view(py::dtype::of<Number>(), {py::ssize_t(n)}, {py::ssize_t(sizeof(Number))}, first, owner);
  view.attr("setflags")("write"_a = false);
  return view;
}

std::size_t bytes_of(const fem::SparseMatrix &A)
{
  return std::size_t(A.nonZeros()) * (sizeof(double) + sizeof(int)) + std::size_t(A.cols() + 1) * sizeof(int);
}

const fem::SparseMatrix &sparse(const PythonFullFrame &full, const std::string &name)
{
  if (name == "M")
    return full.frame.M;
  if (name == "B")
    return full.frame.B;
  if (name == "C")
    return full.frame.C;
  throw std::invalid_argument("csc: got '" + name + "'; valid: 'M', 'B', 'C'");
}

py::cpp_function matrix(Eigen::MatrixXd coupling::ReducedFrame::*which)
{
  return {[which](const PythonFrame &frame) -> const Eigen::MatrixXd & { return (*frame.frame).*which; },
          py::return_value_policy::reference_internal};
}

void bind_reduced(py::module_ &module)
{
  constexpr auto view = py::return_value_policy::reference_internal;
  py::class_<PythonFrame, std::shared_ptr<PythonFrame>>(
      module, "Frame", "A reduced frame M q'' + B q' + C q = f, q = (interfaces, modes); its matrices are views.")
      .def_property_readonly("M", matrix(&coupling::ReducedFrame::M), "Mass matrix [n x n], kg.")
      .def_property_readonly("B", matrix(&coupling::ReducedFrame::B), "Damping matrix [n x n], N s/m.")
      .def_property_readonly("C", matrix(&coupling::ReducedFrame::C), "Stiffness matrix [n x n], N/m.")
      .def_property_readonly(
          "T", [](const PythonFrame &frame) -> const Eigen::MatrixXf & { return frame.frame->displacement; }, view,
          "Displacements of the points of the skin per coordinate [3 points x n], m: u = T q; single precision.")
      .def_property_readonly(
          "points", [](const PythonFrame &frame) { return py::array(py::cast(frame.frame->points)); },
          "Points of the skin [points x 3], m.")
      .def_property_readonly(
          "triangles", [](const PythonFrame &frame) { return py::array(py::cast(frame.frame->triangles)); },
          "Triangles of the skin [triangles x 3], numbers of points.")
      .def_property_readonly("coordinates", &PythonFrame::coordinates, "Names of rows: interfaces first, then modes.")
      .def_property_readonly(
          "n_interface", [](const PythonFrame &frame) { return frame.frame->n_interface; },
          "Number of interface DOFs, which come first.")
      .def_property_readonly(
          "n_full", [](const PythonFrame &frame) { return frame.frame->n_full; },
          "Number of DOFs of the unreduced frame.")
      .def_property_readonly(
          "mass", [](const PythonFrame &frame) { return frame.frame->mass; }, "Mass of the frame [kg].")
      .def_property_readonly(
          "notes", [](const PythonFrame &frame) { return frame.frame->all_notes(); }, "Warnings of the reduction.")
      .def_property_readonly(
          "statements", [](const PythonFrame &frame) { return frame.frame->statements; },
          "Checks of the reduction that passed.")
      .def_property_readonly(
          "frequencies_hz",
          [](const PythonFrame &frame) -> const Eigen::VectorXd & { return frame.frame->frequencies_hz; }, view,
          "Natural frequencies of the frame alone, interface free [Hz].")
      .def("__repr__",
           [](const PythonFrame &frame)
           {
             return py::str("<gestell.Frame of {:.6g} kg: {} coordinates for {}>")
                 .format(frame.frame->mass, frame.frame->M.rows(), frame.frame->n_full);
           });
}

void bind_full(py::module_ &module)
{
  py::class_<PythonFullFrame, std::shared_ptr<PythonFullFrame>>(
      module, "FullFrame", "An assembled frame M q'' + B q' + C q = f: sparse matrices, not reduced.")
      .def(
          "csc",
          [](const py::object &full, const std::string &name)
          { return csc_views(full, sparse(full.cast<const PythonFullFrame &>(), name)); },
          "name"_a,
          "M [kg], B [N s/m] or C [N/m] by columns: (values, rows, begins of columns, n), views of the frame's memory.")
      .def_property_readonly(
          "n", [](const PythonFullFrame &full) { return full.frame.M.rows(); }, "Number of coordinates.")
      .def_property_readonly("nbytes", &PythonFullFrame::nbytes, "Memory of M, B and C [byte].")
      .def_property_readonly("interfaces", &PythonFullFrame::interface_rows,
                             "Rows of each interface, from 0: {\"crown\": {\"ux\": 17, ...}}; fixed DOFs are omitted.")
      .def_property_readonly(
          "translations", [](const PythonFullFrame &full) { return full.frame.translations; },
          "q of unit translations of the whole frame [n x 3].")
      .def_property_readonly(
          "mass", [](const PythonFullFrame &full) { return full.frame.mass; }, "Mass of the frame [kg].")
      .def_property_readonly(
          "notes", [](const PythonFullFrame &full) { return full.frame.notes; }, "Remarks about mesh and assembly.")
      .def("__repr__",
           [](const PythonFullFrame &full)
           {
             return py::str("<gestell.FullFrame of {} coordinates, {:.3g} MB>")
                 .format(full.frame.M.rows(), 1e-6 * double(full.nbytes()));
           });
}

} // namespace

std::vector<std::string> PythonFrame::coordinates() const
{
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < frame->M.rows(); ++i)
    names.push_back((i < frame->n_interface ? "coordinate " : "mode ") +
                    std::to_string(i < frame->n_interface ? i + 1 : i - frame->n_interface + 1));
  for (const fem::Interface &interface : frame->interfaces)
    for (int m = 0; m < 6; ++m)
      if (interface.coordinate[m] >= 0)
        names[std::size_t(interface.coordinate[m])] = "frame." + interface.name + "." + motions[m];
  return names;
}

py::dict PythonFullFrame::interface_rows() const
{
  py::dict all;
  for (const fem::Interface &interface : frame.interfaces)
  {
    py::dict rows;
    for (int m = 0; m < 6; ++m)
      if (interface.coordinate[m] >= 0)
        rows[motions[m]] = interface.coordinate[m];
    all[py::str(interface.name)] = rows;
  }
  return all;
}

std::size_t PythonFullFrame::nbytes() const
{
  return bytes_of(frame.M) + bytes_of(frame.B) + bytes_of(frame.C);
}

py::tuple csc_views(const py::object &owner, const fem::SparseMatrix &matrix)
{
  return py::make_tuple(frozen(owner, matrix.valuePtr(), matrix.nonZeros()),
                        frozen(owner, matrix.innerIndexPtr(), matrix.nonZeros()),
                        frozen(owner, matrix.outerIndexPtr(), matrix.cols() + 1), matrix.rows());
}

void bind_frames(py::module_ &module)
{
  bind_reduced(module);
  bind_full(module);
}

} // namespace gestell::python
