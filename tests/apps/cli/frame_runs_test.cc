// Runs, steady states and modes of frames with prestress and damping by modes: the same poles in all of them, in one
// piece and in parts, in any position and in any units.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <cmath>
#include <complex>
#include <fstream>

namespace gestell::tests
{
namespace
{

using Complex = std::complex<double>;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Rates s of a sum of n damped oscillations exp(s t), from samples at equal times: roots of its recurrence.
std::vector<Complex> poles(const std::vector<double> &y, double step, int n)
{
  const int       order = 2 * n, rows = int(y.size()) - order;
  Eigen::MatrixXd past(rows, order);
  Eigen::VectorXd next(rows);
  for (int k = 0; k < rows; ++k)
  {
    next[k] = y[std::size_t(k + order)];
    for (int j = 0; j < order; ++j)
      past(k, j) = y[std::size_t(k + order - 1 - j)];
  }
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0)          = past.colPivHouseholderQr().solve(next).transpose();
  companion.diagonal(-1)    = Eigen::VectorXd::Ones(order - 1);
  const Eigen::VectorXcd z  = companion.eigenvalues();
  std::vector<Complex>   found;
  for (const Complex &root : z)
    if (root.imag() > 0.)
      found.push_back(std::log(root) / step);
  std::sort(found.begin(), found.end(), [](const Complex &a, const Complex &b) { return std::abs(a) < std::abs(b); });
  return found;
}

double frequency(const Complex &s)
{
  return std::abs(s) / (2. * M_PI);
}

double ratio(const Complex &s)
{
  return -s.real() / std::abs(s);
}

/// Every n-th value of a signal, and the time between them.
std::pair<std::vector<double>, double> samples(const Folder &folder, const std::string &column, int every)
{
  const CsvTable      table((folder.results() / "history.csv").string());
  std::vector<double> y;
  for (int row = 0; row < table.rows(); row += every)
    y.push_back(table.number(row, column));
  return {y, table.number(every, "t [s]") - table.number(0, "t [s]")};
}

/// A number with its unit.
std::string with(double x, const std::string &unit)
{
  return '"' + number(x) + ' ' + unit + '"';
}

/// A bar of 1 m x 0.06 m x 0.1 m in eight hexahedra, clamped at one end, x -> Q x of space and l times as large.
struct Bar
{
  Matrix3d    Q      = Matrix3d::Identity();
  double      l      = 1.;
  bool        others = false;            ///< nodes and sides in another order
  std::string unit   = "1 m";            ///< of the drawing
  double      drawn  = 1.;               ///< its lengths in this unit
  std::string more   = "";               ///< keys of [frame]
  std::string wall   = "clamped = true"; ///< its support

