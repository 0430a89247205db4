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
      key::plain("name", Key::Form::text, "name of the folder of results").by_default("name of the file"),
      key::plain("description", Key::Form::text, "description, one line for the report").by_default("none"),
      key::vector("gravity", kind::acceleration, "gravity, acting on the frame and all masses").by_default("[0, 0, 0]"),
      key::plain("extends", Key::Form::file, "base scene, whose keys apply unless this scene sets them")
          .by_default("none"),
      key::plain("without", Key::Form::texts, "keys of the base scene that are left out, `[\"joint.cylinder\"]`")
          .by_default("none"),
      key::plain("parameters", Key::Form::map, "[parameters](scene/values.md#values) for expressions")
          .by_default("none"),
      one_of("material", "`[material.NAME]`"),
      one_of("frame", "the frame"),
      one_of("reduction", "reduction of the frame"),
      one_of("body", "`[body.NAME]`"),
      one_of("place", "`[place.NAME]`"),
      one_of("measure", "`[measure.NAME]`"),
      one_of("element", "`[element.NAME]`"),
      one_of("joint", "`[joint.NAME]`"),
      one_of("switch", "`[switch.NAME]`"),
      one_of("run", "time integration"),
      one_of("start", "initial state"),
      one_of("modes", "modes of the machine"),
      one_of("output", "output: signals, stresses, intervals"),
      one_of("life", "fatigue of the frame")};
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
          "`\"craig-bampton\"`: static shapes of the interface and fixed-interface modes. `\"free-interface\"`: static "
          "shapes and modes of the frame as supported, which the reduced frame has exactly. `\"guyan\"`: static shapes "
          "only, exact in statics; a [note](../../theory/reduction.md#static-condensation) lists fixed-interface modes "
          "below `frequency`. `\"modal\"`: superposition of [modes of frame and "
          "mechanism](../../theory/reduction.md#modal-superposition), all with frequencies above zero. "
          "`\"condensation\"` (or "
          "`\"none\"`): the full frame, each step "
          "[condensed](../../theory/integration.md#condensation-to-the-measures) to the DOFs on which the mechanism "
          "acts: exact, but slower by orders of magnitude; this is also the default for matrices without "
          "`[reduction]`. Its other keys define the reduced frame used for modes, static initial state and pictures. A "
          "key that does not apply to the method is an error"),
      key::number("tolerance", kind::number,
                  "tolerated relative error of the interface receptance up to `frequency`, or without `frequency` of "
                  "the twelve lowest frequencies; determines the number of modes. Static shapes under inertia (at most "
                  "one per interface DOF) or under damper forces may replace modes; "
                  "[tested](../../theory/reduction.md#how-many-modes-for-the-interface) from 0.05 to 1e-5, with "
                  "dampers up to 200 times as stiff as the supports next to them. The error is one number for all "
                  "interfaces (Frobenius norm, each DOF scaled by its inertia): a much stiffer interface may have a "
                  "larger error; the worst one is listed separately. A note is printed if the tolerance cannot be "
                  "reached. For `\"modal\"`: tolerated share of the static deflections")
          .as_share()
          .by_default(ReductionRequest().options.tolerance),
      key::plain("modes", Key::Form::whole,
                 "fixed number of modes, instead of `tolerance`; with both and no `frequency`, `tolerance` determines "
                 "the valid frequency range. Default for `\"free-interface\"`: all modes up to 1.5 times `frequency`, "
                 "or twelve elastic modes; for `\"modal\"`: all modes up to four times the highest load frequency, and "
                 "more if `tolerance` requires them. A note gives the error up to `frequency`, or states that the "
                 "retained modes end below it")
          .by_default("by `tolerance`"),
      key::number("frequency", kind::frequency,
                  "highest frequency of interest; for `\"modal\"` that of the highest retained mode. Default for "
                  "`\"guyan\"`: the range in which frequencies are within `tolerance`")
          .above_zero()
          .by_default("automatic"),
      key::choice("inside", {"fixed-interface", "free-interface"}, true,
                  "only with `\"craig-bampton\"`; `\"free-interface\"` selects the method of that name"),
      key::choice("damping", {"full", "diagonal"}, true,
                  "for `\"modal\"`; `\"diagonal\"` neglects the damping that couples modes"),
      key::choice("factor", {"gestell", "cholmod", "mumps"}, true,
                  "solver that factorises the stiffness, for all solutions and modes; results agree up to rounding. "
                  "`\"gestell\"`, `\"cholmod\"`: one process; `\"mumps\"`: any number of ranks of `mpirun`")
          .by_default("`\"gestell\"`, on several ranks `\"mumps\"`"),
      key::choice(
          "eigensolver", {"block-lanczos", "krylov-schur", "lobpcg"}, true,
          "eigensolver; `\"krylov-schur\"` and `\"lobpcg\"` of SLEPc need more time for the same modes, and "
          "`\"lobpcg\"` may break down by rounding, with a message. Options of PETSc and SLEPc have the prefix "
          "`reduction_`, such as `PETSC_OPTIONS=\"-reduction_eps_view\"`; frames in the cache were made without them"),
      key::truth(
          "inertia_relief", false,
          "add static deflections under the inertia of rigid-body motions, at most six shapes. Static deflections of "
          "an unsupported accelerated frame, and of any frame under weight, are then exact for any number of modes")};
  return keys;
}

