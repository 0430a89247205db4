#pragma once

#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

struct UserValue;

/// Location of a value: "press.toml:12", or "--set run.step=1" from the command line.
struct Place
{
  std::string file;
  int         line = 0; ///< from 1; 0: the file as a whole

  std::string text() const { return line > 0 ? file + ":" + std::to_string(line) : file; }
  /// @throws std::invalid_argument always: the location, and the error
  [[noreturn]] void fail(const std::string &what) const { throw std::invalid_argument(text() + ": " + what); }
};

/// A value of a scene file, with its location; tables keep the order of the file.
struct SceneNode
{
  enum class Type
  {
    table,
    array,
    text,
    integer,
    real,
    boolean,
    date,
    function ///< of the calling program; `text` is its mark
  };
  using Entry = std::pair<std::string, SceneNode>;

  Type        type = Type::table;
  Place       place;
  std::string folder; ///< base of relative paths in the value
  std::string text;   ///< of a string; a number as it is written
  double      number  = 0.;
  bool        boolean = false;

  std::vector<Entry>               entries;  ///< of a table
  std::vector<SceneNode>           elements; ///< of an array
  std::shared_ptr<const UserValue> user{};   ///< of a function

  mutable bool                  used = false; ///< a reader requested it
  mutable std::set<std::string> requested;    ///< keys that readers requested from this table

  const SceneNode *find(const std::string &key) const;
  SceneNode       *find(const std::string &key);
};

/// "a table", "a string", "an integer" ...
std::string type_name(SceneNode::Type type);

/// A value for messages: its text, or its type.
std::string described(const SceneNode &value);

/// Key as it must be written in TOML: bare, or in quotes.
std::string written_key(const std::string &key);

} // namespace gestell::apps
