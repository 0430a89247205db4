#include "apps/scene/scene_keys.h"

#include "apps/scene/values/requests.h"
#include "coupling/reduction/reductions.h"

namespace gestell::apps
{
namespace
{

/// A table, or tables with names, whose keys are declared by themselves.
Key one_of(const std::string &name, const std::string &meaning)
{
  return key::table(name, {}, meaning).by_default("");
}

Key coordinates(const std::string &name, const Kind &length, const Kind &angle, const std::string &meaning)
{
  return key::map(name, length, {}, meaning).on_angle(angle);
}

} // namespace

const std::vector<Key> &scene_keys()
{
  static const std::vector<Key> keys = {
      key::plain("name", Key::Form::text, "names the folder of the results").by_default("name of the file"),
      key::plain("description", Key::Form::text, "one line for the report").by_default("none"),
      key::vector("gravity", kind::acceleration, "acts on the frame and on all masses").by_default("[0, 0, 0]"),
      key::plain("extends", Key::Form::file, "scene whose entries hold where this one has none").by_default("none"),
      key::plain("without", Key::Form::texts, "entries of it that are not taken over, `[\"joint.cylinder\"]`")
          .by_default("none"),
      key::plain("parameters", Key::Form::map, "[parameters](scene/values.md#values) of expressions")
          .by_default("none"),
      one_of("material", "`[material.NAME]`"),
      one_of("frame", "the frame"),
      one_of("reduction", "its reduction"),
      one_of("body", "`[body.NAME]`"),
      one_of("place", "`[place.NAME]`"),
      one_of("measure", "`[measure.NAME]`"),
      one_of("element", "`[element.NAME]`"),
      one_of("joint", "`[joint.NAME]`"),
      one_of("switch", "`[switch.NAME]`"),
      one_of("run", "the run in time"),
      one_of("start", "the state it starts from"),
      one_of("modes", "the machine's modes"),
      one_of("output", "signals, stresses and rows that are written")};
  return keys;
}

namespace
{

std::vector<std::string> reduction_names()
{
  std::vector<std::string> names;
  for (const auto &entry : coupling::Reductions::entries())
    names.push_back(entry.name);
  return names;
}

} // namespace

const std::vector<Key> &reduction_keys()
{
  static const std::vector<Key> keys = {
      key::choice(
          "method", reduction_names(), true,
          "static shapes of the interface with modes of the inside: `\"craig-bampton\"` with the interface "
          "held, `\"free-interface\"` those of the frame as it is supported, which the reduced frame then has "
          "exactly. `\"guyan\"`: these static shapes alone, exact in statics; modes that the "
          "frame has with its interface held are missing, and "
          "[noted](../../theory/reduction.md#static-condensation) where they lie below `frequency`. "
          "`\"modal\"` superposes [modes of frame and mechanism](../../theory/reduction.md#modal-superposition), which "
          "must all "
          "vibrate. `\"condensation\"` keeps every coordinate of the full frame and condenses each step to those that "
          "forces of the mechanism act on ([integration](../../theory/integration.md#condensation-to-the-measures)"
          "): exact, and slower by orders of magnitude; `\"none\"` is another name of it. So does a frame given by "
          "matrices without `[reduction]`. Their other keys are those of the reduced frame that stands in for the full "
          "one "
          "in modes, statics of the start and pictures. A key that the method does not take is an error"),
      key::number(
          "tolerance", kind::number,
          "relative error of the receptance of the interface up to `frequency`, or without one of the twelve lowest "
          "frequencies; chooses the number of modes. By receptance, modes may be fewer together with the static shapes "
          "of their inertia (up to as many as interface coordinates), and where dampers act inside the frame with "
          "theirs; [tried](../../theory/reduction.md#how-many-modes-for-the-interface) from 0.05 down to 1e-5, with "
          "dampers up to 200 times as stiff as the supports they stand beside. The error is one number for all "
          "interfaces, Frobenius' norm with each coordinate scaled by its inertia: an interface far stiffer than the "
          "others may be worse by itself, and the worst is listed beside it. A note says what cannot be reached. Of "
          "`\"modal\"`: the share of static deflections that may be left out")
          .as_share()
          .by_default(ReductionRequest().options.tolerance),
      key::plain(
          "modes", Key::Form::whole,
          "fixed number of modes instead; a `tolerance` beside it says how far they hold where no `frequency` is "
          "given. Of "
          "`\"free-interface\"` without it: "
          "all up to 1.5 times `frequency`, or the twelfth elastic one. A note gives the error up to "
          "`frequency`, or that the modes kept end below it. Of `\"modal\"` without it: all up to four times the "
          "highest "
          "frequency of the loads, and as many as `tolerance` asks for")
          .by_default("by `tolerance`"),
      key::number("frequency", kind::frequency,
                  "highest frequency of interest; of `\"guyan\"` without it: as far as frequencies stay within "
                  "`tolerance`. Of `\"modal\"` that of the highest mode kept")
          .above_zero()
          .by_default("automatic"),
      key::choice("inside", {"fixed-interface", "free-interface"}, true,
                  "beside `\"craig-bampton\"`: `\"free-interface\"` is the method of that name"),
      key::choice("damping", {"full", "diagonal"}, true,
                  "of `\"modal\"`: `\"diagonal\"` leaves out what couples modes"),
      key::choice("factor", {"gestell", "cholmod", "mumps"}, true,
                  "factor of the stiffness, for all solutions and modes; the results agree up to rounding. "
                  "`\"gestell\"`, `\"cholmod\"`: in one process, `\"mumps\"`: on any number of ranks of `mpirun`")
          .by_default("`\"gestell\"`, on several ranks `\"mumps\"`"),
      key::choice("eigensolver", {"block-lanczos", "krylov-schur", "lobpcg"}, true,
                  "`\"krylov-schur\"`, `\"lobpcg\"`: of SLEPc, for the same modes in more time; the second may break "
                  "down by rounding, and says so. Options of PETSc and "
                  "SLEPc count with the prefix `reduction_`, such as `PETSC_OPTIONS=\"-reduction_eps_view\"`; a frame "
                  "found in the cache was made without them"),
      key::truth("inertia_relief", false,
                 "with the static deflections under the inertia of rigid motions, up to six shapes more. Statics of a "
                 "frame that floats and accelerates as a whole, and of any frame under weight, are exact then, "
                 "whatever the number of modes")};
  return keys;
}

const std::vector<Key> &start_keys()
{
  const std::string             rotors = "steady, without joints: of rotors, ";
  static const std::vector<Key> keys   = {
        key::choice("rule", {"given", "static", "steady", "periodic"}, true,
                    "a state as given, static equilibrium, steady motion, or on the periodic motion that `gestell "
                      "periodic` finds from the state that the other keys tell, as given or steady"),
        coordinates(
            "q", kind::length, kind::angle,
            "given and steady, of a static start first guesses: values of coordinates and measures, `{ crank = \"120 "
              "deg\", \"boom.angle\" = \"5 deg\", \"frame.crown.uz\" = \"-0.6 mm\" }`")
            .by_default("0"),
        coordinates("v", kind::speed, kind::angular_speed, "given and steady: their rates; of a static start warned of")
            .by_default("0"),
        key::truth("drift", false, "static: with the velocity of the quasi-static drift").into(&StartRequest::drift),
        key::truth("inertia_relief", false,
                   "static: loads along motions that nothing holds are taken by the inertia of the machine; without it "
                     "they are refused")
            .into(&StartRequest::inertia_relief),
        key::map("angles", kind::angle, {}, rotors + "`{ crank = \"120 deg\" }`")
            .by_default("by the balance of the `driver`"),
        key::map("speeds", kind::angular_speed, {}, rotors + "`{ crank = \"30 rpm\" }`").by_default("0"),
        key::named("driver", "steady, without joints: the rotor that makes up for what the drive lacks")
            .by_default("a given angle")};
  return keys;
}

const std::vector<Key> &modes_keys()
{
  static const std::vector<Key> keys = {
      coordinates("at", kind::length, kind::angle,
                  "configuration, `{ crank = \"160 deg\" }`. It is not looked for: the place of a static start, or any "
                  "other equilibrium, is to be given here")
          .by_default("0; with joints the start"),
      key::plain("open", Key::Form::texts,
                 "names of elements taken as open: play not closed, rope slack; what acts all the same, such as the "
                 "oil film of a rod, stays. An element that acts in every position is refused")
          .by_default("none"),
      key::plain(
          "number", Key::Form::whole,
          "how many; 0: none, so that a run tells its motion alone. Runs of more than 600 coordinates leave them "
          "out by themselves, and say so")
          .by_default(&ModesRequest::number)};
  return keys;
}

} // namespace gestell::apps
