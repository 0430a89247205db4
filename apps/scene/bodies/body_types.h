#pragma once

#include "apps/scene/read/names.h"

namespace gestell::apps
{

/// A type of bodies; its reader, help, schema and reference are generated from this.
struct BodyType
{
  std::string        name; ///< value of the key `type`
  std::string        does; ///< description in one sentence
  std::vector<Key>   keys; ///< including `type`
  coupling::BodyKind kind;

  void (*add)(coupling::MachineModel &machine, const BodyRequest &body);
  /// Reads values that are not bound to keys; mass and inertia of a body with `cad` are computed afterwards.
  void (*read)(const SceneTable &table, BodyRequest &body) = nullptr;
  const char *carrier                                      = nullptr; ///< key that names the carrier
};

/// All types of bodies; to add one, write bodies/x.cc and its line in body_types.cc.
const std::vector<BodyType> &body_types();
const BodyType              &body_type(coupling::BodyKind kind);

// Keys shared by several types.
Key mass_key();   ///< required, or with `cad` from its density
Key centre_key(); ///< of mass
Key drawn_size();
Key drawn_radius(const std::string &as);
Key inertia_key(const std::string &about);

/// Reads all [body.NAME], in the order of the file, and adds them to `names`.
std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names, fem::Scripts scripts);

} // namespace gestell::apps
