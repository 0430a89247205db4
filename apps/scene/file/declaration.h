#pragma once

#include "apps/scene/language/quantity.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * What a key of a table takes.  Its reader, `gestell help`, the schema for editors and the tables of docs/scene are
 * made from it:
 *
 *     key::number("stiffness", kind::stiffness, "of the rope").on_angle(kind::torsional_stiffness).above_zero()
 */
struct Key
{
  enum class Form
  {
    number,      ///< or text with a unit
    formula,     ///< or a number
    profile,     ///< level or ramps
    course,      ///< profile, or a function of time
    truth,       ///< true or false
    choice,      ///< one of `choices`
    name,        ///< of a body, an interface, a place, a measure
    direction,   ///< [x, y, z], of any length
    vector,      ///< [x, y, z] of a kind
    rows,        ///< of two values
    tables,      ///< array of tables of `keys`
    coefficient, ///< number, or a table of `keys`
    whole,       ///< number
    quantity,    ///< value of any kind with its unit
    numbers,     ///< array of a kind
    matrix,      ///< rows of a kind
    text,
    texts, ///< text, or an array of them
    file,  ///< path of one
    table, ///< of `keys`; without any: tables that are declared by themselves
    map    ///< table whose keys are names; besides `keys`
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
  std::vector<Form>        others{}; ///< that it may be written in as well
  std::string              meaning;  ///< one clause; further sentences, in Markdown, where they are needed
  Kind                     kind = kind::number;
  std::optional<Kind>      angular; ///< kind where the motion is an angle
  Range                    range    = Range::any;
  bool                     demanded = true;
  std::optional<double>    fallback;  ///< SI
  std::string              otherwise; ///< what holds without the key, in words
  std::vector<std::string> choices{}; ///< the first is the default of a key that may be left out
  std::vector<Key>         keys{};    ///< of its tables

  Key also(const std::vector<Form> &forms) const;
  Key on_angle(const Kind &kind) const;
  /// The same key where the motion is an angle, with its inner ones.
  Key on_angle(const Key &angular) const;
  Key above_zero() const;
  Key from_zero() const;
  Key as_share() const;
  Key by_default(double value) const;
  Key by_default(const std::string &words) const; ///< "" for nothing to tell
};

namespace key
{
Key number(const std::string &name, const Kind &kind, const std::string &meaning);
Key formula(const std::string &name, const Kind &kind, const std::string &meaning);
Key truth(const std::string &name, bool fallback, const std::string &meaning);
/// @param fallback  if true the first choice
Key choice(const std::string &name, const std::vector<std::string> &choices, bool fallback, const std::string &meaning);
Key named(const std::string &name, const std::string &meaning);
Key direction(const std::string &name, const std::string &meaning);
Key vector(const std::string &name, const Kind &kind, const std::string &meaning);
/// Of any form that needs no kind and no keys.
Key plain(const std::string &name, Key::Form form, const std::string &meaning);
Key table(const std::string &name, const std::vector<Key> &keys, const std::string &meaning);
/// @param keys  beside the names
Key map(const std::string &name, const Kind &kind, const std::vector<Key> &keys, const std::string &meaning);
/// Any form that has keys of its own, or a second kind in the same column.
Key composed(const std::string &name, Key::Form form, const Kind &kind, const std::vector<Key> &keys,
             const std::string &meaning);
} // namespace key

/// All keys of the lists, in order.
std::vector<Key> joined(const std::vector<std::vector<Key>> &lists);

/// Null if there is none of that name.
const Key *find_key(const std::vector<Key> &keys, const std::string &name);

} // namespace gestell::apps
