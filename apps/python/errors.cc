#include "apps/python/errors.h"

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace gestell::python
{
namespace
{

namespace py = pybind11;

const char *const segment = "(?:[A-Za-z0-9_-]+|\"[^\"]+\")";

/// The key at the start of a message, and the key that is unknown or missing there.
std::string key_at_begin(const std::string &text)
{
  static const std::regex path(std::string("^(") + segment + "(?:\\." + segment + ")*): ");
  static const std::regex own("^(?:unknown key|the key) '([^']+)'");
  std::smatch             found;
  std::string             key, rest = text;
  if (std::regex_search(text, found, path))
  {
    key  = found[1];
    rest = found.suffix();
  }
  if (std::regex_search(rest, found, own))
    key += (key.empty() ? "" : ".") + found[1].str();
  return key;
}

py::object exception_type(const char *name, const char *text, py::handle base)
{
  return py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(name, text, base.ptr(), nullptr));
}

void raise_at(const py::object &type, const char *message, const MessagePlace &place)
{
  py::object error   = type(message);
  error.attr("file") = place.file.empty() ? py::object(py::none()) : py::object(py::str(place.file));
  error.attr("line") = place.line == 0 ? py::object(py::none()) : py::object(py::int_(place.line));
  error.attr("key")  = place.key.empty() ? py::object(py::none()) : py::object(py::str(place.key));
  PyErr_SetObject(type.ptr(), error.ptr());
}

} // namespace

MessagePlace place_of(const std::string &message)
{
  static const std::regex entry("^scene\\[\"(.*?)\"\\](?::(\\d+))?: "), with_line("^([^\\n]*?):(\\d+): "),
      whole("^(scene|signals|[^:\\n]*[.]toml): ");
  std::smatch  found;
  MessagePlace place;
  place.of_scene = true;
  if (std::regex_search(message, found, entry))
  {
    place.key = key_at_begin(found.suffix());
    if (place.key.empty())
      place.key = found[1];
    return place;
  }
  if (std::regex_search(message, found, with_line))
    place.line = std::stoi(found[2].str().substr(0, 9));
  else if (!std::regex_search(message, found, whole))
    return {};
  if (found[1] != "scene" && found[1] != "signals")
    place.file = found[1];
  place.key = key_at_begin(found.suffix());
  return place;
}

std::string in_python(std::string message)
{
  static const std::regex option("(^|[ (])--([a-z]+)(-[a-z]+)?");
  if (message.find("gestell ") != std::string::npos) // a line to type
    return message;
  std::string reported;
  for (std::smatch found; std::regex_search(message, found, option); message = std::string(found.suffix()))
  {
    std::string name = found[2].str() + found[3].str();
    std::replace(name.begin(), name.end(), '-', '_');
    reported += found.prefix().str() + found[1].str() + (name == "from" ? "from_" : name);
  }
  return reported + message;
}

void bind_errors(py::module_ &module)
{
  static py::object input =
      exception_type("gestell.InputError", "Wrong input; the message gives location, value, requirement and remedy.",
                     PyExc_ValueError);
  static py::object scene = exception_type("gestell.SceneError",
                                           "Error in a scene: `file` (None: it is none), `line` (None: of "
                                           "the whole) and `key`, \"element.rod.stiffness\" (None: none is named).",
                                           input);
  static py::object failed =
      exception_type("gestell.ComputationFailed",
                     "The computation failed; `result` contains the results so far, or None.", PyExc_RuntimeError);
  for (const py::object *type : {&input, &scene, &failed})
    type->inc_ref(); // for as long as the interpreter runs
  failed.attr("result")            = py::none();
  module.attr("InputError")        = input;
  module.attr("SceneError")        = scene;
  module.attr("ComputationFailed") = failed;
  py::register_exception_translator(
      [](std::exception_ptr error)
      {
        try
        {
          if (error)
            std::rethrow_exception(error);
        }
        catch (const py::builtin_exception &)
        {
          throw;
        }
        catch (const std::invalid_argument &wrong)
        {
          const std::string  text  = in_python(wrong.what());
          const MessagePlace place = place_of(text);
          if (place.of_scene)
            raise_at(scene, text.c_str(), place);
          else
            PyErr_SetString(input.ptr(), text.c_str());
        }
        catch (const std::bad_alloc &)
        {
          PyErr_SetString(PyExc_MemoryError,
                          "out of memory: take a coarser mesh (mesh.size), fewer modes (reduction.modes), larger "
                          "output intervals (output.step, output.picture_step, output.stress.step), or a "
                          "machine with more memory");
        }
        catch (const std::runtime_error &none)
        {
          PyErr_SetString(failed.ptr(), none.what());
        }
      });
}

py::object computation_failed(const std::string &why)
{
  return py::module_::import("_gestell").attr("ComputationFailed")(why);
}

void raise_if_it_ends_the_program(const py::object &raised)
{
  if (raised.is_none() || PyObject_IsInstance(raised.ptr(), PyExc_Exception) == 1)
    return;
  PyErr_SetObject(reinterpret_cast<PyObject *>(Py_TYPE(raised.ptr())), raised.ptr());
  throw py::error_already_set();
}

} // namespace gestell::python
