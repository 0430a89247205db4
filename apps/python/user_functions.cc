#include "apps/python/user_functions.h"

#include "apps/scene/file/user_value.h"

#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using namespace pybind11::literals;
using mechanism::Numbers;

/// Objects of Python that C++ shares; threads without the interpreter lock may be the last to release them.
struct Kept
{
  py::object functions; ///< a dict by role
  py::object raised = py::none();
};

std::shared_ptr<Kept> kept(py::object functions)
{
  return {new Kept{std::move(functions)}, [](Kept *own)
          {
            const py::gil_scoped_acquire locked;
            delete own;
          }};
}

void take_numbers(const py::object &result, double *y, int n_y)
{
  const auto refuse = [&](const std::string &needed)
  { throw std::runtime_error("returned " + py::repr(result).cast<std::string>() + "; needs " + needed); };
  if (n_y == 1) // also of NumPy, an array without dimensions
  {
    y[0] = PyFloat_AsDouble(result.ptr());
    if (!PyErr_Occurred())
      return;
    PyErr_Clear();
  }
  const std::string needed = n_y == 1 ? "a number" : std::to_string(n_y) + " numbers";
  if (!PySequence_Check(result.ptr()) || PySequence_Size(result.ptr()) != n_y)
  {
    PyErr_Clear();
    refuse(needed);
  }
  const auto items = py::reinterpret_steal<py::object>(PySequence_Fast(result.ptr(), ""));
  if (items && PySequence_Fast_GET_SIZE(items.ptr()) == n_y)
    for (int i = 0; i < n_y && !PyErr_Occurred(); ++i)
      y[i] = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(items.ptr(), i));
  else if (!PyErr_Occurred())
    refuse(needed);
  if (PyErr_Occurred())
  {
    PyErr_Clear();
    refuse(needed);
  }
}

py::tuple arguments_of(Numbers x, Numbers s)
{
  py::tuple arguments(std::size_t(x.n + (s.n > 0 ? 1 : 0)));
  for (int i = 0; i < x.n; ++i)
    arguments[std::size_t(i)] = py::float_(x.begin[i]);
  if (s.n == 0)
    return arguments;
  py::tuple state(std::size_t(s.n));
  for (int i = 0; i < s.n; ++i)
    state[std::size_t(i)] = py::float_(s.begin[i]);
  arguments[std::size_t(x.n)] = state;
  return arguments;
}

mechanism::UserFunction function_of(const std::shared_ptr<Kept> &own, const char *role)
{
  if (!own->functions.contains(role) || own->functions[role].is_none())
    return {};
  const PyObject *function = py::object(own->functions[role]).ptr(); // kept alive by the dict
  return [own, function](Numbers x, Numbers s, double *y, int n_y)
  {
    const py::gil_scoped_acquire locked;
    try
    {
      const auto result = py::reinterpret_steal<py::object>(
          PyObject_CallObject(const_cast<PyObject *>(function), arguments_of(x, s).ptr()));
      if (!result)
        throw py::error_already_set();
      take_numbers(result, y, n_y);
    }
    catch (const py::error_already_set &error)
    {
      own->raised = error.value();
      if (error.trace())
        own->raised.attr("__traceback__") = error.trace();
      throw std::runtime_error("raised\n" + traceback_text(own->raised));
    }
    catch (const std::runtime_error &wrong)
    {
      own->raised = py::reinterpret_borrow<py::object>(PyExc_TypeError)("the function " + std::string(wrong.what()));
      throw;
    }
  };
}

/// An entry made by Python: what C++ has of it.
struct Entry
{
  std::shared_ptr<apps::UserValue> value;
};

std::string mark_of(const py::handle &function)
{
  return "<function " + py::str(py::getattr(function, "__qualname__", py::repr(function))).cast<std::string>() + ">";
}

Entry law_entry(const py::dict &functions, const std::vector<double> &state, const std::vector<std::string> &events)
{
  const auto own    = kept(functions);
  auto       law    = std::make_shared<mechanism::UserLaw>();
  law->force        = function_of(own, "force");
  law->derivative   = function_of(own, "derivative");
  law->state        = state;
  law->events       = events;
  law->event_values = function_of(own, "event_values");
  law->at_event     = function_of(own, "at_event");
  law->after_step   = function_of(own, "after_step");
  auto value        = std::make_shared<apps::UserValue>();
  value->mark       = mark_of(functions["force"]);
  value->law        = law;
  value->origin     = own;
  return {value};
}

Entry signal_entry(const py::object &function, const std::vector<std::string> &of, const std::string &unit)
{
  const auto own   = kept(py::dict("value"_a = function));
  auto       value = std::make_shared<apps::UserValue>();
  value->mark      = mark_of(function);
  value->signal = std::make_shared<mechanism::UserSignal>(mechanism::UserSignal{function_of(own, "value"), of, unit});
  value->origin = own;
  return {value};
}

} // namespace

void bind_user_functions(py::module_ &module)
{
  py::class_<Entry>(module, "Function", "A function of Python as the value of a scene key.")
      .def_static("law", &law_entry, "functions"_a, "state"_a, "events"_a)
      .def_static("signal", &signal_entry, "function"_a, "of"_a, "unit"_a)
      .def("__repr__", [](const Entry &entry) { return entry.value->mark; });
}

bool fill_function_node(py::handle value, apps::SceneNode &node)
{
  if (!py::isinstance<Entry>(value))
    return false;
  node.type = apps::SceneNode::Type::function;
  node.user = value.cast<const Entry &>().value;
  node.text = node.user->mark;
  return true;
}

py::object function_object(const apps::SceneNode &node)
{
  return py::cast(Entry{std::const_pointer_cast<apps::UserValue>(node.user)});
}

std::string traceback_text(const py::object &error)
{
  const py::object lines = py::module_::import("traceback")
                               .attr("format_exception")(py::type::of(error), error, error.attr("__traceback__"));
  auto text = py::str("").attr("join")(lines).cast<std::string>();
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

py::object take_raised(const apps::SceneNode &root)
{
  py::object raised = py::none();
  if (root.user)
  {
    auto &own = *std::static_pointer_cast<Kept>(root.user->origin);
    std::swap(raised, own.raised);
  }
  for (const auto &[key, entry] : root.entries)
    if (py::object inner = take_raised(entry); !inner.is_none())
      raised = std::move(inner);
  return raised;
}

} // namespace gestell::python
