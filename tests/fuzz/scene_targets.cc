#include "tests/fuzz/target.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"
#include "apps/scene/language/parse_expression.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/scene.h"
#include "apps/study/file/read_design.h"
#include "apps/study/file/study_file.h"
#include "apps/verify/read_cases.h"

#include <cmath>
#include <optional>

namespace gestell::fuzz
{
namespace
{

using namespace gestell::apps;

/// Frames of files are judged where they are read; here a scene is all there is.
bool is_lumped(const Scene &scene)
{
  const FramePath path = frame_path(scene);
  return path == FramePath::none || path == FramePath::dense;
}

void read_whole_scene(const std::string &bytes)
{
  const Scene scene = read_scene(file_of("fed.toml", bytes));
  if (is_lumped(scene))
    check_scene(scene);
}

void read_an_override(const std::string &bytes)
{
  static const SceneNode base = parse_toml_text("[parameters]\nload = \"2 kg\"\nc = \"3 kN/m\"\n[body.mass]\n"
                                                "type = \"slider\"\nmass = \"load\"\naxis = [1, 0, 0]\n"
                                                "[element.spring]\ntype = \"spring-damper\"\nfrom = \"mass\"\n"
                                                "to = \"ground\"\nstiffness = \"c\"\n[run]\nmethod = \"bdf\"\n"
                                                "step = \"1 ms\"\nend = \"1 s\"\n[output.signals]\n"
                                                "x = \"mass.displacement\"\n",
                                                "scene.toml", "");
  SceneNode              root = base;
  apply_override(root, bytes);
  const Scene scene = read_scene(root, "scene.toml", fem::Scripts::harmless);
  if (is_lumped(scene))
    check_scene(scene);
}

std::optional<Quantity> parameter(const std::string &name)
{
  if (name == "l")
    return Quantity{0.8, {1, 0, 0}, true, Counts::nothing};
  if (name == "k")
    return Quantity{3., {}, false, Counts::nothing};
  return std::nullopt;
}

/// As the value of a key, and as a formula of displacement and time.
void read_an_expression(const std::string &bytes)
{
  const std::vector<std::string> names{"l", "k"};
  const std::vector<Variable>    variables{{"u", "displacement", {1, 0, 0}, Counts::nothing},
                                        {"t", "time", {0, 0, 1}, Counts::nothing}};
  try
  {
    const Quantity value = parse_quantity(bytes, parameter, names, &kind::length);
    promise(std::isfinite(value.value), "the value of an expression is not finite");
    value_as(value, kind::angular_speed, bytes);
  }
  catch (const std::invalid_argument &)
  {
  }
  const Expression e = parse_expression(bytes, variables, parameter, names, &kind::force);
  promise(!e.is_value() || std::isfinite(e.formula.constant()), "the value of a formula is not finite");
}

/// The nodes of a frame of three masses one above the other, whose matrices are sound.
void read_a_node_table(const std::string &bytes)
{
  static const std::string scene =
      file_of("chain.toml", "[frame]\nmass = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
                            "stiffness = [[2, -1, 0], [-1, 2, -1], [0, -1, 1]]\nnodes = \"nodes.csv\"\n"
                            "[output.signals]\nz = \"frame.top.uz\"\n");
  file_of("nodes.csv", bytes);
  const Scene read = read_scene(scene);
  for (const auto &point : read.frame.matrices.picture.points)
    for (const double x : point)
      promise(std::isfinite(x), "a node without a finite place");
}

void read_a_study(const std::string &bytes)
{
  static const std::string scene = file_of("scene.toml", "[body.mass]\ntype = \"slider\"\nmass = \"2 kg\"\n");
  read_design(read_study(file_of("study.toml", bytes), {}));
}

void read_reference_cases(const std::string &bytes)
{
  read_cases(file_of("cases.toml", bytes));
}

} // namespace

std::vector<Target> scene_targets()
{
  return {{"scene", read_whole_scene},        {"node_table", read_a_node_table}, {"override", read_an_override},
          {"expression", read_an_expression}, {"study", read_a_study},           {"cases", read_reference_cases}};
}

} // namespace gestell::fuzz