  std::string vector(const Vector3d &x, double by = 1.) const
  {
    const Vector3d moved = by * (Q * x);
    return '[' + number(moved[0]) + ", " + number(moved[1]) + ", " + number(moved[2]) + ']';
  }
  std::string extrude(const Vector3d &by, const std::string &what, int layers) const
  {
    std::string text = vector(by, l * drawn);
    text.front()     = '{';
    text.back()      = '}';
    return "Extrude " + text + " { " + what + "; Layers{" + std::to_string(layers) + "}; ";
  }
  std::string geometry() const
  {
    const Vector3d across(0., 0.06, 0.), up(0., 0., 0.1);
    std::string    corner = vector({0., -0.03, -0.05}, l * drawn);
    corner.front()        = '{';
    corner.back()         = '}';
    return "SetFactory(\"OpenCASCADE\");\nPoint(1) = " + corner +
           ";\nline[] = " + extrude(others ? up : across, "Point{1}", 1) +
           "};\nface[] = " + extrude(others ? across : up, "Curve{line[1]}", 1) + "Recombine; };\n" +
           extrude(Vector3d(1., 0., 0.), "Surface{face[1]}", 8) + "Recombine; }\nMesh 3;\n";
  }
  /// The scene without its run.
  std::string scene(const Folder &folder) const
  {
    folder.file("bar.geo", geometry());
    const auto plane = [this](const std::string &name, const Vector3d &normal, double x)
    {
      const Vector3d at = l * x * (Q * Vector3d::UnitX());
      return "[frame.surface." + name + "]\nplane = { normal = " + vector(normal) + ", through = [" + with(at[0], "m") +
             ", " + with(at[1], "m") + ", " + with(at[2], "m") + "] }\n";
    };
    return "name = 'bar'\n[frame]\ncad = 'bar.geo'\nunit = '" + unit + "'\nmaterial = 'steel'\nmesh = { size = '" +
           number(0.2 * l) + " m' }\n" + more + plane("wall", -Vector3d::UnitX(), 0.) +
           plane("tip", Vector3d::UnitX(), 1.) + "[frame.support.wall]\nsurface = 'wall'\n" + wall +
           "\n[frame.interface.tip]\nsurface = 'tip'\n"
           "coupling = 'average'\n";
  }
};

const std::string released      = "[start]\nq = { 'frame.tip.uy' = '1 mm', 'frame.tip.uz' = '2 mm' }\n"
                                  "[run]\nmethod = 'exact'\nstep = '50 us'\nend = '0.15 s'\n"
                                  "[output]\nstep = '0.1 ms'\npicture_step = 0\n"
                                  "signals = { y = 'frame.tip.uy', z = 'frame.tip.uz' }\n";
const std::string static_shapes = "[reduction]\nmethod = 'guyan'\n";
const std::string squeezed      = "prestress = { loads = [{ surface = 'tip', force = ['-600 kN', 0, 0] }] }\n";

/// The lowest pole of a free vibration of two modes.
Complex first_pole(const Folder &folder, const std::string &signal, int every)
{
  const auto [y, step] = samples(folder, signal + " [m]", every);
  return poles(y, step, 2).front();
}

TEST(PrestressedFrame, VibratesFreelyAtTheFrequenciesOfItsModes)
{
  const Folder folder("prestressed_run");
  Bar          bar;
  bar.more = squeezed;
  expect_answer(
      gestell("run " + folder.file("bar.toml", bar.scene(folder) + static_shapes + released) + folder.option()), 0, {});
  const CsvTable modes((folder.results() / "modes.csv").string());
  EXPECT_NEAR(frequency(first_pole(folder, "y", 7)), modes.number(0, "frequency [Hz]"), 1e-8 * 40.);
  EXPECT_NEAR(frequency(first_pole(folder, "z", 7)), modes.number(1, "frequency [Hz]"), 1e-8 * 80.);
  // Half of the buckling load about: the bar without it is at 50.8 Hz.
  EXPECT_LT(modes.number(0, "frequency [Hz]"), 40.);
  EXPECT_GT(modes.number(0, "frequency [Hz]"), 20.);
}

TEST(PrestressedFrame, ResonatesAtTheFrequencyOfItsMode)
{
  // At resonance a mode lags by 90 degrees; a frequency wrong by 1e-4 turns that by 1e-4/zeta = 0.01 rad. The others
  // are 2 zeta times some percent of it.
  const Folder folder("prestressed_response");
  Bar          bar;
  bar.more                = squeezed + "damping = { ratio = 0.01 }\n";
  const std::string scene = folder.file("bar.toml", bar.scene(folder) + "[reduction]\nmodes = 6\n");
  expect_answer(gestell("modes " + scene + folder.option()), 0, {"the buckling factor is"});
  const double      f     = CsvTable((folder.results() / "modes.csv").string()).number(0, "frequency [Hz]");
  const std::string range = " --lowest " + number(f) + " --highest " + number(1.001 * f) + " --points 2";
  expect_answer(gestell("frf " + scene + " --from frame.tip.uy --to frame.tip.uy" + range + folder.option()), 0, {});
  const CsvTable    response((folder.results() / "frf.csv").string());
  const std::string pair = "frame.tip.uy/frame.tip.uy ";
  EXPECT_NEAR(response.number(0, "frequency [Hz]"), f, 1e-9 * f);
  EXPECT_LT(std::abs(response.number(0, pair + "re [m/N]")), 0.01 * std::abs(response.number(0, pair + "im [m/N]")));
}

const std::string by_modes =
    "damping = { ratio = 0.002, modes = [{ mode = 1, ratio = 0.02 }, { mode = 2, ratio = 0.004 }] }\n";

void expect_decay(const Folder &folder)
{
  EXPECT_NEAR(ratio(first_pole(folder, "y", 7)), 0.02, 1e-9);
  EXPECT_NEAR(ratio(first_pole(folder, "z", 4)), 0.004, 1e-9);
}

struct DampedFrame
{
  std::string more;                    ///< keys of [frame]
  std::string reduction;               ///< to six coordinates
  std::string wall = "clamped = true"; ///< its support
};

using DampingByModes = ::testing::TestWithParam<DampedFrame>;

TEST_P(DampingByModes, IsTheDecayOfAFreeVibration)
{
  const Folder folder("damping_by_modes");
  Bar          bar;
  bar.more = by_modes + GetParam().more;
  bar.wall = GetParam().wall;
  expect_answer(
      gestell("run " + folder.file("bar.toml", bar.scene(folder) + GetParam().reduction + released) + folder.option()),
      0, {"damping of the frame: 2 % in mode 1, 0.4 % in mode 2"});
  expect_decay(folder);
}

INSTANTIATE_TEST_SUITE_P(Frames, DampingByModes,
                         ::testing::Values(DampedFrame{"", static_shapes}, DampedFrame{squeezed, static_shapes},
                                           DampedFrame{"parts = 2\n", "[reduction]\nmodes = 0\n"},
                                           DampedFrame{
                                               "", static_shapes,
                                               "foundation = { stiffness = ['400 kN/mm', '300 kN/mm', '300 "
                                               "kN/mm'], damping = ['20 kN s/m', '60 kN s/m', '10 kN s/m'] }"}));

TEST(ExportedFrame, KeepsTheDampingOfItsModes)
{
  const Folder folder("exported_damping");
  Bar          bar;
  bar.more = by_modes;
  expect_answer(gestell("reduce " + folder.file("bar.toml", bar.scene(folder) + static_shapes) +
                        " --export matrix-market" + folder.option()),
                0, {});
  const std::string matrices = read(folder.results() / "frame.toml");
  for (const std::string &frame : {matrices, std::string("frame.reduced = 'reduced_frame.h5'\n")})
  {
    const std::string file = (folder.results() / "back.toml").string();
    std::ofstream(file) << frame << released;
    const Folder run("exported_damping_run");
    expect_answer(gestell("run '" + file + "'" + run.option()), 0, {});
    expect_decay(run);
  }
}

TEST(Story, OfAFrameFromCadNamesTheModeInTheForceOfItsSupport)
{
  // Driven near its second mode, with a soft stop for its events. The force of the support contains the inertia of its
  // layer of cells, which no mode has a part in; an unreduced frame is judged by its interface.
  for (const auto &[reduction, run] :
       {std::pair("modes = 4", "method = 'exact'"), std::pair("method = 'none'", "method = 'bdf'")})
  {
    const Folder folder("story_of_a_frame");
    Bar          bar;
    bar.more               = "damping = { ratio = 0.01 }\n";
    const std::string text = bar.scene(folder) + "[reduction]\n" + reduction + "\n[run]\n" + run +
                             "\nstep = '50 us'\nend = '0.1 s'\n[output]\npicture_step = '1 ms'\nstep = '0.1 ms'\n"
                             "signals = { R = 'frame.support.wall.z' }\n[element.stop]\ntype = 'clearance'\n"
                             "from = 'frame.tip'\ndirection = [0, 0, 1]\ngap = '1 mm'\nstiffness = '1 N/mm'\n"
                             "[element.push]\ntype = 'force'\nfrom = 'frame.tip'\ndirection = [0, 0, 1]\n"
                             "harmonics = [{ amplitude = '1 kN', frequency = '80 Hz' }]\n";
    expect_answer(gestell("run " + folder.file("bar.toml", text) + folder.option()), 0, {});
    const std::string summary = read(folder.results() / "summary.json");
    const std::string extreme = summary.substr(summary.find("\"extremes\""));
    EXPECT_EQ(json_number(extreme, {"mode"}), 2.) << reduction;
    EXPECT_NEAR(json_number(extreme, {"mode_hz"}), 83.78, 0.01) << reduction;
    const double share = json_number(extreme, {"share"});
    EXPECT_GT(share, 0.95) << reduction;
    EXPECT_LT(share, 1.) << reduction;
  }
}

/// A bar without supports, pulled at its tip, alone and with a body that a joint carries there: the section at 0.4 of
/// its length pulls what is below.  Nothing vibrates.
TEST(FreeFrame, AcceleratesWithoutVibrationAfterInertiaRelief)
{
  const double      bar = 0.06 * 0.1 * 7850.; // [kg]
  const std::string body =
      "[body.m]\ntype = 'rigid'\nmass = 12\ninertia = [[2, 0, 0], [0, 2, 0], [0, 0, 2]]\nposition = [1, 0, 0]\n"
      "[joint.j]\ntype = 'rigid'\nfrom = 'frame.tip'\nto = 'm'\nat = [1, 0, 0]\n";
  for (const auto &[more, mass] : {std::pair(std::string(), bar), std::pair(body, bar + 12.)})
    for (const char *reduction : {"method = 'none'", "modes = 4\ninertia_relief = true"})
    {
      const Folder folder("free_frame");
      std::string  text = Bar().scene(folder);
      text.erase(text.find("[frame.support.wall]"),
                 text.find("[frame.interface.tip]") - text.find("[frame.support.wall]"));
      text += more + "[reduction]\n" + reduction +
              "\n[frame.cut.c]\nplane = { normal = [1, 0, 0], through = ['0.4 m', 0, 0] }\n[element.pull]\n"
              "type = 'force'\nfrom = 'frame.tip'\ndirection = [1, 0, 0]\nconstant = '1 kN'\n[start]\nrule = 'static'\n"
              "inertia_relief = true\n[run]\nmethod = 'bdf'\nstep = '5 us'\nend = '1 ms'\n[output]\npicture_step = 0\n"
              "signals = { c = 'frame.cut.c' }\n";
      expect_answer(gestell("run " + folder.file("bar.toml", text) + folder.option()), 0, {});
      for (const double force : samples(folder, "c [N]", 1).first)
        EXPECT_NEAR(force, 400. * bar / mass, 1e-3) << reduction << more; // of 1 kN: iterations to 1e-6
    }
}

/// The forces of a section are those of the cells, and in a machine in modes those of these modes.
TEST(ForcesWithinAFrame, AreDoubtfulThroughRigidSurfacesAndInModes)
{
  const Folder folder("doubtful_forces");
  std::string  text = Bar().scene(folder) + "[frame.cut.c]\nplane = { normal = [0, 0, 1], through = [0, 0, 0] }\n" +
                     released + "[reduction]\nmethod = 'modal'\nmodes = 4\n";
  text.replace(text.find("'average'"), 9, "'rigid'");
  text.replace(text.find("signals = {"), 11, "signals = { c = 'frame.cut.c.V1', R = 'frame.support.wall.z',");
  expect_answer(
      gestell("run " + folder.file("bar.toml", text) + folder.option()), 0,
      {"cut \"c\" divides the surface of the interface \"tip\", which carries force",
       "forces of supports, cuts and joints of the frame (c, R) contain only the statics of the retained modes"});
}

/// What a frame answers that does not depend on axes and units: buckling, poles, section forces, damage.
struct Answers
{
  double                buckling, damage;
  std::vector<double>   frequencies, ratios;
  std::array<double, 6> section; ///< largest amounts of N, V1, V2, T, M1, M2
};

/// Lengths, times l, masses l^3: stresses, buckling factor and damage are the same.
Answers answers(const Bar &bar)
{
  const Folder folder("moved_frame");
  const double l    = bar.l;
  std::string  text = "gravity = " + bar.vector({0.5, 0.3, -9.81}, 1. / l) + '\n';
  Bar          own  = bar;
  own.more =
      "prestress = { gravity = true, loads = [{ surface = 'tip', force = " + bar.vector({-5e5, 1e3, 2e3}, l * l) +
      " }] }\ndamping = { ratio = 0.02, modes = [{ mode = 1, ratio = 0.01 }, { mode = 2, ratio = 0.004 }] }\n";
  text += own.scene(folder);
  const Vector3d middle = 0.41 * l * (bar.Q * Vector3d::UnitX());
  text += "[frame.cut.middle]\nplane = { normal = " + bar.vector({1., 0., 0.}) + ", through = [" +
          with(middle[0], "m") + ", " + with(middle[1], "m") + ", " + with(middle[2], "m") +
          "] }\nfirst = " + bar.vector({0., 1., 0.}) +
          "\n[reduction]\nmodes = 6\n[run]\nmethod = 'bdf'\nstep = " + with(0.2 * l, "ms") +
          "\nend = " + with(0.2 * l, "s") + "\n[life]\ncurve = { class = 71 }\nmeasure = 'signed von mises'\n";
  const auto force = [&](const std::string &name, const Vector3d &direction, double hz)
  {
    return "[element." + name + "]\ntype = 'force'\nfrom = 'frame.tip'\ndirection = " + bar.vector(direction) +
           "\nharmonics = [{ amplitude = " + with(9. * l * l, "kN") + ", frequency = " + with(hz / l, "Hz") + " }]\n";
  };
  text += force("slow", {0.6, 0.64, 0.48}, 37.) + force("fast", {0., 0.6, 0.8}, 111.);
  text += "[output]\npicture_step = 0\nsignals = { N = 'frame.cut.middle'";
  const std::array<std::string, 6> names = {"N", "V1", "V2", "T", "M1", "M2"};
  for (std::size_t i = 1; i < names.size(); ++i)
    text += ", " + names[i] + " = 'frame.cut.middle." + names[i] + "'";
  expect_answer(gestell("life " + folder.file("bar.toml", text + " }\n") + folder.option()), 0, {"Life of the frame"});

  const std::string summary = read(folder.results() / "summary.json");
  Answers        found{json_number(summary, {"buckling_factor"}), json_number(summary, {"life", "damage"}), {}, {}, {}};
  const CsvTable modes((folder.results() / "modes.csv").string());
  for (int row = 0; row < 4; ++row)
  {
    found.frequencies.push_back(l * modes.number(row, "frequency [Hz]"));
    found.ratios.push_back(modes.number(row, "damping ratio"));
  }
  const std::string signals = summary.substr(summary.find("\"signals\""));
  for (std::size_t i = 0; i < names.size(); ++i)
    found.section[i] = std::max(json_number(signals, {names[i], "max"}), -json_number(signals, {names[i], "min"})) /
                       (l * l) / (i < 3 ? 1. : l);
  return found;
}

TEST(Frame, AnswersTheSameInAnyPositionSizeAndUnit)
{
  const Bar        given;
  const Answers    expected = answers(given);
  std::vector<Bar> others(3, given);
  others[0].Q = Eigen::AngleAxisd(0.7, Vector3d(1., 2., -0.5).normalized()).matrix() *
                Vector3d(1., -1., 1.).asDiagonal(); // a mirror
  others[1].Q      = Eigen::AngleAxisd(M_PI / 2., Vector3d::UnitY()).matrix();
  others[1].others = true;
  others[1].unit   = "1 mm";
  others[1].drawn  = 1e3;
  others[2].Q      = Eigen::AngleAxisd(M_PI / 2., Vector3d::UnitZ()).matrix();
  others[2].l      = 64.;
  for (std::size_t k = 0; k < others.size(); ++k)
  {
    const Answers found = answers(others[k]);
    const auto    same  = [k](double a, double b, double share) { EXPECT_NEAR(a, b, share * std::abs(b)) << k; };
    same(found.buckling, expected.buckling, 1e-8);
    same(found.damage, expected.damage, 2e-6); // stresses are stored in single precision
    for (std::size_t j = 0; j < expected.ratios.size(); ++j)
    {
      same(found.frequencies[j], expected.frequencies[j], 1e-8);
      same(found.ratios[j], expected.ratios[j], 1e-8);
    }
    for (std::size_t i = 0; i < expected.section.size(); ++i)
      same(found.section[i], expected.section[i], 1e-7);
  }
}

} // namespace
} // namespace gestell::tests
