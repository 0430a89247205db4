// Shocks on a reduced frame: the doubt that `run` tells, against the same run with many more modes.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A steel plate of 0.8 x 0.6 x 0.01 m between two walls; 1 kN is set down in its middle within 1 ms.
const std::string plate_scene =
    "name = 'plate'\n" + cad_frame("plate.geo", "0.1 m", {{"damping", "{ ratio = 0.01 }"}}) +
    plane_surface("walls", "[1, 0, 0]", "[0.8, 0, 0]") + plane_surface("other", "[-1, 0, 0]", "[0, 0, 0]") +
    plane_surface("pad", "[0, 0, 1]", "[0, 0, 0.01]") +
    "box = { min = [0.34, 0.24, 0.009], max = [0.46, 0.36, 0.011] }\n" +
    table("frame.support.walls", {{"surfaces", "['walls', 'other']"}, {"clamped", "true"}}) +
    table("frame.interface.pad", {{"surface", "pad"}, {"coupling", "average"}}) +
    steps("20 us", "30 ms", {{"method", "bdf"}, {"order", "2"}}) + signals("z = 'frame.pad.uz'", {{"step", "20 us"}});

/// @param direction  of a load on a slider, which knows its own: none
std::string load_on(const std::string &body, const Keys &direction = {{"direction", "[0, 0, -1]"}})
{
  return table("element.load",
               {{"type", "table force"},
                {"from", body},
                {"to", "ground"},
                {"against", "time"},
                {"table", "[['0 s', 0], ['1 ms', 0], ['2 ms', '1 kN'], ['1 s', '1 kN']]"}},
               direction);
}

/// Fastened by an ideal joint.
const std::string hammer =
    rigid_body("hammer", "0.05 kg", "['1e-5 kg m^2', '1e-5 kg m^2', '1e-5 kg m^2']", "['0.4 m', '0.3 m', '0.01 m']") +
    joint("bolt", "rigid", "frame.pad", "hammer", "['0.4 m', '0.3 m', '0.01 m']");

/// On a stiff spring.
const std::string tool =
    slider_body("tool", "0.05 kg", "[0, 0, -1]", {{"guide", "frame.pad"}}) +
    element("mount", "spring-damper",
            {{"from", "tool"}, {"to", "frame.pad"}, {"stiffness", "1e8 N/m"}, {"damping", "500 N s/m"}});

struct Way
{
  std::string name, scene;
};

void PrintTo(const Way &way, std::ostream *out)
{
  *out << way.name;
}

class Shock : public ::testing::TestWithParam<Way>
{
protected:
  Answer run(const std::string &frequency)
  {
    folder_.file("plate.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.8, 0.6, 0.01};\n"
                              "Rectangle(20) = {0.35, 0.25, 0.01, 0.1, 0.1};\n"
                              "BooleanFragments{ Volume{1}; Delete; }{ Surface{20}; Delete; }\n");
    const Answer answer = gestell("run " + folder_.file("scene.toml", plate_scene + GetParam().scene) +
                                  folder_.option() + " --set reduction.frequency='\"" + frequency + "\"'");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    return answer;
  }

  std::vector<double> history() const
  {
    const CsvTable      table((folder_.results() / "history.csv").string());
    std::vector<double> z(table.rows());
    for (int i = 0; i < table.rows(); ++i)
      z[i] = table.number(i, "z [m]");
    return z;
  }

  Folder folder_{"force_bandwidth_check"};
};

TEST_P(Shock, IsReportedWithTheErrorThatManyMoreModesShow)
{
  const Answer rough   = run("60 Hz");
  const auto   model   = history();
  const Answer fine    = run("4000 Hz");
  const auto   truth   = history();
  double       largest = 0., deflection = 0.;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    largest    = std::max(largest, std::abs(model[i] - truth[i]));
    deflection = std::max(deflection, std::abs(truth[i]));
  }
  const std::size_t about = rough.text.find(", about ");
  ASSERT_NE(about, std::string::npos) << rough.text;
  const double reported = 0.01 * std::strtod(rough.text.c_str() + about + 8, nullptr), error = largest / deflection;
  EXPECT_GT(error, 0.05);
  EXPECT_GT(reported, 0.5 * error);
  EXPECT_LT(reported, 2. * error);
  EXPECT_FALSE(fine.says("forces change faster")) << fine.text;
  // What is in doubt of directions in which the joint hardly works is no matter.
  EXPECT_FALSE(run("600 Hz").says("forces change faster"));
}

INSTANTIATE_TEST_SUITE_P(Ways, Shock,
                         ::testing::Values(Way{"OnThePad", load_on("frame.pad")},
                                           Way{"ByAJoint", hammer + load_on("hammer")},
                                           Way{"ByASpring", tool + load_on("tool", {})}),
                         [](const auto &way) { return way.param.name; });

} // namespace
} // namespace gestell::tests
