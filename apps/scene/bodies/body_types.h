#pragma once

#include "apps/scene/read/names.h"

namespace gestell::apps
{

/// What a type of bodies is; its reader, help, schema and reference come from it.
struct BodyType
{
  std::string        name; ///< value of the key `type`
  std::string        does; ///< one sentence
  std::vector<Key>   keys; ///< `type` among them
  coupling::BodyKind kind;

  void (*add)(coupling::MachineModel &machine, const BodyRequest &body);
  /// What keys do not fill; mass and inertia of a body with `cad` follow from that.
  void (*read)(const SceneTable &table, BodyRequest &body) = nullptr;
  const char *carrier                                      = nullptr; ///< key that names what carries it
};

/// All types of bodies; to add one, write bodies/x.cc and its line in body_types.cc.
const std::vector<BodyType> &body_types();
const BodyType              &body_type(coupling::BodyKind kind);

// Keys that several types have.
Key mass_key();   ///< demanded, or with `cad` from its density
Key centre_key(); ///< of mass
Key drawn_size();
Key drawn_radius(const std::string &as);
Key inertia_key(const std::string &about);

/// Reads all [body.NAME], in the order of the file, and makes them known to `names`.
std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names, fem::Scripts scripts);

} // namespace gestell::apps
