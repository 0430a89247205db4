#include "tests/support/moved_scene.h"

#include "apps/scene/file/parameters.h"
#include "coupling/machine/machine.h"
#include "tests/support/node_values.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>

namespace gestell::tests
{
namespace
{

using apps::SceneNode;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Type = SceneNode::Type;

enum class Vector
{
  point,
  polar,
  axial
};

std::string type_of(const SceneNode &table)
{
  const SceneNode *type = table.find("type");
  return type ? type->text : "";
}

/// What the three values of a key are; nothing: no vector in space.
std::optional<Vector> kind_of(const std::string &table, const std::string &type, const std::string &key)
{
  static const std::set<std::string> points{"at", "at_from", "at_to", "through", "position", "unbalance_position"};
  static const std::set<std::string> polars{"direction", "zero", "towards", "axis_from", "axis_to"};
  static const std::set<std::string> turn_about{"rotor", "revolute", "gear mesh", "journal bearing",
                                                "belt",  "chain",    "gear pair", "rolling bearing"};
  if (points.count(key))
    return Vector::point;
  if (polars.count(key))
    return Vector::polar;
  if (key == "about" || (key == "normal" && table == "body"))
    return Vector::axial;
  if (key == "normal")
    return Vector::polar;
  if (key == "axis")
    return turn_about.count(type) ? Vector::axial : Vector::polar;
  return {};
}

class Mover
{
public:
  Mover(const SceneNode &scene, const RigidMotion &motion)
      : motion_(motion), random_(motion.seed), parameters_(scene.find("parameters")), restated_{scene, {}}
  {
  }

  Restated moved()
  {
    SceneNode &scene = restated_.scene;
    if (SceneNode *gravity = scene.find("gravity"))
      *gravity = vector(*gravity, Vector::polar, " m/s^2");
    move_start(); // of bodies as they were
    move_signals();
    if (SceneNode *frame = scene.find("frame"))
      move_frame(*frame);
    for (const std::string kind : {"body", "joint", "measure", "place", "element"})
      if (SceneNode *tables = scene.find(kind))
        for (auto &[name, table] : tables->entries)
          move(kind, name, table);
    return std::move(restated_);
  }

private:
  Matrix3d matrix(Vector kind) const
  {
    return kind == Vector::axial && motion_.mirrors() ? Matrix3d(-motion_.R) : motion_.R;
  }

  // --- values

  double between_minus_1_and_1() { return 2. * double(random_()) / 4294967295. - 1.; }

  SceneNode vector(const SceneNode &value, Vector kind, const std::string &unit)
  {
    if (value.type != Type::array || value.elements.size() != 3)
      throw std::invalid_argument("moved(): no vector: " + apps::described(value));
    const Matrix3d         R = matrix(kind);
    std::vector<SceneNode> components;
    for (int i = 0; i < 3; ++i)
      components.push_back(
          weighted_sum({{R(i, 0), value.elements[0]}, {R(i, 1), value.elements[1]}, {R(i, 2), value.elements[2]}}, unit,
                       kind == Vector::point ? motion_.shift[i] + motion_.noise * between_minus_1_and_1() : 0.));
    SceneNode moved = array_node(components);
    put_at(moved, value);
    return moved;
  }

  /// Of a table or of nothing but numbers and parameters.
  Vector3d numbers(const SceneNode &value) const
  {
    Vector3d x;
    for (int i = 0; i < 3; ++i)
      x[i] = parameters_.evaluate(value.elements.at(std::size_t(i))).value;
    return x;
  }

  // --- tables

  void move(const std::string &kind, const std::string &name, SceneNode &table)
  {
    const std::string where = kind + "." + name, type = type_of(table);
    refuse(where, type, table);
    if (kind == "body" && type == "rigid")
      move_inertia(table);
    for (auto &[key, value] : table.entries)
      if (const auto vector_kind = kind_of(kind, type, key))
        value = vector(value, *vector_kind, *vector_kind == Vector::point ? " m" : "");
    if (!motion_.shift.isZero(0.))
      move_defaults(kind, type, table);
  }