const std::vector<Key> &start_keys()
{
  const std::string             rotors = " of rotors, for `\"steady\"` without joints: ";
  static const std::vector<Key> keys   = {
        key::choice("rule", {"given", "static", "steady", "periodic"}, true,
                    "initial state: as given, static equilibrium, steady motion, or on the periodic solution that "
                      "`gestell periodic` finds from the given or steady state"),
        coordinates(
            "q", kind::length, kind::angle,
            "values of coordinates and measures for `\"given\"` and `\"steady\"`, first guesses for `\"static\"`: `{ "
              "crank = \"120 deg\", \"boom.angle\" = \"5 deg\", \"frame.crown.uz\" = \"-0.6 mm\" }`")
            .by_default("0"),
        coordinates("v", kind::speed, kind::angular_speed,
                    "rates of coordinates and measures for `\"given\"` and `\"steady\"`; a warning for `\"static\"`")
            .by_default("0"),
        key::truth("drift", false, "for `\"static\"`: start with the velocity of the quasi-static drift")
            .into(&StartRequest::drift),
        key::truth("inertia_relief", false,
                   "for `\"static\"`: loads on unconstrained DOFs are balanced by the inertia of the machine; otherwise "
                     "they are an error")
            .into(&StartRequest::inertia_relief),
        key::map("angles", kind::angle, {}, "angles" + rotors + "`{ crank = \"120 deg\" }`")
            .by_default("by the balance of the `driver`"),
        key::map("speeds", kind::angular_speed, {}, "speeds" + rotors + "`{ crank = \"30 rpm\" }`").by_default("0"),
        key::named("driver", "for `\"steady\"` without joints: rotor whose angle follows from the torque balance")
            .by_default("a given angle")};
  return keys;
}

const std::vector<Key> &modes_keys()
{
  static const std::vector<Key> keys = {
      coordinates("at", kind::length, kind::angle,
                  "configuration, `{ crank = \"160 deg\" }`. No equilibrium search is made: for that of a static "
                  "initial state, or any other equilibrium, give it here")
          .by_default("0; with joints the initial state"),
      key::plain("open", Key::Form::texts,
                 "names of elements that are open: play not closed, rope slack; parts that always act, such as the oil "
                 "film of a rod, remain. An element that acts in every position is an error")
          .by_default("none"),
      key::plain("number", Key::Form::whole,
                 "number of modes; 0: a run computes none. Runs of machines with more than 600 DOFs omit them, "
                 "with a note")
          .by_default(&ModesRequest::number)};
  return keys;
}

} // namespace gestell::apps
