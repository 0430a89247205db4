#include "apps/scene/file/declaration.h"

namespace gestell::apps
{
namespace
{

/// Copy of `key`, changed.
template <typename Change>
Key changed(Key key, Change change)
{
  change(key);
  return key;
}

Key key_of(const std::string &name, Key::Form form, const std::string &meaning)
{
  Key key;
  key.name    = name;
  key.form    = form;
  key.meaning = meaning;
  return key;
}

} // namespace

Key Key::also(const std::vector<Form> &forms) const
{
  return changed(*this, [&](Key &key) { key.others = forms; });
}

Key Key::on_angle(const Kind &other) const
{
  return changed(*this, [&](Key &key) { key.angular = other; });
}

Key Key::on_angle(const Key &other) const
{
  const auto join = [](Key &key, const Key &about)
  {
    if (!equal(key.kind.dimension, about.kind.dimension) || key.kind.refused != about.kind.refused)
      key.angular = about.kind;
  };
  return changed(*this,
                 [&](Key &key)
                 {
                   join(key, other);
                   for (std::size_t i = 0; i < key.keys.size(); ++i)
                     join(key.keys[i], other.keys[i]);
                 });
}

Key Key::above_zero() const
{
  return changed(*this, [](Key &key) { key.range = Range::above_zero; });
}

Key Key::from_zero() const
{
  return changed(*this, [](Key &key) { key.range = Range::from_zero; });
}

Key Key::as_share() const
{
  return changed(*this, [](Key &key) { key.range = Range::share; });
}

Key Key::by_default(double value) const
{
  return changed(*this, [&](Key &key) { key.demanded = false, key.fallback = value; });
}

Key Key::by_default(const std::string &words) const
{
  return changed(*this, [&](Key &key) { key.demanded = false, key.fallback.reset(), key.otherwise = words; });
}

Key Key::same_as(const std::string &other) const
{
  return changed(by_default("`" + other + "`"), [&](Key &key) { key.source = other; });
}

Key Key::unless(const std::string &other) const
{
  return changed(*this, [&](Key &key) { key.substitute = other; });
}

Key Key::only_with(const std::string &other) const
{
  return changed(*this, [&](Key &key) { key.companion = other; });
}

Key Key::filling(const std::type_info &type, decltype(fill) filler) const
{
  return changed(*this, [&](Key &key) { key.object = &type, key.fill = filler; });
}

namespace key
{

Key number(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return composed(name, Key::Form::number, kind, {}, meaning);
}

Key formula(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return composed(name, Key::Form::formula, kind, {}, meaning);
}

Key truth(const std::string &name, bool fallback, const std::string &meaning)
{
  return key_of(name, Key::Form::truth, meaning).by_default(fallback ? 1. : 0.);
}

Key choice(const std::string &name, const std::vector<std::string> &choices, bool fallback, const std::string &meaning)
{
  Key key      = key_of(name, Key::Form::choice, meaning);
  key.choices  = choices;
  key.demanded = !fallback;
  return key;
}

Key named(const std::string &name, const std::string &meaning)
{
  return key_of(name, Key::Form::name, meaning);
}

Key direction(const std::string &name, const std::string &meaning)
{
  return key_of(name, Key::Form::direction, meaning);
}

Key vector(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return composed(name, Key::Form::vector, kind, {}, meaning);
}

Key plain(const std::string &name, Key::Form form, const std::string &meaning)
{
  return key_of(name, form, meaning);
}

Key table(const std::string &name, const std::vector<Key> &keys, const std::string &meaning)
{
  return composed(name, Key::Form::table, kind::number, keys, meaning);
}

Key map(const std::string &name, const Kind &kind, const std::vector<Key> &keys, const std::string &meaning)
{
  return composed(name, Key::Form::map, kind, keys, meaning);
}

Key composed(const std::string &name, Key::Form form, const Kind &kind, const std::vector<Key> &keys,
             const std::string &meaning)
{
  Key key  = key_of(name, form, meaning);
  key.kind = kind;
  key.keys = keys;
  return key;
}

} // namespace key

std::vector<Key> joined(const std::vector<std::vector<Key>> &lists)
{
  std::vector<Key> keys;
  for (const auto &list : lists)
    keys.insert(keys.end(), list.begin(), list.end());
  return keys;
}

const Key *find_key(const std::vector<Key> &keys, const std::string &name)
{
  for (const Key &key : keys)
    if (key.name == name)
      return &key;
  return nullptr;
}

} // namespace gestell::apps