  void refuse(const std::string &where, const std::string &type, const SceneNode &table) const
  {
    const std::set<std::string> known{"size", "inertia", "principal_axes", "table", "terms", "orders", "speed"};
    for (const auto &[key, value] : table.entries)
    {
      const bool bound = key == "unbalance" || key == "offset" || key == "cad" ||
                         ((key == "stiffness" || key == "damping") && value.type == Type::array) ||
                         (key == "inertia" && type == "point mass") || (type == "screw" && motion_.mirrors());
      if (bound)
        throw std::invalid_argument("moved(): '" + key + "' of " + where + " counts along the global axes");
      const bool may_be_vector = value.type == Type::array && value.elements.size() == 3 &&
                                 value.elements[0].type != Type::table && value.elements[0].type != Type::array;
      if (may_be_vector && !known.count(key) && !kind_of(where.substr(0, where.find('.')), type, key))
        throw std::invalid_argument("moved(): nobody has told how '" + key + "' of " + where + " moves");
    }
  }

  /// Moments keep their values about axes that turn; a tensor becomes R J R^T.
  void move_inertia(SceneNode &body)
  {
    SceneNode &inertia = *body.find("inertia");
    if (inertia.elements[0].type == Type::array)
    {
      inertia = transformed_matrix(inertia, motion_.R, " kg m^2");
      return;
    }
    SceneNode  unit_axes = array_node({array_node({number_node(1.), number_node(0.), number_node(0.)}),
                                       array_node({number_node(0.), number_node(1.), number_node(0.)})});
    SceneNode *axes      = body.find("principal_axes");
    if (!axes)
    {
      body.entries.emplace_back("principal_axes", unit_axes);
      axes = body.find("principal_axes");
    }
    for (SceneNode &axis : axes->elements)
      axis = vector(axis, Vector::polar, "");
    put_at(*axes, inertia);
  }

  /// What lies at the origin unless something else is said.
  void move_defaults(const std::string &kind, const std::string &type, SceneNode &table)
  {
    const auto at_origin = [&](const std::string &key)
    {
      SceneNode at =
          array_node({number_node(motion_.shift[0]), number_node(motion_.shift[1]), number_node(motion_.shift[2])});
      put_at(at, table);
      table.entries.emplace_back(key, at);
    };
    if (kind == "body" && (type == "rotor" || type == "slider") && !table.find("position"))
      at_origin("position");
    if ((kind != "joint" && kind != "measure") || type == "angle")
      return;
    for (const std::string end : {"from", "to"})
      if (const SceneNode *marker = table.find(end); marker ? marker->text == "ground" : kind == "measure")
        if (!table.find("at_" + end) && !table.find("at") && !table.find("terms"))
          at_origin("at_" + end);
  }

  // --- frames

  void move_frame(SceneNode &frame)
  {
    if (frame.find("cad") || !frame.find("mass") || frame.find("mass")->type != Type::array || frame.find("cut"))
      throw std::invalid_argument("moved(): the frame has a mesh, a file or a cut");
    const Eigen::MatrixXd T = motions_of_rows(frame);
    for (auto &[key, unit] : {std::pair{"mass", " kg"}, std::pair{"stiffness", " N/m"}, std::pair{"damping", " N s/m"}})
      if (SceneNode *matrix = frame.find(key); matrix && matrix->type == Type::array)
        *matrix = transformed_matrix(*matrix, T, unit);
    if (SceneNode *translations = frame.find("translations"))
      move_translations(*translations, T);
    for (auto &[name, interface] : frame.find("interface")->entries)
      if (SceneNode *position = interface.find("position"))
        *position = vector(*position, Vector::point, " m");
      else if (!motion_.shift.isZero(0.))
        throw std::invalid_argument("moved(): the interface " + name + " has no position");
  }

  /// q of unit translations in x, y, z become those in the directions that these had.
  void move_translations(SceneNode &translations, const Eigen::MatrixXd &T) const
  {
    Eigen::MatrixXd t(T.rows(), 3);
    for (Eigen::Index i = 0; i < T.rows(); ++i)
      t.row(i) = numbers(translations.elements.at(std::size_t(i)));
    t = T * t * motion_.R.transpose();
    for (Eigen::Index i = 0; i < T.rows(); ++i)
      translations.elements[std::size_t(i)] =
          array_node({number_node(t(i, 0)), number_node(t(i, 1)), number_node(t(i, 2))});
  }

