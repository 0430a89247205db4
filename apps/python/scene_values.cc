#include "apps/python/scene_values.h"

#include "apps/python/user_functions.h"

#include <cmath>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using apps::Place;
using apps::SceneNode;
using Type = SceneNode::Type;

/// How deep node_of() is in itself.
class Depth
{
public:
  Depth() { ++now(); }
  ~Depth() { --now(); }
  Depth(const Depth &)            = delete;
  Depth &operator=(const Depth &) = delete;

  static int &now()
  {
    thread_local int depth = 0;
    return depth;
  }
};

/// The value as Python writes it, truncated if long.
std::string written(py::handle value)
{
  constexpr std::size_t longest = 80; // a line of a message
  std::string           text    = py::repr(value).cast<std::string>();
  if (text.size() > longest)
    text = text.substr(0, longest) + "...";
  return text;
}

[[noreturn]] void refuse(const SceneNode &node, const std::string &key, const std::string &what)
{
  node.place.fail((key.empty() ? "" : key + ": ") + what);
}

SceneNode number_node(SceneNode node, const std::string &key, py::handle value)
{
  const bool whole = py::isinstance<py::int_>(value) || py::hasattr(value, "__index__");
  node.type        = whole ? Type::integer : Type::real;
  node.number      = PyFloat_AsDouble(value.ptr());
  const bool fits  = PyErr_Occurred() == nullptr;
  PyErr_Clear();
  if (!fits || !std::isfinite(node.number))
    refuse(node, key, "got " + written(value) + ", needs a finite number of double precision");
  node.text = whole ? py::str(py::int_(py::reinterpret_borrow<py::object>(value))).cast<std::string>()
                    : py::repr(py::float_(node.number)).cast<std::string>();
  return node;
}

SceneNode table_node(SceneNode node, const std::string &key, const py::dict &values)
{
  for (const auto &[own, value] : values)
  {
    if (!py::isinstance<py::str>(own))
      refuse(node, key, "got the key " + py::repr(own).cast<std::string>() + "; keys of a scene are strings");
    const auto name = own.cast<std::string>();
    node.entries.emplace_back(
        name, node_of(value, node.place, node.folder, (key.empty() ? "" : key + ".") + apps::written_key(name)));
  }
  return node;
}

SceneNode array_node(SceneNode node, const std::string &key, py::handle values)
{
  node.type = Type::array;
  for (const py::handle &value : values)
    node.elements.push_back(node_of(value, node.place, node.folder, key));
  return node;
}

} // namespace

SceneNode node_of(py::handle value, const Place &place, const std::string &folder, const std::string &key)
{
  const Depth depth;
  SceneNode   node;
  node.place            = place;
  node.folder           = folder;
  constexpr int deepest = 50; // dicts and lists in each other, as tables and arrays of a file
  if (Depth::now() > deepest)
    refuse(node, "",
           "dicts and lists are nested more than " + std::to_string(deepest) + " deep; does one contain itself?");
  if (py::isinstance<py::dict>(value))
    return table_node(node, key, py::reinterpret_borrow<py::dict>(value));
  if (fill_function_node(value, node))
    return node;
  if (py::isinstance<py::bool_>(value))
  {
    node.type    = Type::boolean;
    node.boolean = value.cast<bool>();
    node.text    = node.boolean ? "true" : "false";
    return node;
  }
  if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__"))
  {
    node.type            = Type::text;
    const py::str text   = py::str(value);
    Py_ssize_t    length = 0;
    const char   *bytes  = PyUnicode_AsUTF8AndSize(text.ptr(), &length);
    PyErr_Clear();
    if (bytes == nullptr)
      refuse(node, key, "got " + py::repr(py::repr(value)).cast<std::string>() + ", which is not Unicode text");
    node.text.assign(bytes, std::size_t(length));
    return node;
  }
  if (py::hasattr(value, "tolist")) // of NumPy
  {
    const py::object plain = value.attr("tolist")();
    return py::hasattr(plain, "tolist") ? node : node_of(plain, place, folder, key);
  }
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value))
    return number_node(node, key, value);
  if (py::isinstance<py::sequence>(value))
    return array_node(node, key, value);
  if (PyCallable_Check(value.ptr()))
    refuse(node, key,
           "got the function " + written(value) +
               "; a force law is given by scene.element(NAME, force=..., derivative=...), a signal by "
               "scene.signal(NAME, function, of=[...], unit=...)");
  refuse(node, key,
         "got " + written(value) + " of type " + py::str(py::type::of(value).attr("__name__")).cast<std::string>() +
             "; a scene value is a number, a string with a unit, True or False, a list or a dict");
}

py::object value_of(const SceneNode &node)
{
  switch (node.type)
  {
  case Type::table:
  {
    py::dict table;
    for (const auto &[key, value] : node.entries)
      table[py::str(key)] = value_of(value);
    return table;
  }
  case Type::array:
  {
    py::list list;
    for (const SceneNode &element : node.elements)
      list.append(value_of(element));
    return list;
  }
  case Type::function:
    return function_object(node);
  case Type::boolean:
    return py::bool_(node.boolean);
  case Type::integer:
    return py::int_(static_cast<long long>(node.number));
  case Type::real:
    return py::float_(node.number);
  default:
    return py::str(node.text);
  }
}

} // namespace gestell::python
