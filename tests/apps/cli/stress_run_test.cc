// From a CAD file to the largest stress, through the program.

#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

constexpr double length = 2., width = 0.2, height = 0.25, force = 2e4;

/// A bar along x, clamped at its end, whose tip is pressed down by a force spread over its end face.
std::string bar(const std::string &stress, const std::string &begin = "rule = 'static'")
{
  return "name = 'bar'\n" +
         table("frame", {{"cad", "bar.geo"},
                         {"unit", "1 m"},
                         {"mesh", "{ size = '0.1 m' }"},
                         {"material", "{ E = '210 GPa', nu = 0, rho = '7850 kg/m^3' }"},
                         {"damping", "{ ratio = 0.05 }"}}) +
         plane_surface("wall", "[-1, 0, 0]", "[0, 0, 0]") + plane_surface("end", "[1, 0, 0]", "[2, 0, 0]") +
         table("frame.support.wall", {{"surface", "wall"}, {"clamped", "true"}}) +
         table("frame.interface.tip", {{"surface", "end"}, {"coupling", "average"}}) +
         element("load", "force", {{"from", "frame.tip"}, {"direction", "[0, 0, -1]"}, {"constant", "20 kN"}}) +
         start(begin) + steps("0.1 ms", "60 ms") + "[output.signals]\nu = '-frame.tip.uz'\n" + stress;
}

const std::string solid = "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 0.2, 0.25};";

/// The same bar in 16 x 2 x 2 hexahedra.
const std::string bricks = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 0.2};
Transfinite Curve{1, 3} = 17;
Transfinite Curve{2, 4} = 3;
Transfinite Surface{1};
Recombine Surface{1};
Extrude {0, 0, 0.25} { Surface{1}; Layers{2}; Recombine; }
Mesh 3;
)";

std::string run(const Folder &folder, const std::string &scene, const std::string &drawing = solid)
{
  folder.file("bar.geo", drawing);
  const Answer answer = gestell("run " + folder.file("bar.toml", scene) + folder.option());
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  return read(folder.results() / "summary.json");
}

/// sigma = F (l - x) h/2 / I at the edge of a beam.
double at_edge(double x)
{
  return force * (length - x) * 0.5 * height / (width * std::pow(height, 3) / 12.);
}

TEST(StressRun, OfABarAtRestIsThatOfABeam)
{
  const Folder      folder("stress_static");
  const std::string summary = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"));
  const double      x       = json_number(summary, {"stress", "largest", "at"});
  EXPECT_LT(x, 0.2) << "near the wall, but not in its elements";
  EXPECT_NEAR(json_number(summary, {"stress", "largest", "von_mises"}), at_edge(x), 0.05 * at_edge(x));
  EXPECT_LT(json_number(summary, {"stress", "largest", "disagreement"}), 0.2);
  EXPECT_NEAR(json_number(summary, {"stress", "beside_rigid", "von_mises"}), at_edge(0.), 0.15 * at_edge(0.));
  for (const char *name : {"stress.pvd", "stress/stress_00001.vtp"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / name)) << name;
  EXPECT_NE(read(folder.results() / "report.html").find("data-show=\"stress-1\""), std::string::npos);
}

TEST(StressRun, OfHexahedraInBendingIsThatOfABeam)
{
  // Cubic deflections are beyond quadratic cells, by (h / L)^2 / 12 of the curvature or so: 3e-4 of 16 cells.
  const Folder      folder("stress_hexahedra");
  const std::string summary = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"), bricks);
  const double      x       = json_number(summary, {"stress", "largest", "at"});
  EXPECT_EQ(x, 0.25) << "two cells from the wall";
  EXPECT_NEAR(json_number(summary, {"stress", "largest", "von_mises"}), at_edge(x), 1e-3 * at_edge(x));
  EXPECT_NEAR(json_number(summary, {"stress", "largest", "principal"}), at_edge(x), 1e-3 * at_edge(x));
  EXPECT_LT(json_number(summary, {"stress", "largest", "disagreement"}), 0.01);
}

TEST(StressRun, OfHexahedraUnderTheirWeightIsExact)
{
  // Along the bar sigma = rho g (L - x): the displacement is quadratic, as the cells are.  Stresses of modes are kept
  // in single precision.
  const Folder folder("stress_weight");
  std::string  scene = bar("[output.stress]\nat = [\"10 ms\"]\n");
  scene.replace(scene.find("20 kN"), 5, "0 kN");
  const std::string summary = run(folder, "gravity = [10, 0, 0]\n" + scene, bricks);
  const double      x       = json_number(summary, {"stress", "largest", "at"});
  EXPECT_NEAR(json_number(summary, {"stress", "largest", "von_mises"}), 7850. * 10. * (length - x), 1e-5 * 7850. * 20.);
  EXPECT_NEAR(json_number(summary, {"stress", "beside_rigid", "von_mises"}), 7850. * 10. * length, 1e-5 * 7850. * 20.);
}

TEST(StressRun, OfASuddenLoadIsTwiceThatOfASlowOneButForDamping)
{
  // One mode, damping ratio 0.05: overshoot 1 + exp(-pi zeta) = 1.85; higher modes bend the root a little more.
  const Folder      folder("stress_sudden");
  const std::string summary = run(folder, bar("[output.stress]\nlargest = [\"stress\", \"u\"]\n", ""));
  const double      x       = json_number(summary, {"stress", "largest", "at"});
  const double      share   = json_number(summary, {"stress", "largest", "von_mises"}) / at_edge(x);
  EXPECT_GT(share, 1.7);
  EXPECT_LT(share, 2.3);
  EXPECT_EQ(json_number(summary, {"stress", "states"}), 601. + 1.) << "every step, and the peak of u";
}

TEST(StressRun, AWarmStartTakesTheStressesFromTheCache)
{
  const Folder      folder("stress_warm");
  const std::string cold = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"));
  const std::string warm = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"));
  EXPECT_EQ(json_number(cold, {"stress", "largest", "von_mises"}),
            json_number(warm, {"stress", "largest", "von_mises"}));
}

TEST(StressRun, AReducedFrameWrittenWithoutStressesIsRefused)
{
  const Folder folder("stress_file");
  folder.file("bar.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 0.2, 0.25};");
  ASSERT_EQ(gestell("reduce " + folder.file("bar.toml", bar("")) + folder.option()).exit_code, 0);
  std::string       scene = bar("[output.stress]\n");
  const std::size_t begin = scene.find("cad "), end = scene.find("[element.load]");
  scene.replace(begin, end - begin, "reduced = \"" + (folder.results() / "reduced_frame.h5").string() + "\"\n");
  expect_answer(gestell("run " + folder.file("again.toml", scene) + folder.option()), 2, {"contains no stresses"});
}

} // namespace
} // namespace gestell::tests
