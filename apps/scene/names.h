#pragma once

#include "apps/scene/scene.h"
#include "apps/scene/scene_table.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The things of a scene that elements refer to by name, known before any frame is made.
class Names
{
public:
  /// @param interfaces  of the frame; any_interface: they are only known once a file is read.
  Names(const std::vector<std::string> &interfaces, bool any_interface);

  void add_body(const BodyRequest &body) { bodies_.push_back(body); }

  /// Marker named by a key of `table`: "ground", a body, or "frame.crown".
  std::string marker(const SceneTable &table, const std::string &key) const;
  std::string marker(const SceneTable &table, const std::string &key, const std::string &fallback) const;
  /// Body of that kind named by a key of `table`.
  const BodyRequest &body(const SceneTable &table, const std::string &key, coupling::BodyKind kind) const;

  const BodyRequest              *find_body(const std::string &name) const; ///< null if there is none
  std::vector<std::string>        body_names() const;
  const std::vector<std::string> &interfaces() const { return interfaces_; }

private:
  std::vector<std::string> interfaces_;
  bool                     any_interface_;
  std::vector<BodyRequest> bodies_;
};

/// Refuses names that cannot be referred to: empty, with dots, "frame", "ground".
void check_thing_name(const SceneTable &table);

} // namespace gestell::apps
