#include "apps/scene/read/frame/parts_keys.h"

#include "apps/scene/read/frame/geometry_keys.h"
#include "apps/scene/read/frame/read_damping.h"
#include "apps/scene/read/read_material.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

Key of_each_direction(const std::string &name, const Kind &kind, const std::string &meaning)
{
  return key::number(name, kind, meaning).from_zero().also({Key::Form::vector}).by_default(0.);
}

std::vector<Key> without_reduced(std::vector<Key> keys)
{
  keys.erase(std::remove_if(keys.begin(), keys.end(), [](const Key &key) { return key.name == "reduced"; }),
             keys.end());
  for (Key &key : keys)
    if (key.name == "cad")
      key.otherwise = "`same_as`";
  return keys;
}

} // namespace

const std::vector<Key> &parts_frame_keys()
{
  static const std::vector<Key> keys = {
      key::table("part", {}, "`[frame.part.NAME]`, two at least").by_default(""),
      key::table("joint", {}, "`[frame.joint.NAME]`, which hold the parts together").by_default(""),
      key::table("damping", damping_keys(),
                 "by ratios of the modes of the joined frame, `{ ratio = 0.02 }`, beside what parts have; `rayleigh` "
                 "belongs to the parts")
          .by_default("that of the parts"),
      key::choice(
          "modes", {"by tolerance", "all"}, true,
          "of the joined parts with the interfaces of the mechanism held: as many as `[reduction]` asks for, or "
          "`\"all\"` that the reduced parts have, which changes nothing but the coordinates")};
  return keys;
}

const std::vector<Key> &frame_part_keys()
{
  static const std::vector<Key> keys = joined(
      {without_reduced(frame_keys()),
       {key::named("same_as", "an equal part elsewhere: only `placement` is given beside it. Equal parts are reduced "
                              "once, whether they are said to be or not")
            .by_default("`cad`"),
        key::table("placement",
                   {key::vector("origin", kind::length, "where the part's origin lies").by_default("[0, 0, 0]"),
                    key::direction("axis", "about which the part is turned").by_default("not turned"),
                    key::number("angle", kind::angle, "by which it is turned").by_default("not turned"),
                    key::direction("mirror", "normal of the plane through the part's origin in which it is mirrored, "
                                             "before it is turned")
                        .by_default("not mirrored")},
                   "all that is said of the part is in its own coordinates; mirrored, then turned about `axis` through "
                   "its origin, which then is moved to `origin`")
            .by_default("the part's coordinates are the frame's")}});
  return keys;
}

const std::vector<Key> &frame_joint_keys()
{
  static const std::vector<Key> keys = {
      key::choice(
          "type", {"weld", "contact", "bolts", "tie rod"}, true,
          "`\"weld\"`: the two interfaces move as one; `\"contact\"`: likewise, as long as they are pressed "
          "together, which every run watches; `\"bolts\"`: springs and dampers; `\"tie rod\"`: a bar that pulls "
          "the two together"),
      key::plain("between", Key::Form::texts,
                 "two interfaces, `[\"crown.left foot\", \"left column.top\"]`: PART.INTERFACE"),
      key::direction("normal", "of a contact, or of bolts with a `preload`: across the faces, from the first part to "
                               "the second")
          .by_default("demanded of a contact"),
      key::number("tolerance", kind::length, "how far the nodes of the two may be apart; not of tie rods")
          .above_zero()
          .by_default("a thousandth of the larger part"),
      key::truth("keep", false,
                 "the first interface of the joint carries something of the mechanism, too, as `frame.PART.INTERFACE`"),
      key::composed("positions", Key::Form::matrix, kind::length, {},
                    "of bolts, in the frame: `[[x, y, z], ...]`, each with `stiffness` and `damping`")
          .by_default("one, amid the interfaces"),
      key::composed("axes", Key::Form::matrix, kind::number, {},
                    "of bolts: the three values act along these two directions and the third at right angles to both")
          .by_default("x, y and z"),
      of_each_direction("stiffness", kind::stiffness, "of each bolt, or `[x, y, z]` along `axes`"),
      of_each_direction("rotational_stiffness", kind::torsional_stiffness,
                        "of all bolts together against turning, beside what their places give"),
      of_each_direction("rotational_damping", kind::torsional_damping, "likewise"),
      key::number("preload", kind::force, "of all bolts together, which the joint opens against; needs `normal`")
          .above_zero()
          .by_default("not known"),
      key::number("diameter", kind::length, "of a tie rod").above_zero().by_default("demanded of a tie rod"),
      key::number("length", kind::length, "of a tie rod, by which it yields: E A / L")
          .above_zero()
          .by_default("distance of the interfaces"),
      material_key(),
      key::number("damping", kind::damping, "of a tie rod along it; of each bolt, or `[x, y, z]` along `axes`")
          .from_zero()
          .also({Key::Form::vector})
          .by_default(0.),
      key::number("prestress", kind::force,
                  "tension of a tie rod in the tightened frame at rest, without weight and other loads")
          .from_zero()
          .by_default(0.)};
  return keys;
}

} // namespace gestell::apps