  /// q' = T q: rows of an interface are the components of vectors, all others coordinates of modes.
  Eigen::MatrixXd motions_of_rows(const SceneNode &frame) const
  {
    const std::size_t n = frame.find("mass")->elements.size();
    Eigen::MatrixXd   T = Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n));
    for (const auto &[name, interface] : frame.find("interface")->entries)
      for (const char letter : {'u', 'r'})
      {
        std::array<int, 3>    row{-1, -1, -1};
        std::array<double, 3> sign{};
        int                   found = 0;
        for (const auto &[motion, number] : interface.find("rows")->entries)
        {
          const std::string axis = motion[0] == '-' ? motion.substr(1) : motion;
          if (axis[0] != letter)
            continue;
          row[std::size_t(axis[1] - 'x')]  = int(number.number) - 1;
          sign[std::size_t(axis[1] - 'x')] = motion[0] == '-' ? -1. : 1.;
          ++found;
        }
        if (found != 0 && found != 3)
          throw std::invalid_argument("moved(): not all three motions of the interface " + name + " are rows");
        const Matrix3d R = matrix(letter == 'u' ? Vector::polar : Vector::axial);
        for (std::size_t i = 0; found == 3 && i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k)
            T(row[i], row[k]) = sign[i] * sign[k] * R(Eigen::Index(i), Eigen::Index(k));
      }
    for (Eigen::Index i = 0; i < T.rows(); ++i)
      if (T.row(i).isZero(0.))
        T(i, i) = 1.;
    return T;
  }

  // --- the start

  void move_start()
  {
    SceneNode &scene = restated_.scene;
    if (SceneNode *start = scene.find("start"))
      for (const char *key : {"q", "v"})
        if (SceneNode *values = start->find(key))
          move_values(*values, key[0] == 'v' ? "/s" : "");
    if (SceneNode *modes = scene.find("modes"))
      if (SceneNode *values = modes->find("at"))
        move_values(*values, "");
  }

  /// The three, of planar bodies two, coordinates of one vector: their names and directions.
  struct Triple
  {
    std::vector<std::string> names, moved_names;
    std::vector<Vector3d>    directions, moved_directions;
    Vector                   kind;
  };

  static coupling::Vector3 array(const Vector3d &a) { return {a[0], a[1], a[2]}; }
  static Vector3d          vector3(const coupling::Vector3 &a) { return {a[0], a[1], a[2]}; }

  Triple triple_of(const std::string &base, char letter) const
  {
    Triple           triple{{}, {}, {}, {}, letter == 'u' ? Vector::polar : Vector::axial};
    const SceneNode *body = body_of(base);
    if (body && type_of(*body) == "planar")
    {
      const Vector3d normal = numbers(*body->find("normal")).normalized(), turned = matrix(Vector::axial) * normal;
      const auto     own = coupling::plane_across(array(normal)), moved = coupling::plane_across(array(turned));
      triple.directions       = {vector3(own.first), vector3(own.second)};
      triple.moved_directions = {vector3(moved.first), vector3(moved.second)};
      const auto names        = coupling::planar_coordinates(base, array(normal)),
                 moved_names  = coupling::planar_coordinates(base, array(turned));
      triple.names            = {names[0], names[1]};
      triple.moved_names      = {moved_names[0], moved_names[1]};
      return triple;
    }
    for (int d = 0; d < 3; ++d)
    {
      triple.names.push_back(base + "." + letter + "xyz"[d]);
      triple.directions.push_back(Vector3d::Unit(d));
    }
    triple.moved_names      = triple.names;
    triple.moved_directions = triple.directions;
    return triple;
  }

  const SceneNode *body_of(const std::string &name) const
  {
    const SceneNode *bodies = restated_.scene.find("body");
    return bodies ? bodies->find(name) : nullptr;
  }

  void move_values(SceneNode &values, const std::string &per_second)
  {
    SceneNode             rest = values;
    std::set<std::string> done;
    rest.entries.clear();
    for (const auto &[name, value] : values.entries)
    {
      const auto        dot    = name.rfind('.');
      const std::string suffix = dot == std::string::npos ? "" : name.substr(dot + 1);
      const bool        along  = suffix.size() == 2 && std::string("urws").find(suffix[0]) != std::string::npos &&
                         std::string("xyz12").find(suffix[1]) != std::string::npos;
      if (!along)
      {
        rest.entries.emplace_back(name, value);
        continue;
      }
      const Triple triple = triple_of(name.substr(0, dot), suffix[0] == 's' ? 'u' : suffix[0]);
      if (!done.insert(triple.names[0]).second)
        continue;
      for (std::size_t i = 0; i < triple.moved_names.size(); ++i)
      {
        std::vector<std::pair<double, SceneNode>> terms;
        for (std::size_t k = 0; k < triple.names.size(); ++k)
          if (const SceneNode *own = values.find(triple.names[k]))
            terms.emplace_back(triple.moved_directions[i].dot(matrix(triple.kind) * triple.directions[k]), *own);
        SceneNode component = weighted_sum(terms, (triple.kind == Vector::polar ? " m" : " rad") + per_second);
        put_at(component, value);
        rest.entries.emplace_back(triple.moved_names[i], component);
      }
    }
    values = rest;
  }

