// Scene files: what is read, what is overridden and inherited, and every way a user can get one wrong.

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/toml_text.h"
#include "fem/values/nearest_name.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;
using test::cad_scene;
using test::complaint;
using test::scene_of;
using test::SceneFolder;
using test::small_scene;

TEST(Scene, ReadsAsItStands)
{
  const auto scene = scene_of(small_scene());
  EXPECT_EQ(complaint(small_scene()), "");
  EXPECT_EQ(scene.name, "small");
  EXPECT_DOUBLE_EQ(scene.bodies[1].mass, 3200.);
  EXPECT_DOUBLE_EQ(scene.run.options.method.step, 1e-5);
  EXPECT_DOUBLE_EQ(scene.frame.matrices.mass, 22500.);
  ASSERT_EQ(scene.signals.size(), 2u);
  EXPECT_EQ(scene.signals[0].name, "F_P"); // the order of the file
}

TEST(Scene, WithoutANameIsCalledLikeItsFile)
{
  const SceneFolder folder;
  EXPECT_EQ(apps::read_scene(folder.write("crane.toml", "[run]\nstep = 1\nend = 2\n")).name, "crane");
}

TEST(Scene, ParametersMayReferToEachOtherInAnyOrder)
{
  const auto scene = scene_of(small_scene("length       = \"800 mm\"", "length = \"5*stroke\""));
  EXPECT_DOUBLE_EQ(scene.rods[0].length, 0.8);
}

// What passes a number on as text, such as --sensitivities, loses no digit of it.
TEST(Scene, KeepsRealNumbersAsTheyAreWritten)
{
  const SceneFolder folder;
  const auto        root = apps::parse_toml_file(
             folder.write("numbers.toml",
                          "[parameters]\na = 3.141592653589793\nb = 0.10 # mm\nc = { d = -1.0E-3, e = 2.50}\nf = [1.25,0.5]\n"
                                 "g = 1_000.25\n"));
  const auto &table = *root.find("parameters");
  EXPECT_EQ(table.find("a")->text, "3.141592653589793");
  EXPECT_EQ(table.find("b")->text, "0.10");
  EXPECT_EQ(table.find("c")->find("d")->text, "-1.0E-3");
  EXPECT_EQ(table.find("c")->find("e")->text, "2.50");
  EXPECT_EQ(table.find("f")->elements[0].text, "1.25");
  EXPECT_EQ(table.find("f")->elements[1].text, "0.5");
  EXPECT_EQ(table.find("g")->text, "1000.25"); // a formula knows no underscore
}

// --- overrides

TEST(SceneOverride, ReplacesAnyEntryBeforeExpressionsAreEvaluated)
{
  EXPECT_DOUBLE_EQ(scene_of(small_scene(), {"parameters.radius=90 mm"}).rods[0].crank_radius, 0.09);
  EXPECT_DOUBLE_EQ(scene_of(small_scene(), {"parameters.radius=0.09"}).rods[0].crank_radius, 0.09);
  EXPECT_DOUBLE_EQ(scene_of(small_scene(), {"run.step=\"5 us\""}).run.options.method.step, 5e-6);
  EXPECT_DOUBLE_EQ(scene_of(small_scene(), {"gravity=[0, 0, 0]"}).gravity[2], 0.);
}

TEST(SceneOverride, LaterOnesWin)
{
  EXPECT_EQ(scene_of(small_scene(), {"run.order=3", "run.order=1"}).run.options.method.order, 1);
}

TEST(SceneOverride, QuotedSegmentsReachNamesWithSpacesAndDots)
{
  const auto text = small_scene("[element.spring]", "[element.\"soft spring\"]");
  EXPECT_DOUBLE_EQ(scene_of(text, {"element.\"soft spring\".stiffness=30 N/mm"}).linear[0].stiffness, 3e4);
  EXPECT_DOUBLE_EQ(scene_of(text, {"start.q.\"frame.crown.uz\"=-1 mm"}).start.q[1].value, -1e-3);
}

TEST(SceneOverride, AddsKeysThatAreKnownAndRefusesOthers)
{
  EXPECT_DOUBLE_EQ(scene_of(small_scene(), {"element.rod.clearance=0.4 mm"}).elements.size(), 2u);
  EXPECT_EQ(complaint(small_scene(), {"element.rod.clearence=0.4 mm"}),
            "--set element.rod.clearence=0.4 mm: element.rod: unknown key 'clearence'; did you mean 'clearance'?");
}

