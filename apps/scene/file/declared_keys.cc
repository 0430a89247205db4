#include "apps/scene/file/expected_values.h"
#include "apps/scene/file/scene_table.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

void read_into(double &member, const SceneTable &table, const Key &key, bool on_angle)
{
  member = table.value(key.source.empty() || table.has(key.name) ? key.name : key.source, on_angle);
}

void read_into(std::array<double, 3> &member, const SceneTable &table, const Key &key, bool)
{
  member = key.form == Key::Form::direction ? table.direction(key.name) : table.vector(key.name);
}

void read_into(bool &member, const SceneTable &table, const Key &key, bool)
{
  member = table.truth(key.name);
}

void read_into(int &member, const SceneTable &table, const Key &key, bool)
{
  member = table.whole(key.name);
}

std::size_t chosen(const SceneTable &table, const Key &key)
{
  return std::find(key.choices.begin(), key.choices.end(), table.choice(key.name)) - key.choices.begin();
}

void SceneTable::fill(void *object, const std::type_info &type, bool on_angle) const
{
  const auto is_read = [&](const Key &key)
  {
    if (!key.companion.empty() && !has(key.companion))
      return false;
    if (!key.substitute.empty())
      return !has(key.substitute) && (key.demanded || has(key.name));
    return key.demanded || key.fallback || key.form == Key::Form::choice || has(key.name) ||
           (!key.source.empty() && has(key.source));
  };
  if (!keys_)
    throw std::logic_error("SceneTable::fill: a table without declared keys");
  for (const Key &key : *keys_)
    if (key.object && *key.object == type && is_read(key))
      key.fill(object, *this, key, on_angle);
}

SceneTable SceneTable::declared(const std::vector<Key> &keys) const
{
  SceneTable table = *this;
  table.keys_      = &keys;
  table.open_      = false;
  return table;
}

SceneTable SceneTable::inner(SceneTable table, const std::string &key) const
{
  const Key *declared = keys_ ? find_key(*keys_, key) : nullptr;
  if (declared && !declared->keys.empty())
  {
    table.keys_ = &declared->keys;
    table.open_ = declared->form == Key::Form::map;
  }
  return table;
}

const Key &SceneTable::declaration(const std::string &key) const
{
  const Key *declared = keys_ ? find_key(*keys_, key) : nullptr;
  if (!declared)
    throw std::logic_error(path_of(key) + " is read, but not declared");
  return *declared;
}

double SceneTable::share(const std::string &key) const
{
  const double share = positive(key, kind::number);
  if (share <= 1.)
    return share;
  std::ostringstream text;
  text << "needs a value of at most 1, got " << share << "; write percent as \"" << share << " %\"";
  throw error(key, text.str());
}

double SceneTable::value(const std::string &key, bool on_angle) const
{
  const Key  &declared = declaration(key);
  const Kind &kind     = on_angle && declared.angular ? *declared.angular : declared.kind;
  if (declared.fallback && !has(key))
    return *declared.fallback;
  const double value = declared.range == Key::Range::any         ? number(key, kind)
                       : declared.range == Key::Range::from_zero ? not_negative(key, kind)
                       : declared.range == Key::Range::share     ? share(key)
                                                                 : positive(key, kind);
  if (const std::string words = unexpected_words(key, kind, value); !words.empty())
    warn(key, words);
  return value;
}

void SceneTable::demand(std::initializer_list<const char *> numbers, bool on_angle) const
{
  for (const char *key : numbers)
    value(key, on_angle);
}

double SceneTable::value_or(const std::string &key, double otherwise, bool on_angle) const
{
  return has(key) ? value(key, on_angle) : otherwise;
}

std::string SceneTable::choice(const std::string &key) const
{
  const Key &declared = declaration(key);
  return choice(key, declared.choices, declared.demanded ? "" : declared.choices.front());
}

int SceneTable::whole(const std::string &key) const
{
  return integer(key, static_cast<int>(declaration(key).fallback.value_or(0.)));
}

Vector3 SceneTable::vector(const std::string &key) const
{
  return vector(key, declaration(key).kind);
}

Vector3 SceneTable::vector_or(const std::string &key, const Vector3 &otherwise) const
{
  return has(key) ? vector(key) : otherwise;
}

bool SceneTable::truth(const std::string &key) const
{
  return boolean(key, declaration(key).fallback.value_or(0.) != 0.);
}

std::shared_ptr<const UserValue> SceneTable::user_value(const std::string &key) const
{
  const SceneNode *value = look_up(key);
  if (value && !value->user && !lost_function(value->text).empty())
    throw error(key, lost_function(value->text));
  return value ? value->user : nullptr;
}

} // namespace gestell::apps
