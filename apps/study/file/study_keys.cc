#include "apps/study/file/study_keys.h"

#include "apps/study/designs/make_design.h"

namespace gestell::apps
{

const std::vector<Key> &study_keys()
{
  static const std::vector<Key> keys = {
      key::plain("name", Key::Form::text, "name of the folder of results").by_default("name of the file"),
      key::plain("description", Key::Form::text, "description, one line for the report").by_default("none"),
      key::plain("extends", Key::Form::file, "base study, whose keys apply unless this study sets them")
          .by_default("none"),
      key::truth("keep", false, "write all results of every run into `run_1`, `run_2`, ..., in addition to its row"),
      key::table("scene", {}, "the scene").by_default(""),
      key::table("variables", {}, "`[variables.NAME]`").by_default(""),
      key::plain("outputs", Key::Form::map,
                 "`NAME = \"signals.F.max\"`, or a [formula](study.md#outputs) of such results, other outputs, "
                 "variables and parameters"),
      key::table("design", {}, "design: the set of runs").by_default(""),
      key::table("surface", {}, "response surfaces of the outputs").by_default("none"),
      key::table("optimise", {}, "optimisation").by_default("none"),
      key::table("choose", {}, "selection of the best run").by_default("none")};
  return keys;
}

const std::vector<Key> &study_scene_keys()
{
  static const std::vector<Key> keys = {
      key::plain("file", Key::Form::file, "file of the scene, relative to the study"),
      key::plain("measure", Key::Form::map,
                 "parameters of the scene that are results of its run, `t_0 = \"events.limiter.first\"`; the value in "
                 "the scene is a first guess")
          .by_default("none"),
      key::plain("set", Key::Form::map, "keys that replace those of the scene, `\"run.step\" = \"5 us\"`")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_variable_keys()
{
  static const std::vector<Key> keys = {
      key::plain("key", Key::Form::texts, "scene key, such as `element.rod.stiffness`, or several with the same value")
          .by_default("`parameters.NAME`"),
      key::plain("from", Key::Form::quantity, "coded value -1").by_default("`levels`"),
      key::plain("to", Key::Form::quantity, "coded value +1").by_default("`levels`"),
      key::plain("levels", Key::Form::texts,
                 "levels of a factorial design: numbers, strings with a unit, words, or files with the value of each, "
                 "`{ file = \"walls_15.step\", value = \"15 mm\" }`")
          .by_default("`from`, `to`"),
      key::plain("choices", Key::Form::map,
                 "named values of any type, also tables, instead of levels: `{ soft = { ... }, hard = { ... } }`")
          .by_default("none"),
      key::plain("unit", Key::Form::text, "unit of plain numbers").by_default("that of `from` or of the first level"),
      key::choice("scatter", {"none", "uniform", "normal"}, true,
                  "distribution of the scatter about the value, for robust results"),
      key::plain("width", Key::Form::quantity,
                 "half width of a uniform distribution, standard deviation of a normal distribution")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_design_keys()
{
  static const std::vector<Key> keys = {
      key::choice("type", design_types(), false, "type of the design"),
      key::plain("runs", Key::Form::whole, "number of runs of a Latin hypercube or of Sobol points").by_default("none"),
      key::plain("levels", Key::Form::whole,
                 "number of levels in a full factorial design, for variables without `levels`")
          .by_default("2"),
      key::plain("centre_points", Key::Form::whole, "number of further runs with all variables at their midpoints")
          .by_default("0"),
      key::choice("star", star_names(), true, "distance of the star points of a central composite design"),
      key::number("alpha", kind::number, "distance of the star points as a number")
          .above_zero()
          .by_default("by `star`"),
      key::plain("seed", Key::Form::whole,
                 "seed of a Latin hypercube or of Sobol points; equal seeds give equal designs")
          .by_default("0"),
      key::plain(
          "columns", Key::Form::texts,
          "for a list: variables with values in `rows`; each row is repeated for all `levels` of the other variables")
          .by_default("all variables"),
      key::plain("rows", Key::Form::rows, "for a list: `[[\"900 kN/mm\", \"0.4 mm\"], ...]`, one row per run")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_surface_keys()
{
  static const std::vector<Key> keys = {
      key::choice("order", {"quadratic", "interactions", "linear"}, true, "terms of the response surfaces"),
      key::number("confidence", kind::number, "confidence level of the coefficients, above 0 and below 1")
          .by_default(0.95),
      key::plain("outputs", Key::Form::texts, "outputs with a surface").by_default("all")};
  return keys;
}

const std::vector<Key> &study_goal_keys()
{
  static const std::vector<Key> keys = {
      key::choice("sense", {"minimise", "maximise"}, true, "direction of improvement"),
      key::number("weight", kind::number, "weight in the sum of all goals").above_zero().by_default(1.),
      key::plain("scale", Key::Form::quantity, "scale by which the output is divided").by_default("1")};
  return keys;
}

const std::vector<Key> &study_limit_keys()
{
  static const std::vector<Key> keys = {
      key::plain("least", Key::Form::quantity, "lower limit of the output").by_default("none"),
      key::plain("most", Key::Form::quantity, "upper limit of the output").by_default("none")};
  return keys;
}

const std::vector<Key> &study_robust_keys()
{
  static const std::vector<Key> keys = {
      key::choice("on", {"surface", "runs"}, true, "evaluation of the draws: on the response surfaces, or by runs"),
      key::plain("draws", Key::Form::whole, "number of draws of the scattered variables").by_default("10000; 100 runs"),
      key::plain("seed", Key::Form::whole, "seed of the draws").by_default("1")};
  return keys;
}

const std::vector<Key> &study_optimise_keys()
{
  static const std::vector<Key> keys = {
      key::choice("on", {"surface", "runs"}, true, "model of the search: the surfaces, or a run at each point"),
      key::table("goals", {}, "`[optimise.goals.OUTPUT]`: their weighted sum is minimised").by_default(""),
      key::table("limits", {}, "`[optimise.limits.OUTPUT]`").by_default("none"),
      key::choice("method", {"gradient", "derivative-free"}, true,
                  "method: sequential quadratic programming, or quadratic or linear interpolation of earlier points"),
      key::plain("starts", Key::Form::whole, "number of searches; the first starts at the midpoints of all ranges")
          .by_default("5"),
      key::plain("seed", Key::Form::whole, "seed of the other starting points").by_default("1"),
      key::plain("most_runs", Key::Form::whole, "maximum number of points of a search").by_default("1000; 60 runs"),
      key::truth("verify", true, "verify the optimum of the surfaces by a run"),
      key::plain("pareto", Key::Form::whole,
                 "number of points of the Pareto front of all goals, computed on the response surfaces")
          .by_default("none"),
      key::table("robust", study_robust_keys(), "effect of the scatter of variables on the outputs at the optimum")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_choose_keys()
{
  static const std::vector<Key> keys = {
      key::table("goals", {}, "`[choose.goals.OUTPUT]`, as in `[optimise]`").by_default(""),
      key::table("limits", {}, "`[choose.limits.OUTPUT]`, as in `[optimise]`").by_default("none"),
      key::plain("over", Key::Form::text, "output on the horizontal axis of the charts of goals and limits")
          .by_default("none"),
      key::plain("by", Key::Form::texts, "variables whose values divide the runs into families, one curve each")
          .by_default("one family")};
  return keys;
}

} // namespace gestell::apps