  // --- signals

  /// Whether its signals along x, y, z are components of vectors.
  bool has_vectors(const std::string &base) const
  {
    const SceneNode *body = body_of(base), *places = restated_.scene.find("place");
    return (body && type_of(*body) != "rotor" && type_of(*body) != "slider") || (places && places->find(base)) ||
           base.rfind("frame.", 0) == 0;
  }

  void move_signals()
  {
    SceneNode *output  = restated_.scene.find("output");
    SceneNode *signals = output ? output->find("signals") : nullptr;
    if (!signals)
      return;
    if (motion_.R.isIdentity(0.) && motion_.shift.isZero(0.)) // noise is no motion of the whole
    {
      for (const auto &entry : signals->entries)
        restated_.signals[entry.first] = {0., {{1., entry.first}}};
      return;
    }
    SceneNode moved = *signals;
    moved.entries.clear();
    for (const auto &[name, signal] : signals->entries)
      move_signal(name, signal, moved);
    *signals = moved;
  }

  void move_signal(const std::string &name, const SceneNode &signal, SceneNode &moved)
  {
    const SceneNode  *inner = signal.type == Type::table ? signal.find("signal") : &signal;
    const bool        minus = inner->text[0] == '-';
    const std::string path  = minus ? inner->text.substr(1) : inner->text;
    const auto        dot   = path.rfind('.');
    const std::string base = path.substr(0, dot), suffix = dot == std::string::npos ? "" : path.substr(dot + 1);
    const SceneNode  *joints = restated_.scene.find("joint");
    const bool of_joint = joints && joints->find(base) && suffix.size() == 2 && (suffix[0] == 'f' || suffix[0] == 'm');
    if (of_joint || suffix == "contact_angle")
      return;
    const auto axis = suffix.find_first_of("xyz");
    if (!has_vectors(base) || axis == std::string::npos || axis > 1 ||
        suffix.substr(0, axis).find_first_not_of("uvarw") != std::string::npos)
    {
      moved.entries.emplace_back(name, signal);
      restated_.signals[name] = {0., {{1., name}}};
      return;
    }
    const Vector   kind = axis == 0                              ? Vector::point
                          : suffix[0] == 'r' || suffix[0] == 'w' ? Vector::axial
                                                                 : Vector::polar;
    const Vector3d row  = (minus ? -1. : 1.) * matrix(kind).col(suffix[axis] - 'x');
    SignalSum      sum;
    if (kind == Vector::point)
      sum.offset = -row.dot(motion_.shift);
    for (int d = 0; d < 3; ++d)
    {
      if (std::abs(row[d]) < 1e-15) // a body in a plane may have no motion there
        continue;
      std::string own                                                  = suffix;
      own[axis]                                                        = "xyz"[d];
      SceneNode entry                                                  = signal;
      (entry.type == Type::table ? *entry.find("signal") : entry).text = base + "." + own;
      moved.entries.emplace_back(name + "~" + "xyz"[d], entry);
      sum.terms.emplace_back(row[d], name + "~" + "xyz"[d]);
    }
    restated_.signals[name] = sum;
  }

  const RigidMotion &motion_;
  std::mt19937       random_;
  apps::Parameters   parameters_;
  Restated           restated_;
};

} // namespace

/// Shoemake's: a quaternion of uniform direction.
Matrix3d random_rotation(unsigned seed)
{
  std::mt19937 random(seed);
  const auto   between_0_and_1 = [&random] { return double(random()) / 4294967296.; };
  const double u = between_0_and_1(), a = 2. * M_PI * between_0_and_1(), b = 2. * M_PI * between_0_and_1();
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1. - u) * std::sin(a),
                            std::sqrt(1. - u) * std::cos(a), std::sqrt(u) * std::sin(b))
      .toRotationMatrix();
}

Restated moved(const SceneNode &scene, const RigidMotion &motion)
{
  return Mover(scene, motion).moved();
}

} // namespace gestell::tests
