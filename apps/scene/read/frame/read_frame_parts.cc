#include "apps/scene/file/declaration.h"
#include "apps/scene/read/frame/geometry_keys.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/frame/read_frame.h"
#include "apps/scene/read/names.h"
#include "apps/scene/read/read_material.h"
#include "apps/scene/read/read_part.h"
#include "apps/scene/read/read_tensor.h"
#include "coupling/substructures/require_joints.h"
#include "fem/values/nearest_name.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

std::vector<Key> without_those_of_the_whole(std::vector<Key> keys)
{
  keys.erase(std::remove_if(keys.begin(), keys.end(),
                            [](const Key &key) { return key.name == "reduced" || key.name == "prestress"; }),
             keys.end());
  for (Key &key : keys)
    if (key.name == "cad")
      key.otherwise = "`same_as`";
  return keys;
}

} // namespace

/// Keys of [frame] of several parts, followed by those of [frame.part.NAME] and [frame.joint.NAME].
const std::vector<Key> &parts_frame_keys()
{
  static const std::vector<Key> keys = {
      key::table("part", {}, "`[frame.part.NAME]`, at least two").by_default(""),
      key::table("joint", {}, "`[frame.joint.NAME]`, the joints between the parts").by_default(""),
      key::table("damping", damping_keys(),
                 "modal damping ratios of the joined frame, `{ ratio = 0.02 }`, in addition to the damping of the "
                 "parts; `rayleigh` is a key of the parts")
          .by_default("that of the parts"),
      key::table("prestress",
                 {*find_key(prestress_keys(), "gravity"),
                  key::truth("tie_rods", false, "include the forces of the tie rods (`prestress` of the joints)"),
                  *find_key(prestress_keys(), "factor")},
                 "static loads whose stresses stiffen or soften the parts and the tie rods, as for a frame of one "
                 "part: `{ tie_rods = true }`")
          .by_default("none"),
      key::choice("modes", {"by tolerance", "all"}, true,
                  "modes of the joined parts with the interfaces of the mechanism fixed: as many as `[reduction]` "
                  "requires, or `\"all\"` modes of the reduced parts (no truncation)")};
  return keys;
}

const std::vector<Key> &frame_part_keys()
{
  static const std::vector<Key> keys = joined(
      {without_those_of_the_whole(frame_keys()),
       {key::named("same_as", "part of which this one is a copy; only `placement` may differ. Equal parts are reduced "
                              "once, even without this key")
            .by_default("`cad`"),
        key::table("placement",
                   {key::vector("origin", kind::length, "position of the origin of the part").by_default("[0, 0, 0]"),
                    key::direction("axis", "axis of rotation").by_default("no rotation"),
                    key::number("angle", kind::angle, "angle of rotation").by_default("no rotation"),
                    key::direction(
                        "mirror", "normal of the mirror plane through the origin of the part; mirrored before rotation")
                        .by_default("not mirrored")},
                   "placement of the part, whose keys are in its own coordinates: mirrored, then rotated about `axis` "
                   "through its origin, which is then moved to `origin`")
            .by_default("the coordinates of the part are those of the frame")}});
  return keys;
}

const std::vector<Key> &frame_joint_keys()
{
  static const std::vector<Key> keys = {
      key::choice(
          "type", {"weld", "contact", "bolts", "tie rod"}, true,
          "`\"weld\"`: the two interfaces move as one. `\"contact\"`: they move as one while pressed together, which "
          "every run checks. `\"bolts\"`: springs and dampers. `\"tie rod\"`: a bar that pulls the two together"),
      key::plain("between", Key::Form::texts,
                 "two interfaces, `[\"crown.left foot\", \"left column.top\"]`: PART.INTERFACE"),
      key::direction("normal",
                     "normal of the faces, from the first part to the second, for a contact or bolts with `preload`")
          .by_default("required for a contact"),
      key::number("tolerance", kind::length, "largest distance of the two nodes; not for tie rods")
          .above_zero()
          .by_default("1/1000 of the larger part"),
      key::truth("keep", false, "keep the first interface for the mechanism as well, as `frame.PART.INTERFACE`"),
      key::composed("positions", Key::Form::matrix, kind::length, {},
                    "positions of bolts in the frame, `[[x, y, z], ...]`, each with `stiffness` and `damping`")
          .by_default("one bolt, midway between the interfaces"),
      key::composed("axes", Key::Form::matrix, kind::number, {},
                    "for bolts: directions of the three values, these two and the perpendicular one")
          .by_default("x, y and z"),
      per_direction_key("stiffness", kind::stiffness, "stiffness of each bolt, or `[x, y, z]` along `axes`"),
      per_direction_key("rotational_stiffness", kind::torsional_stiffness,
                        "additional rotational stiffness of all bolts together"),
      per_direction_key("rotational_damping", kind::torsional_damping, "likewise"),
      key::number("preload", kind::force, "preload of all bolts together, for the check of opening; needs `normal`")
          .above_zero()
          .by_default("not known"),
      key::number("diameter", kind::length, "diameter of a tie rod").above_zero().by_default("required for a tie rod"),
      key::number("length", kind::length, "length of a tie rod; stiffness E A / L")
          .above_zero()
          .by_default("distance of the interfaces"),
      material_key(),
      key::number("damping", kind::damping, "damping along a tie rod, or of each bolt, or `[x, y, z]` along `axes`")
          .from_zero()
          .also({Key::Form::vector})
          .by_default(0.),
      key::number("prestress", kind::force,
                  "tension of a tie rod in the tightened frame at rest, without weight and other loads")
          .from_zero()
          .by_default(0.)};
  return keys;
}

