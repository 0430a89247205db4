#pragma once

#include "apps/scene/file/declaration.h"
#include "apps/scene/file/parameters.h"
#include "apps/scene/file/scene_node.h"
#include "apps/scene/file/user_value.h"
#include "apps/scene/language/quantity.h"

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

using Vector3 = std::array<double, 3>;

/**
 * A table of a scene for its readers: every getter specifies the key and its type, and marks it as used, so that
 * finish() finds unknown keys.
 *
 * Getters throw std::invalid_argument: "press.toml:12: body.crank.inertia: needs a moment of inertia such as "250 kg
 * m^2", got ...".  For getters without a fallback the key is required.
 */
class SceneTable
{
public:
  /// @param path  of the table in the scene, "body.crank"; "" for the scene itself.
  SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path);

  /// The same table with exactly the keys `keys`, which must outlive it.
  SceneTable declared(const std::vector<Key> &keys) const;

  bool has(const std::string &key) const; ///< marks the key as known
  bool declares(const std::string &key) const { return keys_ && find_key(*keys_, key); }
  bool demands(const std::string &key) const { return declaration(key).demanded; }

  // For declared keys: kind, range, choices and default are those of the declaration.

  /// Fills the members of `object` that keys are bound to (Key::into()); members of missing keys without a numerical
  /// default are unchanged.
  template <class Object>
  void fill(Object &object, bool on_angle = false) const
  {
    fill(&object, typeid(Object), on_angle);
  }
  template <class Object>
  Object filled(bool on_angle = false) const
  {
    Object object;
    fill(object, on_angle);
    return object;
  }

  double value(const std::string &key, bool on_angle = false) const;
  void   demand(std::initializer_list<const char *> numbers, bool on_angle = false) const; ///< requires optional keys
  /// @param otherwise  replaces a default
  double      value_or(const std::string &key, double otherwise, bool on_angle = false) const;
  std::string choice(const std::string &key) const;
  bool        truth(const std::string &key) const;
  int         whole(const std::string &key) const;
  Vector3     vector(const std::string &key) const;
  Vector3     vector_or(const std::string &key, const std::array<double, 3> &otherwise) const;

  double number(const std::string &key, const Kind &kind) const;
  double number(const std::string &key, const Kind &kind, double fallback) const;
  /// A value of any kind, whose dimension the caller checks.
  Quantity quantity(const std::string &key) const;
  /// Like number(), but the value must be > 0 or >= 0.
  double positive(const std::string &key, const Kind &kind) const;
  double positive(const std::string &key, const Kind &kind, double fallback) const;
  double not_negative(const std::string &key, const Kind &kind) const;
  double not_negative(const std::string &key, const Kind &kind, double fallback) const;

  /// A share above 0 and at most 1: 0.15 or "15 %"; for 15 the message proposes percent.
  double share(const std::string &key) const;

  /// A formula of `variables`, or a value.
  mechanism::Formula formula(const std::string &key, const std::vector<Variable> &variables, const Kind &kind) const;

  int  integer(const std::string &key, int fallback) const;
  bool boolean(const std::string &key, bool fallback) const;

  std::string              text(const std::string &key) const;
  std::string              text(const std::string &key, const std::string &fallback) const;
  std::string              choice(const std::string &key, const std::vector<std::string> &valid,
                                  const std::string &fallback) const; ///< fallback "": required
  std::vector<std::string> texts(const std::string &key) const;       ///< one string or an array of them
  std::string              file(const std::string &key) const;        ///< absolute path of an existing file

  Vector3                          vector(const std::string &key, const Kind &kind) const;
  Vector3                          direction(const std::string &key) const; ///< normalised to a unit vector
  Vector3                          direction(const std::string &key, const Vector3 &fallback) const;
  std::vector<double>              numbers(const std::string &key, const Kind &kind) const;
  std::vector<std::vector<double>> matrix(const std::string &key, const Kind &kind) const; ///< rows of equal length
  /// Rows of two values of different kinds, [["0 s", "3 kN"], ["1 s", 0]].
  std::vector<std::array<double, 2>> pairs(const std::string &key, const Kind &first, const Kind &second) const;

  SceneTable                table(const std::string &key) const;
  std::optional<SceneTable> optional_table(const std::string &key) const;
  /// Tables in table `key`, in the order of the file: [body.crank], [body.slide]; none if there is no `key`.
  std::vector<SceneTable> tables(const std::string &key) const;
  /// The tables of an array, [{ amplitude = 1 }, { amplitude = 2 }]; none if there is no `key`.
  std::vector<SceneTable> table_array(const std::string &key) const;
  /// Keys of this table in the order of the file.
  std::vector<std::string> keys() const;

  /// The function of the calling program that the entry is; null: it is none.
  std::shared_ptr<const UserValue> user_value(const std::string &key) const;

  bool is_text(const std::string &key) const;
  bool is_array(const std::string &key) const;
  bool is_matrix(const std::string &key) const; ///< an array of arrays
  bool is_table(const std::string &key) const;

  const std::string &path() const { return path_; }
  std::string        name() const;  ///< own name: last segment of the path
  /// "press.toml:12: body.crank"; with keys from the command line "press.toml:12: body.crank: with --set ..."
  std::string        place() const;
  std::string        place(const std::string &key) const;

  std::invalid_argument error(const std::string &what) const;
  std::invalid_argument error(const std::string &key, const std::string &what) const;

  /// Adds a warning about valid but suspicious input.
  void                            warn(const std::string &key, const std::string &what) const;
  const std::vector<std::string> &warnings() const { return *warnings_; } ///< of the whole scene

  /// Rejects keys that no reader requested, here and in all inner tables that were read; call after reading everything.
  void finish() const;

private:
  using Warnings = std::shared_ptr<std::vector<std::string>>; ///< shared by all tables of a scene
  SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path, const std::string &name,
             const Warnings &warnings);
  void fill(void *object, const std::type_info &type, bool on_angle) const;
  /// Inner tables of a declared key have declared keys, too.
  SceneTable inner(SceneTable table, const std::string &key) const;
  SceneTable below(const SceneNode &node, const std::string &path, const std::string &name) const;
  /// @throws std::logic_error for a key that is not declared, in a table with declared keys.
  const SceneNode *look_up(const std::string &key) const;
  const Key       &declaration(const std::string &key) const;
  const SceneNode &demand(const std::string &key, const std::string &what) const;
  std::string      path_of(const std::string &key) const;
  double           evaluate(const std::string &key, const SceneNode &value, const Kind &kind) const;
  /// A value or a formula of `variables` of that kind.
  mechanism::Formula expression(const std::string &key, const SceneNode &value, const std::vector<Variable> &variables,
                                const Kind &kind) const;
  bool               is_formula_of_time(const SceneNode &value, const Kind &kind) const; ///< valid with variable t

  const SceneNode  *node_;
  const Parameters *parameters_;
  std::string       path_, name_;
  Warnings          warnings_;

  const std::vector<Key> *keys_ = nullptr; ///< null: any key may be requested
  bool                    open_ = false;   ///< keys other than `keys` are allowed: names
};

} // namespace gestell::apps