// A slip of the pen would change nothing, and its result would look like the answer.
TEST(SceneOverride, OfAParameterThatNothingDependsOnIsRefused)
{
  EXPECT_EQ(complaint(small_scene(), {"parameters.radiu=90 mm"}),
            "--set parameters.radiu=90 mm: no value of the scene depends on the parameter 'radiu', so it has no "
            "effect; did you mean 'radius'?");
  EXPECT_NO_THROW(scene_of(small_scene(), {"parameters.half=45 mm", "parameters.radius=2*half"}));
  EXPECT_NE(complaint(small_scene(), {"parameters.half=45 mm", "parameters.twice=2*half"}), "");
}

TEST(SceneOverride, OfTheWrongFormIsRefused)
{
  for (const std::string text : {"run.step", "=3", "run..step=3", "run.\"step=3", "name.x=3", "extends=other.toml"})
    EXPECT_EQ(complaint(small_scene(), {text}).find("--set " + text + ": "), 0u) << complaint(small_scene(), {text});
}

// --- inheritance

TEST(SceneInheritance, OwnEntriesWinAndTablesMerge)
{
  const SceneFolder folder;
  folder.write("base/scene.toml", small_scene());
  const auto path  = folder.write("light.toml", "extends = \"base/scene.toml\"\n[parameters]\nradius = \"90 mm\"\n");
  const auto scene = apps::read_scene(path);
  EXPECT_EQ(scene.name, "light"); // not "small": it is another scene
  EXPECT_DOUBLE_EQ(scene.rods[0].crank_radius, 0.09);
  EXPECT_DOUBLE_EQ(scene.bodies[1].mass, 3200.);
}

TEST(SceneInheritance, PathsStayRelativeToTheFileTheyStandIn)
{
  const SceneFolder folder;
  folder.write("base/frame.step", "ISO-10303-21;");
  folder.write("base/scene.toml", "[frame]\ncad = \"frame.step\"\nmesh = { size = \"60 mm\" }\n"
                                  "[frame.surface.feet]\ngroup = \"feet\"\n"
                                  "[frame.interface.crown]\nsurfaces = [\"feet\"]\n");
  const auto scene = apps::read_scene(folder.write("light.toml", "extends = \"base/scene.toml\"\n"));
  EXPECT_TRUE(std::filesystem::equivalent(scene.frame.geometry.cad, folder.path("base/frame.step")));
}

TEST(SceneInheritance, AReducedFrameTakesThePlaceOfAllThatWasSaidOfTheFrame)
{
  const SceneFolder folder;
  folder.write("frame.step", "ISO-10303-21;");
  folder.write("reduced.h5", "");
  const auto base    = folder.write("base.toml", "[frame]\ncad = \"frame.step\"\nmesh = { size = \"60 mm\" }\n"
                                                    "[frame.surface.feet]\ngroup = \"feet\"\n"
                                                    "[frame.interface.crown]\nsurfaces = [\"feet\"]\n"
                                                    "[reduction]\nmodes = 5\n");
  const auto reduced = folder.write("reduced.toml", "extends = \"base.toml\"\n[frame]\nreduced = \"reduced.h5\"\n");
  EXPECT_EQ(apps::read_scene(reduced).frame.source, apps::FrameSource::reduced_file);
  const std::string by_hand = "frame.reduced=\"" + folder.path("reduced.h5") + "\"";
  EXPECT_EQ(apps::read_scene(base, {by_hand}).frame.source, apps::FrameSource::reduced_file);

  const std::string surface =
      "[frame.surface.feet]\ngroup = \"feet\"\n[frame.interface.crown]\nsurfaces = [\"feet\"]\n";
  const auto back = folder.write("back.toml", "extends = \"reduced.toml\"\n[frame]\ncad = \"frame.step\"\n"
                                              "mesh = { size = \"60 mm\" }\n" +
                                                  surface);
  EXPECT_EQ(apps::read_scene(back).frame.source, apps::FrameSource::geometry);
}

TEST(SceneInheritance, MistakesAreReportedInTheFileTheyStandIn)
{
  const SceneFolder folder;
  folder.write("base.toml", small_scene("inertia = \"250 kg m^2\"", "inertia = \"250 kg\""));
  tests::expect_refusal([&] { apps::read_scene(folder.write("light.toml", "extends = \"base.toml\"\n")); },
                        "base.toml:24: body.crank.inertia");
}

TEST(SceneInheritance, CirclesAndMissingFilesAreRefused)
{
  EXPECT_NE(complaint("extends = \"scene.toml\"\n").find("cyclically"), std::string::npos);
  EXPECT_NE(complaint("extends = \"none.toml\"\n").find("scene.toml:1: extends"), std::string::npos);
  EXPECT_NE(complaint("extends = 3\n").find("an integer"), std::string::npos);
}

