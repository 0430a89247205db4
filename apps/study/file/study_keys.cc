#include "apps/study/file/study_keys.h"

#include "apps/study/designs/make_design.h"

namespace gestell::apps
{

const std::vector<Key> &study_keys()
{
  static const std::vector<Key> keys = {
      key::plain("name", Key::Form::text, "names the folder of the results").by_default("name of the file"),
      key::plain("description", Key::Form::text, "one line for the report").by_default("none"),
      key::plain("extends", Key::Form::file, "study whose entries hold where this one has none").by_default("none"),
      key::truth("keep", false, "writes the results of every run into `run_1`, `run_2`, ... besides its row"),
      key::table("scene", {}, "the scene").by_default(""),
      key::table("variables", {}, "`[variables.NAME]`").by_default(""),
      key::plain("outputs", Key::Form::map,
                 "`NAME = \"signals.F.max\"`, or a [formula](study.md#outputs) of such entries, other outputs, "
                 "variables and parameters"),
      key::table("design", {}, "which runs are made").by_default(""),
      key::table("surface", {}, "response surfaces of the outputs").by_default("none"),
      key::table("optimise", {}, "what is looked for").by_default("none"),
      key::table("choose", {}, "which of the runs is the best").by_default("none")};
  return keys;
}

const std::vector<Key> &study_scene_keys()
{
  static const std::vector<Key> keys = {
      key::plain("file", Key::Form::file, "the scene, relative to the study"),
      key::plain(
          "measure", Key::Form::map,
          "parameters of the scene that its run tells, `t_0 = \"events.limiter.first\"`; the value of the scene is "
          "a first guess")
          .by_default("none"),
      key::plain("set", Key::Form::map, "entries of the scene that hold in place of its own, `\"run.step\" = \"5 us\"`")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_variable_keys()
{
  static const std::vector<Key> keys = {
      key::plain("key", Key::Form::texts,
                 "entry of the scene, such as `element.rod.stiffness`, or several that take "
                 "the same value")
          .by_default("`parameters.NAME`"),
      key::plain("from", Key::Form::quantity, "coded value -1").by_default("`levels`"),
      key::plain("to", Key::Form::quantity, "coded value +1").by_default("`levels`"),
      key::plain("levels", Key::Form::texts,
                 "values that a factorial takes: numbers, texts with a unit, words, or files with the value that each "
                 "stands for, `{ file = \"walls_15.step\", value = \"15 mm\" }`")
          .by_default("`from`, `to`"),
      key::plain("choices", Key::Form::map,
                 "named values of any form in place of levels, tables as well, `{ soft = { ... }, hard = { ... } }`")
          .by_default("none"),
      key::plain("unit", Key::Form::text, "of plain numbers").by_default("that of `from` or of the first level"),
      key::choice("scatter", {"none", "uniform", "normal"}, true,
                  "how it scatters about its value, for robust figures"),
      key::plain("width", Key::Form::quantity, "half width of a uniform scatter, standard deviation of a normal one")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_design_keys()
{
  static const std::vector<Key> keys = {
      key::choice("type", design_types(), false, "how the runs are spread over the variables"),
      key::plain("runs", Key::Form::whole, "how many: of a Latin hypercube and of Sobol points").by_default("none"),
      key::plain("levels", Key::Form::whole, "of a full factorial design, for variables without levels of their own")
          .by_default("2"),
      key::plain("centre_points", Key::Form::whole, "further runs with all variables in the middle").by_default("0"),
      key::choice("star", star_names(), true,
                  "how far the star points of a central composite design lie from its centre"),
      key::number("alpha", kind::number, "this distance, as a number").above_zero().by_default("by `star`"),
      key::plain("seed", Key::Form::whole, "of a Latin hypercube and of Sobol points; equal seeds, equal designs")
          .by_default("0"),
      key::plain("columns", Key::Form::texts,
                 "of a list: variables whose values stand in `rows`; the others have "
                 "`levels`, and each row is repeated for each of them")
          .by_default("all variables"),
      key::plain("rows", Key::Form::rows, "of a list: `[[\"900 kN/mm\", \"0.4 mm\"], ...]`, one row a run")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_surface_keys()
{
  static const std::vector<Key> keys = {
      key::choice("order", {"quadratic", "interactions", "linear"}, true, "which terms the surfaces have"),
      key::number("confidence", kind::number, "of the intervals about coefficients, above 0 and below 1")
          .by_default(0.95),
      key::plain("outputs", Key::Form::texts, "that get a surface").by_default("all")};
  return keys;
}

const std::vector<Key> &study_goal_keys()
{
  static const std::vector<Key> keys = {
      key::choice("sense", {"minimise", "maximise"}, true, "which way is better"),
      key::number("weight", kind::number, "in the sum of all goals").above_zero().by_default(1.),
      key::plain("scale", Key::Form::quantity, "what the output is divided by").by_default("1")};
  return keys;
}

const std::vector<Key> &study_limit_keys()
{
  static const std::vector<Key> keys = {
      key::plain("least", Key::Form::quantity, "the output must not fall below").by_default("none"),
      key::plain("most", Key::Form::quantity, "the output must not rise above").by_default("none")};
  return keys;
}

const std::vector<Key> &study_robust_keys()
{
  static const std::vector<Key> keys = {
      key::choice("on", {"surface", "runs"}, true, "where the draws are computed"),
      key::plain("draws", Key::Form::whole, "of the scattered variables").by_default("10000; 100 runs"),
      key::plain("seed", Key::Form::whole, "of the draws").by_default("1")};
  return keys;
}

const std::vector<Key> &study_optimise_keys()
{
  static const std::vector<Key> keys = {
      key::choice("on", {"surface", "runs"}, true, "what the search asks: the surfaces, or a run at each point"),
      key::table("goals", {}, "`[optimise.goals.OUTPUT]`: the weighted sum of these is made small").by_default(""),
      key::table("limits", {}, "`[optimise.limits.OUTPUT]`").by_default("none"),
      key::choice("method", {"gradient", "derivative-free"}, true,
                  "sequential quadratic programming, or quadratic and linear models through earlier points"),
      key::plain("starts", Key::Form::whole, "searches; the first in the middle of all ranges").by_default("5"),
      key::plain("seed", Key::Form::whole, "of the other starts").by_default("1"),
      key::plain("most_runs", Key::Form::whole, "points of a search").by_default("1000; 60 runs"),
      key::truth("verify", true, "a run at the optimum of the surfaces tells what they are worth"),
      key::plain("pareto", Key::Form::whole, "points of the front of all goals, on the surfaces").by_default("none"),
      key::table("robust", study_robust_keys(), "what the scatter of variables makes of the outputs at the optimum")
          .by_default("none")};
  return keys;
}

const std::vector<Key> &study_choose_keys()
{
  static const std::vector<Key> keys = {
      key::table("goals", {}, "`[choose.goals.OUTPUT]`, as of `[optimise]`").by_default(""),
      key::table("limits", {}, "`[choose.limits.OUTPUT]`, as of `[optimise]`").by_default("none"),
      key::plain("over", Key::Form::text, "output over which those of goals and limits are drawn").by_default("none"),
      key::plain("by", Key::Form::texts, "variables whose words part the runs into families, a curve each")
          .by_default("one family")};
  return keys;
}

} // namespace gestell::apps