namespace
{

using coupling::FrameJoint;
using coupling::FrameOfParts;
using coupling::FramePart;
using coupling::JointKind;

Eigen::Vector3d column(const Vector3 &x)
{
  return Eigen::Map<const Eigen::Vector3d>(x.data());
}

void refuse_beside_same_as(const SceneTable &part)
{
  for (const std::string &key : part.keys())
    if (key != "same_as" && key != "placement")
      throw part.error(key, "is taken from the part '" + part.text("same_as") +
                                "'; with 'same_as' only 'placement' is allowed");
}

/// One that is the same as another has no geometry yet.
FramePart read_frame_part(const SceneTable &any, const SceneTable &scene)
{
  const SceneTable table = any.declared(frame_part_keys());
  check_thing_name(table);
  if (table.name() == "joint")
    throw table.error("'joint' is reserved for signals of joints; choose another name");
  FramePart part;
  part.name      = table.name();
  part.place     = table.place();
  part.placement = read_placement(table);
  if (table.has("same_as"))
    refuse_beside_same_as(table);
  else
    part.geometry = read_frame_geometry(table, scene);
  return part;
}

std::vector<FramePart> read_parts(const SceneTable &frame, const SceneTable &scene)
{
  std::vector<FramePart>   parts;
  std::vector<std::string> names;
  for (const SceneTable &table : frame.tables("part"))
  {
    parts.push_back(read_frame_part(table, scene));
    if (!table.has("same_as"))
      names.push_back(table.name());
  }
  const auto tables = frame.tables("part");
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (tables[i].has("same_as"))
    {
      const std::string same = tables[i].text("same_as");
      if (std::find(names.begin(), names.end(), same) == names.end())
        throw tables[i].error("same_as",
                              "there is no part '" + same + "' with its own geometry" + suggestion(same, names));
      parts[i].geometry =
          std::find_if(parts.begin(), parts.end(), [&](const FramePart &part) { return part.name == same; })->geometry;
    }
  return parts;
}

coupling::JointEnd read_end(const SceneTable &table, const std::string &text)
{
  const auto dot = text.find('.');
  if (dot == std::string::npos || dot != text.rfind('.') || dot == 0 || dot + 1 == text.size())
    throw table.error("between", "got '" + text + "'; needs PART.INTERFACE, such as \"crown.left foot\"");
  return {text.substr(0, dot), text.substr(dot + 1)};
}

coupling::BoltedJoint read_bolts(const SceneTable &table)
{
  coupling::BoltedJoint bolts;
  if (table.has("axes"))
    bolts.axes = read_axes(table, "axes");
  bolts.stiffness          = column(read_per_direction(table, "stiffness", kind::stiffness));
  bolts.damping            = column(read_per_direction(table, "damping", kind::damping));
  bolts.rotational         = column(read_per_direction(table, "rotational_stiffness", kind::torsional_stiffness));
  bolts.rotational_damping = column(read_per_direction(table, "rotational_damping", kind::torsional_damping));
  if (bolts.stiffness.isZero(0.))
    throw table.error(
        "needs a 'stiffness' of the bolts such as \"2 MN/mm\"; to join interfaces rigidly use type = \"weld\"");
  if (table.has("positions"))
    for (const auto &row : table.matrix("positions", kind::length))
    {
      if (row.size() != 3)
        throw table.error("positions", "needs three coordinates of each bolt, [[x, y, z], ...]");
      bolts.positions.emplace_back(row[0], row[1], row[2]);
    }
  if (table.has("preload"))
    bolts.preload = table.value("preload");
  return bolts;
}

coupling::TieRod read_rod(const SceneTable &table, const SceneTable &scene)
{
  coupling::TieRod    rod;
  const fem::Material material = read_weighed_material(table, scene);
  rod.E                        = material.E;
  rod.rho                      = material.rho;
  rod.material                 = material.name;
  rod.diameter                 = table.value("diameter");
  if (table.has("length"))
    rod.length = table.value("length");
  if (table.is_array("damping"))
    throw table.error("damping", "of a tie rod acts along it; needs one number such as \"5 kN s/m\"");
  rod.damping   = table.value("damping");
  rod.prestress = table.value("prestress");
  return rod;
}

/// Keys that are not for the type of the joint.
void refuse_other_keys(const SceneTable &table, const std::string &type)
{
  const std::vector<std::string> bolts{"positions",          "axes",   "stiffness", "rotational_stiffness",
                                       "rotational_damping", "preload"},
      rods{"diameter", "length", "material", "prestress"}, faces{"tolerance", "normal"};
  const auto refuse = [&](const std::vector<std::string> &keys, const std::string &owner)
  {
    for (const std::string &key : keys)
      if (table.has(key))
        throw table.error(key, "applies to " + owner + ", but this joint is a " + type + "; remove it");
  };
  if (type != "bolts")
    refuse(bolts, "type = \"bolts\"");
  if (type != "tie rod")
    refuse(rods, "type = \"tie rod\"");
  else
    refuse(faces, "joints of faces");
  if (type == "weld")
    refuse({"normal"}, "type = \"contact\" or \"bolts\"");
  if (type == "weld" || type == "contact")
    refuse({"damping"}, "type = \"bolts\" or \"tie rod\"");
}

FrameJoint read_frame_joint(const SceneTable &any, const SceneTable &scene)
{
  const SceneTable table = any.declared(frame_joint_keys());
  check_thing_name(table);
  FrameJoint        joint;
  const std::string type = table.choice("type");
  joint.name             = table.name();
  joint.place            = table.place();
  joint.kind             = type == "weld"      ? JointKind::weld
                           : type == "contact" ? JointKind::contact
                           : type == "bolts"   ? JointKind::bolts
                                               : JointKind::tie_rod;
  const auto ends        = table.texts("between");
  if (ends.size() != 2)
    throw table.error("between", "needs two interfaces, [\"PART.INTERFACE\", \"PART.INTERFACE\"]");
  joint.between = {read_end(table, ends[0]), read_end(table, ends[1])};
  refuse_other_keys(table, type);
  if (joint.kind == JointKind::bolts)
    joint.bolts = read_bolts(table);
  if (joint.kind == JointKind::tie_rod)
    joint.rod = read_rod(table, scene);
  if (table.has("normal"))
    joint.normal = column(table.direction("normal"));
  else if (joint.kind == JointKind::contact || joint.bolts.preload > 0.)
    throw table.error(
        "needs 'normal', normal to the faces from the first part to the second, to distinguish pressure from tension");
  if (table.has("tolerance"))
    joint.tolerance = table.value("tolerance");
  joint.keep = table.truth("keep");
  return joint;
}

void read_whole_damping(const SceneTable &frame, FrameOfParts &parts)
{
  const auto table = frame.optional_table("damping");
  if (!table)
    return;
  const FrameDamping damping = read_damping(*table);
  if (damping.alpha != 0. || damping.beta != 0.)
    throw table->error(
        "rayleigh",
        "is proportional to the mass and stiffness of a part; set it for the parts, [frame.part.NAME] damping");
  parts.modal_damping_ratio = damping.ratios;
}

} // namespace

