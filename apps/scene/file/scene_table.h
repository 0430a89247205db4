#pragma once

#include "apps/scene/file/declaration.h"
#include "apps/scene/file/parameters.h"
#include "apps/scene/file/scene_node.h"
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
 * A table of a scene as its readers see it: every getter names the key and what it must be, and leaves a mark, so that
 * finish() can tell which keys nobody knows.
 *
 * Getters throw std::invalid_argument: "press.toml:12: body.crank.inertia: needs a moment of inertia such as
 * "250 kg m^2", got ...".  Those without a fallback demand the key.
 */
class SceneTable
{
public:
  /// @param path  of the table in the scene, "body.crank"; "" for the scene itself.
  SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path);

  /// The same table, whose keys are `keys` and no others.  They must outlive it.
  SceneTable declared(const std::vector<Key> &keys) const;

  bool has(const std::string &key) const; ///< marks the key as known
  bool declares(const std::string &key) const { return keys_ && find_key(*keys_, key); }
  bool demands(const std::string &key) const { return declaration(key).demanded; }

  // Of declared keys: kind, range, choices and default are those of the declaration.

  /// Gives the members of `object` that keys go into (Key::into()) their values; those of keys that are left out and
  /// have no default as a number keep theirs.
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
  void demand(std::initializer_list<const char *> numbers, bool on_angle = false) const; ///< that may else be left out
  /// @param otherwise  in place of a default
  double      value_or(const std::string &key, double otherwise, bool on_angle = false) const;
  std::string choice(const std::string &key) const;
  bool        truth(const std::string &key) const;
  int         whole(const std::string &key) const;
  Vector3     vector(const std::string &key) const;
  Vector3     vector_or(const std::string &key, const std::array<double, 3> &otherwise) const;

  double number(const std::string &key, const Kind &kind) const;
  double number(const std::string &key, const Kind &kind, double fallback) const;
  /// A value of any kind, whose dimension the caller judges.
  Quantity quantity(const std::string &key) const;
  /// As number(), and must be > 0 or >= 0.
  double positive(const std::string &key, const Kind &kind) const;
  double positive(const std::string &key, const Kind &kind, double fallback) const;
  double not_negative(const std::string &key, const Kind &kind) const;
  double not_negative(const std::string &key, const Kind &kind, double fallback) const;

  /// A part of a whole, above 0 and at most 1: 0.15 or "15 %"; who writes 15 means percent.
  double share(const std::string &key) const;

  /// A formula of `variables`, or a value.
  mechanism::Formula formula(const std::string &key, const std::vector<Variable> &variables, const Kind &kind) const;

  int  integer(const std::string &key, int fallback) const;
  bool boolean(const std::string &key, bool fallback) const;

  std::string              text(const std::string &key) const;
  std::string              text(const std::string &key, const std::string &fallback) const;
  std::string              choice(const std::string &key, const std::vector<std::string> &valid,
                                  const std::string &fallback) const; ///< fallback "": demanded
  std::vector<std::string> texts(const std::string &key) const;       ///< one text or an array of them
  std::string              file(const std::string &key) const;        ///< absolute path of a file that exists

  Vector3                          vector(const std::string &key, const Kind &kind) const;
  Vector3                          direction(const std::string &key) const; ///< made a unit vector
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

  bool is_text(const std::string &key) const;
  bool is_array(const std::string &key) const;
  bool is_matrix(const std::string &key) const; ///< an array of arrays
  bool is_table(const std::string &key) const;

  const std::string &path() const { return path_; }
  std::string        name() const;  ///< own name: last segment of the path
  std::string        place() const; ///< "press.toml:12: body.crank"
  std::string        place(const std::string &key) const;

  std::invalid_argument error(const std::string &what) const;
  std::invalid_argument error(const std::string &key, const std::string &what) const;

  /// Notes what is allowed and probably not meant, for the user to read.
  void                            warn(const std::string &key, const std::string &what) const;
  const std::vector<std::string> &warnings() const { return *warnings_; } ///< of the whole scene

  /// Refuses keys nobody asked for, here and in all tables below that were read; call after reading everything.
  void finish() const;

private:
  using Warnings = std::shared_ptr<std::vector<std::string>>; ///< shared by all tables of a scene
  SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path, const std::string &name,
             const Warnings &warnings);
  void fill(void *object, const std::type_info &type, bool on_angle) const;
  /// Of tables of a declared key the keys are declared, too.
  SceneTable inner(SceneTable table, const std::string &key) const;
  SceneTable below(const SceneNode &node, const std::string &path, const std::string &name) const;
  /// @throws std::logic_error for a key that a table with declared ones has not.
  const SceneNode *look_up(const std::string &key) const;
  const Key       &declaration(const std::string &key) const;
  const SceneNode &demand(const std::string &key, const std::string &what) const;
  std::string      path_of(const std::string &key) const;
  double           evaluate(const std::string &key, const SceneNode &value, const Kind &kind) const;
  /// A value or a formula of `variables` of that kind.
  mechanism::Formula expression(const std::string &key, const SceneNode &value, const std::vector<Variable> &variables,
                                const Kind &kind) const;
  bool               is_formula_of_time(const SceneNode &value, const Kind &kind) const; ///< if there were a variable t

  const SceneNode  *node_;
  const Parameters *parameters_;
  std::string       path_, name_;
  Warnings          warnings_;

  const std::vector<Key> *keys_ = nullptr; ///< null: any key may be asked for
  bool                    open_ = false;   ///< so may others beside `keys_`, which are names
};

} // namespace gestell::apps
