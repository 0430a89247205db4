#pragma once

#include "apps/scene/language/quantity.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <typeinfo>
#include <vector>

namespace gestell::apps
{

class SceneTable;
struct Key;

// Reads the value of a key into a member: number, optional number, vector or direction, boolean, integer.
void        read_into(double &member, const SceneTable &table, const Key &key, bool on_angle);
void        read_into(std::array<double, 3> &member, const SceneTable &table, const Key &key, bool on_angle);
void        read_into(bool &member, const SceneTable &table, const Key &key, bool on_angle);
void        read_into(int &member, const SceneTable &table, const Key &key, bool on_angle);
std::size_t chosen(const SceneTable &table, const Key &key); ///< index of the choice
template <class Member>
void read_into(std::optional<Member> &member, const SceneTable &table, const Key &key, bool on_angle)
{
  read_into(member.emplace(), table, key, on_angle);
}

/**
 * The type of a key of a table, and the member that stores its value.  Its reader (SceneTable::fill()), `gestell help`,
 * the schema for editors and the tables of docs/reference/scene are generated from it:
 *
 *     key::number("stiffness", kind::stiffness, "of the rope")
 *         .on_angle(kind::torsional_stiffness)
 *         .above_zero()
 *         .into(&Rope::Parameters::stiffness)
 */
struct Key
{
  enum class Form
  {
    number,      ///< or a string with a unit
    formula,     ///< or a number
    profile,     ///< level or ramps
    course,      ///< a profile, or a function of time
    truth,       ///< true or false
    choice,      ///< one of `choices`
    name,        ///< of a body, an interface, a marker, a measure
    direction,   ///< [x, y, z], of any length
    vector,      ///< [x, y, z] of a kind
    rows,        ///< of two values
    tables,      ///< array of tables of `keys`
    coefficient, ///< number, or a table of `keys`
    whole,       ///< an integer
    quantity,    ///< value of any kind with its unit
    numbers,     ///< array of a kind
    matrix,      ///< rows of a kind
    text,
    texts, ///< a string, or an array of them
    file,  ///< path of a file
    table, ///< of `keys`; without any: tables that are declared separately
    map    ///< table whose keys are names, in addition to `keys`
  };
  enum class Range
  {
    any,
    above_zero,
    from_zero,
    share ///< above 0, at most 1
  };

  std::string              name;
  Form                     form = Form::number;
  std::vector<Form>        others{}; ///< that are accepted as well
  std::string              meaning;  ///< one clause; further sentences, in Markdown, if required
  Kind                     kind = kind::number;
  std::optional<Kind>      angular; ///< kind if the motion is an angle
  Range                    range    = Range::any;
  bool                     demanded = true;
  std::optional<double>    fallback;     ///< SI
  std::string              otherwise;    ///< text: the default of a key without a numerical one
  std::vector<std::string> choices{};    ///< the first is the default of an optional key
  std::vector<Key>         keys{};       ///< of its tables
  std::string              source{};     ///< key whose value is the default
  std::string              substitute{}; ///< key with the same information, so that this one is not read
  std::string              companion{};  ///< key without which this key is unknown

  /// Class of the object with the member, and the function that fills it; null: a reader requests the key by name.
  const std::type_info                                                                     *object = nullptr;
  std::function<void(void *object, const SceneTable &table, const Key &key, bool on_angle)> fill{};

  Key also(const std::vector<Form> &forms) const;
  Key on_angle(const Kind &kind) const;
  /// The same key for a motion that is an angle, with its inner keys.
  Key on_angle(const Key &angular) const;
  Key above_zero() const;
  Key from_zero() const;
  Key as_share() const;
  Key by_default(double value) const;
  Key by_default(const std::string &words) const; ///< "" for no text
  Key same_as(const std::string &key) const;      ///< as default
  Key unless(const std::string &other) const;     ///< read if there is no key `other`, else ignored
  Key only_with(const std::string &other) const;  ///< unknown without the key `other`

  template <class Object, class Member>
  Key into(Member Object::*member) const
  {
    return filling(typeid(Object), [member](void *object, const SceneTable &table, const Key &key, bool on_angle)
                   { read_into(static_cast<Object *>(object)->*member, table, key, on_angle); });
  }
  /// For a choice: the value of each of the choices.
  template <class Object, class Member>
  Key into(Member Object::*member, const std::vector<Member> &meanings) const
  {
    return filling(typeid(Object), [member, meanings](void *object, const SceneTable &table, const Key &key, bool)
                   { static_cast<Object *>(object)->*member = meanings.at(chosen(table, key)); });
  }
  /// As into(); the initial value of the member is the default.
  template <class Object, class Member>
  Key by_default(Member Object::*member) const
  {
    return into(member).by_default(Object().*member);
  }

private:
  Key filling(const std::type_info &type, decltype(fill) filler) const;
};

namespace key
{
Key number(const std::string &name, const Kind &kind, const std::string &meaning);
Key formula(const std::string &name, const Kind &kind, const std::string &meaning);
Key truth(const std::string &name, bool fallback, const std::string &meaning);
/// @param fallback  if true, the first choice is the default
Key choice(const std::string &name, const std::vector<std::string> &choices, bool fallback, const std::string &meaning);
Key named(const std::string &name, const std::string &meaning);
Key direction(const std::string &name, const std::string &meaning);
Key vector(const std::string &name, const Kind &kind, const std::string &meaning);
/// For any form that needs no kind and no keys.
Key plain(const std::string &name, Key::Form form, const std::string &meaning);
Key table(const std::string &name, const std::vector<Key> &keys, const std::string &meaning);
/// @param keys  in addition to the names
Key map(const std::string &name, const Kind &kind, const std::vector<Key> &keys, const std::string &meaning);
/// For any form with inner keys, or with a second kind in the same column.
Key composed(const std::string &name, Key::Form form, const Kind &kind, const std::vector<Key> &keys,
             const std::string &meaning);
} // namespace key

/// All keys of the lists, in order.
std::vector<Key> joined(const std::vector<std::vector<Key>> &lists);

/// The key of that name; null if there is none.
const Key *find_key(const std::vector<Key> &keys, const std::string &name);

} // namespace gestell::apps