FrameOfParts read_frame_parts(const SceneTable &any, const SceneTable &scene)
{
  const SceneTable frame = any.declared(parts_frame_keys());
  FrameOfParts     parts;
  parts.place = frame.place();
  parts.parts = read_parts(frame, scene);
  for (const SceneTable &table : frame.tables("joint"))
    parts.joints.push_back(read_frame_joint(table, scene));
  parts.all_modes = frame.choice("modes") == "all";
  read_whole_damping(frame, parts);
  if (const auto prestress = frame.optional_table("prestress"))
  {
    parts.prestress           = read_prestress(*prestress, scene);
    parts.prestress->tie_rods = prestress->truth("tie_rods");
    if (!parts.prestress->tie_rods && parts.prestress->acceleration == fem::Vector3{})
      throw prestress->error("has no load; give it tie_rods = true, or gravity = true and the scene a 'gravity'");
    for (const FramePart &part : parts.parts)
      if (part.geometry.parts != 1)
        throw prestress->error("needs each part in one piece; remove 'parts' of frame.part." + part.name);
  }
  if (parts.parts.size() < 2)
    throw frame.error("has only one part; write a frame of one part as [frame] cad = ...");
  coupling::require_joints(parts);
  if (coupling::kept_interfaces(parts).empty())
    throw frame.error("has no interface left for the mechanism, because all are joined; declare another "
                      "[frame.part.NAME.interface.NAME], or set keep = true at a joint");
  return parts;
}

} // namespace gestell::apps
