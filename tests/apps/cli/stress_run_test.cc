// From a CAD file to the largest stress, through the program.

#include "tests/support/program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gestell::tests
{
namespace
{

constexpr double length = 2., width = 0.2, height = 0.25, force = 2e4;

/// A bar along x, clamped at its end, whose tip is pressed down by a force spread over its end face.
std::string bar(const std::string &stress, const std::string &start = "rule = \"static\"")
{
  return R"(name = "bar"
[frame]
cad      = "bar.geo"
unit     = "1 m"
mesh     = { size = "0.1 m" }
material = { E = "210 GPa", nu = 0, rho = "7850 kg/m^3" }
damping  = { ratio = 0.05 }
[frame.surface.wall]
plane = { normal = [-1, 0, 0], through = [0, 0, 0] }
[frame.surface.end]
plane = { normal = [1, 0, 0], through = [2, 0, 0] }
[frame.support.wall]
surface = "wall"
clamped = true
[frame.interface.tip]
surface  = "end"
coupling = "average"
[element.load]
type      = "force"
from      = "frame.tip"
direction = [0, 0, -1]
constant  = "20 kN"
[start]
)" + start +
         R"(
[run]
step = "0.1 ms"
end  = "60 ms"
[output.signals]
u = "-frame.tip.uz"
)" + stress;
}

/// "key": number behind the first occurrence of every name of the path, in order.
double number(const std::string &json, const std::vector<std::string> &path)
{
  std::size_t at = 0;
  for (const std::string &name : path)
  {
    at = json.find('"' + name + '"', at);
    if (at == std::string::npos)
      throw std::invalid_argument("no " + name);
    at += name.size() + 2;
  }
  return std::stod(json.substr(json.find_first_of("0123456789-", at)));
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
  const double      x       = number(summary, {"stress", "largest", "at"});
  EXPECT_LT(x, 0.2) << "near the wall, but not in its elements";
  EXPECT_NEAR(number(summary, {"stress", "largest", "von_mises"}), at_edge(x), 0.05 * at_edge(x));
  EXPECT_LT(number(summary, {"stress", "largest", "disagreement"}), 0.2);
  EXPECT_NEAR(number(summary, {"stress", "beside_rigid", "von_mises"}), at_edge(0.), 0.15 * at_edge(0.));
  for (const char *name : {"stress.pvd", "stress/stress_00001.vtp", "charts/stress-1.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / name)) << name;
  EXPECT_NE(read(folder.results() / "report.html").find("Stress in the frame"), std::string::npos);
}

TEST(StressRun, OfHexahedraInBendingIsThatOfABeam)
{
  // Cubic deflections are beyond quadratic cells, by (h / L)^2 / 12 of the curvature or so: 3e-4 of 16 cells.
  const Folder      folder("stress_hexahedra");
  const std::string summary = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"), bricks);
  const double      x       = number(summary, {"stress", "largest", "at"});
  EXPECT_EQ(x, 0.25) << "two cells from the wall";
  EXPECT_NEAR(number(summary, {"stress", "largest", "von_mises"}), at_edge(x), 1e-3 * at_edge(x));
  EXPECT_NEAR(number(summary, {"stress", "largest", "principal"}), at_edge(x), 1e-3 * at_edge(x));
  EXPECT_LT(number(summary, {"stress", "largest", "disagreement"}), 0.01);
}

TEST(StressRun, OfHexahedraUnderTheirWeightIsExact)
{
  // Along the bar sigma = rho g (L - x): the displacement is quadratic, as the cells are.  Stresses of modes are kept
  // in single precision.
  const Folder folder("stress_weight");
  std::string  scene = bar("[output.stress]\nat = [\"10 ms\"]\n");
  scene.replace(scene.find("20 kN"), 5, "0 kN");
  const std::string summary = run(folder, "gravity = [10, 0, 0]\n" + scene, bricks);
  const double      x       = number(summary, {"stress", "largest", "at"});
  EXPECT_NEAR(number(summary, {"stress", "largest", "von_mises"}), 7850. * 10. * (length - x), 1e-5 * 7850. * 20.);
  EXPECT_NEAR(number(summary, {"stress", "beside_rigid", "von_mises"}), 7850. * 10. * length, 1e-5 * 7850. * 20.);
}

TEST(StressRun, OfASuddenLoadIsTwiceThatOfASlowOneButForDamping)
{
  // One mode, damping ratio 0.05: overshoot 1 + exp(-pi zeta) = 1.85; higher modes bend the root a little more.
  const Folder      folder("stress_sudden");
  const std::string summary = run(folder, bar("[output.stress]\nlargest = [\"stress\", \"u\"]\n", ""));
  const double      x       = number(summary, {"stress", "largest", "at"});
  const double      share   = number(summary, {"stress", "largest", "von_mises"}) / at_edge(x);
  EXPECT_GT(share, 1.7);
  EXPECT_LT(share, 2.3);
  EXPECT_EQ(number(summary, {"stress", "states"}), 601. + 1.) << "every step, and the peak of u";
}

TEST(StressRun, AWarmStartTakesTheStressesFromTheCache)
{
  const Folder      folder("stress_warm");
  const std::string cold = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"));
  const std::string warm = run(folder, bar("[output.stress]\nat = [\"10 ms\"]\n"));
  EXPECT_EQ(number(cold, {"stress", "largest", "von_mises"}), number(warm, {"stress", "largest", "von_mises"}));
}

TEST(StressRun, AReducedFrameWrittenWithoutStressesIsRefused)
{
  const Folder folder("stress_file");
  folder.file("bar.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 2, 0.2, 0.25};");
  ASSERT_EQ(gestell("reduce " + folder.file("bar.toml", bar("")) + folder.option()).exit_code, 0);
  std::string       scene = bar("[output.stress]\n");
  const std::size_t begin = scene.find("cad "), end = scene.find("[element.load]");
  scene.replace(begin, end - begin, "reduced = \"" + (folder.results() / "reduced_frame.h5").string() + "\"\n");
  const Answer answer = gestell("run " + folder.file("again.toml", scene) + folder.option());
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_TRUE(answer.says("written without stresses")) << answer.text;
}

} // namespace
} // namespace gestell::tests