// --- mistakes

struct Mistake
{
  std::string piece, replacement; ///< in the small scene
  std::string place;              ///< heads the message after file and line
  std::string words;              ///< stand in it
  int         lines_up = 0;       ///< the message is about a line so far above the piece
};

int line_of(const std::string &text, const std::string &piece)
{
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(piece));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

void PrintTo(const Mistake &mistake, std::ostream *out)
{
  *out << mistake.replacement;
}

using SceneMistake = ::testing::TestWithParam<Mistake>;

TEST_P(SceneMistake, IsReportedWithLineReasonAndRemedy)
{
  const auto &[piece, replacement, place, words, lines_up] = GetParam();
  const std::string message                                = complaint(small_scene(piece, replacement));
  const int         line                                   = line_of(small_scene(), piece) - lines_up;
  EXPECT_EQ(message.find("scene.toml:" + std::to_string(line) + ": " + place), 0u) << message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, SceneMistake,
    ::testing::Values(Mistake{"inertia = ", "inerta = ", "body.crank: unknown key 'inerta'", "did you mean 'inertia'"},
                      Mistake{"damping   = [[", "dampin = [[", "frame: unknown key 'dampin'", "did you mean 'damping'"},
                      Mistake{"[modes]", "[modse]", "", "unknown key 'modse'; did you mean 'modes'"},
                      Mistake{"ratio             = 49", "ratoi = 49", "element.motor", "did you mean 'ratio'"},
                      Mistake{"step = \"10 us\"", "step = \"10 us\"\nstep = 3", "", "is defined twice in this table",
                              -1},
                      Mistake{"step = \"10 us\"", "step = 10 us", "is not valid TOML here", "in quotes: \"10 us\""},
                      Mistake{"name    = \"small\"", "name = \"a/b\"", "name", "folder"}));

INSTANTIATE_TEST_SUITE_P(
    Values, SceneMistake,
    ::testing::Values(
        Mistake{"\"250 kg m^2\"", "\"250 kg\"", "body.crank.inertia", "needs a moment of inertia such as"},
        Mistake{"\"250 kg m^2\"", "[250]", "body.crank.inertia", "got an array"},
        Mistake{"\"250 kg m^2\"", "\"0 kg m^2\"", "body.crank.inertia", "above zero"},
        Mistake{"\"250 kg m^2\"", "true", "body.crank.inertia", "got true"},
        Mistake{"\"250 kg m^2\"", "inf", "body.crank.inertia", "finite"},
        Mistake{"mass = \"mass_of_slide\"", "mass = \"mass_of_slid\"", "body.slide.mass",
                "did you mean 'mass_of_slide'"},
        Mistake{"mass = \"mass_of_slide\"", "mass = \"-1 kg\"", "body.slide.mass", "above zero"},
        Mistake{"gravity = [0, 0, -9.81]", "gravity = [0, -9.81]", "gravity", "three values"},
        Mistake{"gravity = [0, 0, -9.81]", "gravity = \"9.81 m/s^2\"", "gravity", "needs three numbers [x, y, z], got"},
        Mistake{"gravity = [0, 0, -9.81]", "gravity = [0, 0, \"9.81 m\"]", "gravity", "needs an acceleration"},
        Mistake{"axis    = [0, 1, 0]", "axis = [0, 0, 0]", "body.crank.axis", "cannot be [0, 0, 0]"},
        Mistake{"radius        = \"80 mm\"", "radius = \"stroke/2\"", "", "depends on itself: ", 1},
        Mistake{"radius        = \"80 mm\"", "sin = 3", "parameters.sin", "choose another name"},
        Mistake{"radius        = \"80 mm\"", "radius = true", "parameters.radius", "got true"},
        Mistake{"length       = \"800 mm\"", "length = \"70 mm\"", "element.rod", "length", 5}));

