// The FE press from its STEP file, on a coarse mesh, through the program.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

// Quick to make and reduce: some 60 000 coordinates.
const std::string coarse = " --set frame.mesh.size='\"150 mm\"' --set frame.mesh.'\"crown bearing *\"'='\"75 mm\"' ";

std::string run_press(const Folder &folder, const std::string &more = "")
{
  const Answer answer = gestell("run " + scene("press.toml") + folder.option() + coarse + more);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  return read(folder.results() / "summary.json");
}

TEST(Press, RunsFromStepFileToTheForceInTheRod)
{
  const Folder      folder("press");
  const std::string summary = run_press(folder);
  for (const char *name : {"frame_modes.pvd", "motion.pvd", "report.html", "modes.csv", "history.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.results() / name)) << name;

  // The tool force peaks at k_s L_s h; the rod adds the dynamic excess and carries it with the counterbalance.
  EXPECT_NEAR(json_number(summary, {"signals", "F_u", "max"}), 1.024e6, 1.);
  EXPECT_GT(json_number(summary, {"signals", "F_P", "max"}), 1.024e6);
  EXPECT_LT(json_number(summary, {"signals", "F_P", "max"}), 1.15e6);
  EXPECT_LT(json_number(summary, {"signals", "F_P", "min"}), -3e5);
  // Columns are pulled during the stroke and pushed after the shock.
  EXPECT_GT(json_number(summary, {"signals", "F_col", "max"}), 8e5);
  EXPECT_LT(json_number(summary, {"signals", "F_col", "min"}), -3e5);
  EXPECT_LT(json_number(summary, {"energy", "residual"}), 1e-3 * json_number(summary, {"energy", "input"}));
}

TEST(Press, StandsWithItsWeightOnTheFoundationWhenItStarts)
{
  const Folder folder("press_start");
  run_press(folder, "--set run.end='\"20 us\"' ");
  const std::string   history    = read(folder.results() / "history.csv");
  const std::size_t   header_end = history.find('\n');
  std::vector<double> row;
  std::istringstream  line(history.substr(header_end + 1, history.find('\n', header_end + 1) - header_end - 1));
  for (std::string cell; std::getline(line, cell, ',');)
    row.push_back(std::stod(cell));
  const auto column = [&](const std::string &name)
  {
    const std::string header = history.substr(0, header_end);
    return row.at(std::count(header.begin(), header.begin() + static_cast<long>(header.find(name + " [")), ','));
  };
  // Vertical balance of the whole press: F_F = (frame + drive + die) g + what the slide's motion hands on: F_P - F_C -
  // F_S acts on the frame upwards with F_P, downwards with the others; the slide: m3 x3'' = m3 g + F_P - F_C - F_S.
  const double frame = json_number(read(folder.results() / "summary.json"), {"model", "frame_mass"});
  const double phi = 2.0943951023931953, r = 0.08, l = 0.8, omega = 3.141592653589793;
  const double w  = std::sqrt(l * l - std::pow(r * std::sin(phi), 2));
  const double u2 = r * std::cos(phi) - r * r * std::cos(2. * phi) / w -
                    std::pow(r * r * std::sin(phi) * std::cos(phi), 2) / std::pow(w, 3);
  const double weight = (frame + 4900. + 7330. + 3200.) * 9.81;
  EXPECT_NEAR(column("F_F"), weight - 3200. * u2 * omega * omega, 1e-8 * weight);
  // Downward displacements: the press sinks by about F_F / c_F.
  EXPECT_NEAR(column("x2"), column("F_F") / 420e6, 0.1 * column("x2"));
  EXPECT_GT(column("x1"), 0.);
}

TEST(Press, FrameAThousandTimesStifferChangesTheReboundPeak)
{
  const Folder soft("press_soft"), stiff("press_stiff");
  const double F_soft = json_number(run_press(soft), {"signals", "F_P", "min"});
  const double F_stiff =
      json_number(run_press(stiff, "--set frame.material='{ E = \"210000 GPa\", nu = 0.3, rho = \"7850 kg/m^3\" }' "),
                  {"signals", "F_P", "min"});
  EXPECT_GT(std::abs(F_stiff - F_soft), 0.02 * std::abs(F_soft));
}

TEST(Press, FrameThatIsUnsupportedIsNamedAndLeavesNothing)
{
  const Folder folder("press_loose");
  expect_answer(gestell("run " + scene("press.toml") + folder.option() + coarse +
                        "--set frame.support.feet.foundation.stiffness='[\"c_F\", \"c_F\", 0]'"),
                2, {"unconstrained DOF frame."});
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

} // namespace
} // namespace gestell::tests