INSTANTIATE_TEST_SUITE_P(
    References, SceneMistake,
    ::testing::Values(
        Mistake{"from         = \"crank\"", "from = \"crnk\"", "element.rod.from", "did you mean 'crank'"},
        Mistake{"from         = \"crank\"", "from = \"slide\"", "element.rod.from", "is not a rotor"},
        Mistake{"to        = \"frame.table\"", "to = \"frame.tabel\"", "element.spring.to", "did you mean 'table'"},
        Mistake{"to        = \"frame.table\"", "to = \"slide\"", "element.spring.to", "two points"},
        Mistake{"on      = \"frame.crown\"", "on = \"frame.column\"", "body.crank.on", "no interface 'column'"},
        Mistake{"\"rotor\"", "\"rotr\"", "body.crank.type", "did you mean 'rotor'"},
        Mistake{"type    = \"rotor\"", "", "body.crank", "the key 'type' is missing; it needs one of 'rotor'", 1},
        Mistake{"[element.spring]", "[element.crank]", "element.crank", "a body has the name"},
        Mistake{"[element.spring]", "[element.\"a.b\"]", "element.\"a.b\"", "dots"},
        Mistake{"[body.slide]", "[body.frame]", "body.frame", "a reserved name"},
        Mistake{"\"rod.force\"", "\"rod.forse\"", "output.signals.F_P", "rod.force"},
        Mistake{"\"rod.force\"", "\"-\"", "output.signals.F_P", "there is no \"-\"; the nearest of "},
        Mistake{"\"rod.force\"", "\"- \"", "output.signals.F_P", "there is no \"- \""},
        Mistake{"crank = \"120 deg\"", "crnk = \"120 deg\"", "start.q.crnk", "did you mean 'crank'"},
        Mistake{"\"frame.crown.uz\" =", "\"frame.crown.ux\" =", "start.q.\"frame.crown.ux\"", "is fixed"},
        Mistake{"open = [\"rod\"]", "open = [\"rot\"]", "modes.open", "did you mean 'rod'"}));

INSTANTIATE_TEST_SUITE_P(
    Run, SceneMistake,
    ::testing::Values(
        Mistake{"step = \"10 us\"", "step = 0", "run.step", "above zero"},
        Mistake{"step = \"10 us\"", "step = \"-1 us\"", "run.step", "above zero"},
        Mistake{"step = \"10 us\"", "step = \"10 mm\"", "run.step", "needs a time"},
        Mistake{"step = \"10 us\"", "step = \"1 s\"", "run.step", "longer than the run"},
        Mistake{"end  = \"0.1 s\"", "end = 0", "run.end", "after 'begin'"},
        Mistake{"step = \"10 us\"", "method = \"bfd\"\nstep = 1e-5", "run.method", "did you mean 'bdf'"},
        Mistake{"[start]", "[start]\nrule = \"steady\"\nangles = { crank = 1 }\ndriver = \"slide\"", "start.driver",
                "is not a rotor", -3},
        Mistake{"[start]\nq = { crank = \"120 deg\", \"frame.crown.uz\" = \"-0.6 mm\" }\nv = { crank = \"30 1/min\" }",
                "[start]\nrule = \"steady\"\nangles = { crank = 1 }", "start", "no driver"},
        Mistake{"step = \"10 us\"", "order = 7\nstep = 1e-5", "run.order", "1 to 6"},
        Mistake{"step = \"10 us\"", "order = 1.5\nstep = 1e-5", "run.order", "integer"}));

INSTANTIATE_TEST_SUITE_P(
    MatrixFrame, SceneMistake,
    ::testing::Values(
        Mistake{"[0, \"13 t\"]]", "[0]]", "frame.mass", "row 2 has 1 entries"},
        Mistake{"[0, \"13 t\"]]", "[0, \"-13 t\"]]", "frame.mass", "row 2 has -13000"},
        Mistake{"0], [0, \"13 t\"]]", "\"12 t\"], [\"12 t\", \"13 t\"]]", "frame.mass",
                "not positive semidefinite"}, // 9.5 * 13 < 12^2
        Mistake{"[[\"9.5 t\", 0], [0, \"13 t\"]]", "[[0, 0], [0, 0]]", "frame.mass", "zeros"},
        Mistake{"[0, \"13 t\"]]", "[0, 1e-308]]", "frame.mass", "row 2 has 1e-308 on the diagonal, negligible"},
        Mistake{"[0, \"13 t\"]]", "[0, 1e308]]", "frame.mass", "has 1e+308 as its largest entry"},
        Mistake{"[0, \"13 t\"]]", "[\"1 t\", \"13 t\"]]", "frame.mass", "one triangle of a symmetric matrix"},
        Mistake{"[0, \"13 t\"]]", "[0, \"13 kN\"]]", "frame.mass", "entry of a mass matrix"},
        Mistake{"\"3620 kN/mm\"]]", "\"-3620 kN/mm\"]]", "frame.stiffness", "row 2 has -3.62e+09 on the diagonal"},
        Mistake{"\"3620 kN/mm\"]]", "\"1000 kN/mm\"]]", "frame", "negative eigenvalue", 2},
        Mistake{"rows = { \"-uz\" = 2 }", "rows = { \"-uz\" = 3 }", "frame.interface.table.rows.-uz", "no row 3"},
        Mistake{"rows = { \"-uz\" = 2 }", "rows = { \"-uz\" = 1 }", "", "row 1 is crown.uz already"},
        Mistake{"rows = { \"-uz\" = 2 }", "rows = { up = 2 }", "", "is not a DOF"},
        Mistake{"[frame.interface.table]\nrows = { \"-uz\" = 2 }", "", "frame", "translations", 6},
        Mistake{"stiffness_row = [\"-3200 kN/mm\", ", "stiffness_row = [", "", "has 1 entries"}));

TEST(SceneMistakes, OfTheFileItselfAreNamed)
{
  EXPECT_THROW(apps::read_scene("no_such_scene.toml"), std::invalid_argument);
  EXPECT_THROW(apps::read_scene("."), std::invalid_argument);
  EXPECT_NE(complaint("\xff\xfe").find("scene.toml:1"), std::string::npos);
}

TEST(Scene, WithoutRunOrSignalsIsReadButNotRun)
{
  EXPECT_THROW(apps::require_run(scene_of("name = \"x\"\n")), std::invalid_argument);
  EXPECT_NO_THROW(apps::require_run(scene_of(small_scene())));
}

// --- frames from CAD

TEST(SceneFrame, FromCadBecomesTheSpecificationForFem)
{
  const auto  scene = scene_of(cad_scene());
  const auto &frame = scene.frame.geometry;
  EXPECT_EQ(apps::frame_path(scene), apps::FramePath::reduce);
  EXPECT_DOUBLE_EQ(frame.mesh.surface_size.at("bearing left"), 0.03); // by the pattern
  EXPECT_EQ(frame.mesh.surface_size.count("feet"), 0u);
  EXPECT_DOUBLE_EQ(frame.surfaces.at("feet").plane->normal[2], -1.); // made a unit vector
  EXPECT_EQ(frame.surfaces.at("feet").faces, 0);
  EXPECT_DOUBLE_EQ(frame.supports[0].stiffness[0], 4.2e8); // one number holds in all directions
  EXPECT_DOUBLE_EQ(frame.supports[0].damping[2], 3.);
  EXPECT_DOUBLE_EQ(frame.material.E, 210e9);
  EXPECT_EQ(complaint(cad_scene()), "");
}

TEST(SceneFrame, DampingAfterRayleighHasItsTwoRatios)
{
  const auto frame = scene_of(cad_scene("ratio = 0.02", "rayleigh = [{ frequency = 20, ratio = 0.01 }, "
                                                        "{ frequency = \"500 Hz\", ratio = 0.02 }]"))
                         .frame.geometry;
  for (const auto &[hz, zeta] : {std::pair{20., 0.01}, {500., 0.02}})
    EXPECT_NEAR(0.5 * (frame.rayleigh_mass / (2. * M_PI * hz) + frame.rayleigh_stiffness * 2. * M_PI * hz), zeta,
                1e-15);
}

TEST(SceneFrame, MatricesFromFilesAreThoseWrittenInline)
{
  const SceneFolder folder;
  folder.write("M.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 9500\n2 2 13000\n");
  folder.write("bad.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 9500\n");
  const std::string inline_mass = "[[\"9.5 t\", 0], [0, \"13 t\"]]";
  const auto        scene       = apps::read_scene(folder.write("scene.toml", small_scene(inline_mass, "\"M.mtx\"")));
  EXPECT_EQ(Eigen::MatrixXd(scene.frame.matrices.M), Eigen::MatrixXd(scene_of(small_scene()).frame.matrices.M));
  EXPECT_THROW(apps::read_scene(folder.write("bad.toml", small_scene(inline_mass, "\"bad.mtx\""))),
               std::invalid_argument);
}

TEST(SceneFrame, OfMatricesToBeReducedIsCheckedByItsNames)
{
  const std::string reduction = "[reduction]\nmethod = \"craig-bampton\"\n[run]";
  EXPECT_EQ(complaint(small_scene("[run]", reduction)), "");
  EXPECT_NE(complaint(small_scene("[run]", reduction), {"output.signals.x1=frame.crwn.uz"}).find("frame.crown.uz"),
            std::string::npos);
}

// --- names

TEST(NearestName, FindsSlipsAndLeavesOtherWordsAlone)
{
  EXPECT_EQ(edit_distance("crank", "crnak"), 1); // neighbours swapped are one slip
  EXPECT_EQ(nearest_name("stifness", {"damping", "stiffness"}), "stiffness");
  EXPECT_EQ(nearest_name("Crank", {"crank"}), "crank");
  EXPECT_EQ(nearest_name("flywheel", {"damping", "stiffness"}), "");
}

} // namespace
