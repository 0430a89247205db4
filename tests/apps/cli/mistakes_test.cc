// Typical mistakes of a first day: each is answered with its place, what stands there and a way out, by exit code 2, or
// by a warning where it might be meant.  press_minimal.toml or a scene to start from, with one thing wrong.

#include "tests/support/program.h"
#include "tests/support/test.h"

#include <regex>

namespace gestell::tests
{
namespace
{

using Edits = std::vector<std::pair<std::string, std::string>>;

/// What is written wrong, what the answer says of it, and whether it is refused (2) or warned of (0).
struct Mistake
{
  std::string              name;
  Edits                    edits; ///< from, to
  std::vector<std::string> words;
  int                      exit_code = 2;
  std::string              command   = "check";
};

void PrintTo(const Mistake &mistake, std::ostream *out)
{
  *out << mistake.name;
}

std::string edited(std::string text, const Edits &edits)
{
  for (const auto &[from, to] : edits)
  {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos)
      text.replace(at, from.size(), to);
  }
  return text;
}

bool has_place(const std::string &text)
{
  return std::regex_search(text, std::regex(R"(scene\.toml:[0-9]+: )"));
}

class MistakeInAScene : public testing::TestWithParam<Mistake>
{
};

std::string name_of(const testing::TestParamInfo<Mistake> &info)
{
  return info.param.name;
}

const std::vector<Mistake> of_the_press = {
    {"WrongUnit", {{"mass     = \"m3\"", "mass = \"3200 mm\""}}, {"3200 mm", "needs a mass such as \"3 t\""}},
    {"UnknownUnit", {{"\"80 mm\"", "\"80 milimeter\""}}, {"80 milimeter", "unknown unit 'milimeter'"}},
    {"UnitsThatDoNotFit", {{"\"80 mm\"", "\"80 kg\""}}, {"2*r - z_BDC", "both must have the same dimension"}},
    {"MisspeltKey", {{"breakdown_torque  =", "breakdown_torqe ="}}, {"breakdown_torqe", "'breakdown_torque'"}},
    {"MisspeltKeyBesideWhatIsMissing",
     {{"step   = \"10 us\"", "stp = \"10 us\""}},
     {"run: unknown key 'stp'", "'step'"}},
    {"TorqueOnAMassThatDoesNotTurn",
     {{"[element.sheet]", "[element.shake]\ntype = \"force\"\nfrom = \"frame.crown\"\nabout = [0, 1, 0]\n"
                          "constant = \"1 N m\"\n[element.sheet]"}},
     {"element.shake", "\"frame.crown\" does not rotate about [0, 1, 0]",
      "its DOFs on the frame: uz; name another DOF"}},
    {"ProfileAcrossAMassThatIsHeld",
     {{"[element.sheet]", "[element.shake]\ntype = \"force profile\"\nfrom = \"frame.crown\"\ndirection = [1, 0, 0]\n"
                          "profile = \"10 N*sin(t/s)\"\n[element.sheet]"}},
     {"element.shake", "\"frame.crown\" does not move along [1, 0, 0]", "its DOFs on the frame: uz"}},
    {"SpringAcrossAMassThatIsHeld",
     {{"[element.sheet]", "[element.shake]\ntype = \"spring-damper\"\nfrom = \"frame.crown\"\nto = \"frame.table\"\n"
                          "direction = [0, 1, 0]\nstiffness = \"1 N/mm\"\n[element.sheet]"}},
     {"element.shake", "does not move along [0, 1, 0]", "name another DOF"}},
    {"MeasureAcrossAMassThatIsHeld",
     {{"[element.sheet]", "[measure.lean]\ntype = \"along\"\nfrom = \"frame.crown\"\nto = \"frame.table\"\n"
                          "direction = [1, 0, 0]\n[element.sheet]"}},
     {"measure.lean", "frame.crown", "always zero"}},
    {"SignalOfAMotionThatIsHeld",
     {{"\"-frame.crown.uz\"", "\"frame.crown.rx\""}},
     {"'frame.crown.rx' is always zero", "the frame has no such DOF", "name another"}},
    {"MisspeltTable", {{"[output.signals]", "[outputs.signals]"}}, {"outputs", "did you mean 'output'"}},
    {"ForgottenQuotes", {{"\"80 mm\"", "80 mm"}}, {"in quotes: \"80 mm\""}},
    {"QuoteNotClosed", {{"\"3200 kg\"", "\"3200 kg"}}, {"a quote opened here is not closed"}},
    {"ArrayNotClosed", {{"[0, 0, \"-g\"]", "[0, 0, \"-g\""}}, {"an array above is not closed", "[value, value]"}},
    {"NameThatIsNotThere", {{"= \"slide\"", "= \"slid\""}}, {"'slid'", "did you mean 'slide'"}},
    {"MassZero", {{"\"3200 kg\"", "\"0 kg\""}}, {"m3, which is 0", "above zero such as \"3 t\""}},
    {"MassNegative", {{"\"3200 kg\"", "\"-3200 kg\""}}, {"m3, which is -3200", "above zero"}},
    {"MassNotANumber", {{"\"3200 kg\"", "nan"}}, {"m3", "is not a finite number"}},
    {"StepLongerThanTheRun", {{"\"10 us\"", "\"1 s\""}}, {"run.step", "longer than the run, 0.45 s"}},
    {"StepZero", {{"\"10 us\"", "0"}}, {"run.step", "above zero such as \"10 us\", got 0"}},
    {"EndBeforeStart", {{"\"t_end\"\n\n", "\"-1 s\"\n\n"}}, {"run.end", "must be after 'begin'", "-1 s"}},
    {"NoRun",
     {{"[run]\nmethod = \"bdf\"\norder  = 2\nstep   = \"10 us\"\nend    = \"t_end\"\n", ""}},
     {"there is no [run]", "end = \"0.5 s\""},
     2,
     "run"},
    {"AxisOfTwoNumbers", {{"[0, 1, 0]", "[0, 1]"}}, {"body.flywheel.axis", "three values [x, y, z], got 2"}},
    {"AxisOfNoLength", {{"[0, 1, 0]", "[0, 0, 0]"}}, {"body.flywheel.axis", "cannot be [0, 0, 0]"}},
    {"DegreesForRadians",
     {{"crank = \"2.0943951023931953 rad\"", "crank = 120"}},
     {"start.q.crank", "is 120 rad", "\"120 deg\""},
     0},
    {"CommaInText", {{"\"80 mm\"", "\"0,08 m\""}}, {"0,08 m", "write 0.08"}},
    {"CommaInANumber", {{"s_K     = 0.15", "s_K = 0,15"}}, {"write a decimal point: 0.15"}},
    {"PercentWithoutQuotes", {{"s_K     = 0.15", "s_K = 15%"}}, {"in quotes: \"15%\""}},
    {"DuplicateKey", {{"order  = 2", "order  = 2\norder = 3"}}, {"'order' is defined twice", "remove one"}},
    {"DuplicateTable", {{"[output.signals]", "[run]\n[output.signals]"}}, {"[run] is defined twice", "under one head"}},
    {"CyclicParameters",
     {{"\"80 mm\"", "\"l/10\""}, {"\"800 mm\"", "\"10*r\""}},
     {"parameters.r", "depends on itself: r -> l -> r"}},
    {"UnknownParameter", {{"\"k_s * L_s * h\"", "\"k_s * L_z * h\""}}, {"'L_z'", "did you mean 'L_s'"}},
    {"DivisionByZero", {{"\"3200 kg\"", "\"3200 kg / 0\""}}, {"3200 kg / 0", "divides by zero"}},
    {"PlayNegative", {{"\"0.4 mm\"", "\"-0.4 mm\""}}, {"element.rod.clearance", "of zero or more, got s_cl"}},
    {"ShareAboveOne", {{"rho_R = 0.08", "rho_R = 8"}}, {"friction_share = 8", "between 0 and 1"}},
    {"CrankLongerThanTheRod", {{"\"80 mm\"", "80"}}, {"length [m] = 0.8", "longer than the crank radius"}},
    {"GravityUpwards", {{"\"-g\"", "\"g\""}}, {"acts upwards, along +z", "-9.81 m/s^2"}, 0},
    {"GravityAsOneNumber", {{"[0, 0, \"-g\"]", "9.81"}}, {"gravity", "three numbers [x, y, z], got 9.81"}},
    {"GravityInMillimetres", {{"\"9.81 m/s^2\"", "9810"}}, {"is 9810 m/s^2", "-9810 mm/s^2"}, 0},
    {"MassOfAShip", {{"\"3200 kg\"", "\"3200000 t\""}}, {"body.slide", "mass of 3.2e+09 kg", "\"3 t\""}, 0},
    {"SignalOfAnUnknownBody", {{"\"slide.displacement\"", "\"slde.displacement\""}}, {"did you mean 'slide.disp"}},
    {"UnknownQuantity", {{"\"slide.displacement\"", "\"slide.way\""}}, {"\"slide.way\"", "'slide.velocity'"}},
    {"UnknownMethod", {{"\"bdf\"", "\"rk4\""}}, {"there is no 'rk4'", "'newmark'"}},
    {"OrderOutOfRange", {{"order  = 2", "order  = 9"}}, {"order is 9", "1 to 6"}},
    {"UnknownType", {{"\"blanking force\"", "\"blank force\""}}, {"'blank force'", "'blanking force'"}},
    {"TextForANumber", {{"order  = 2", "order  = \"two\""}}, {"\"two\"", "a number is given as"}},
    {"NumberForText", {{"\"bdf\"", "2"}}, {"run.method", "needs a string in quotes, got 2"}},
    {"UnknownCoordinate", {{" slide = \"0.11", " slider = \"0.11"}}, {"'slider'", "did you mean 'slide'"}},
};

const std::vector<Mistake> of_a_frame = {
    {"DampingInPercent", {{"ratio = 0.015", "ratio = 1.5"}}, {"ratio: a damping ratio of 1 or more", "0.01 to 0.03"}},
    {"InterfaceWithoutSurface", {{"surface  = \"guide\"\n", ""}}, {"frame.interface.guide", "'surfaces' is missing"}},
    {"SurfaceThatIsNotThere", {{"surface = \"floor\"", "surface = \"flor\""}}, {"flor", "did you mean 'floor'"}},
    {"FileThatIsNotThere", {{".geo\"", ".step\""}}, {"frame.cad", "there is no file", "relative paths start at"}},
    {"UnknownMaterial", {{"\"steel\"", "\"steal\""}}, {"'steal'", "did you mean 'steel'"}},
    {"ForgottenFrom", {{"from = \"crank\"\n", ""}}, {"joint.\"crank pin\"", "'from' is missing"}},
    {"UnknownCoupling", {{"coupling = \"rigid\"", "coupling = \"rigd\""}}, {"'rigd'", "did you mean 'rigid'"}},
    {"HalfAMode", {{"modes  = 20", "modes  = 20.5"}}, {"reduction.modes", "an integer, got 20.5"}},
    {"BounceAboveOne", {{"restitution = 0.6", "restitution = 6"}}, {"restitution = 6", "at most 1"}},
    {"StiffnessOfAnotherKind", {{"\"1e9 N/m\"", "\"1e9 N\""}}, {"1e9 N", "such as \"420 kN/mm\""}},
    {"InertiaInMillimetres",
     {{"\"0.5 kg m^2\"", "\"0.05 kg mm^2\""}},
     {"body.rod", "radius of gyration", "another unit"},
     0},
};

std::string press_scene()
{
  return read(GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml");
}

void expect_told(const Mistake &mistake, const std::string &scene, const Folder &folder)
{
  const std::string path   = folder.file("scene.toml", edited(scene, mistake.edits));
  const Answer      answer = gestell(mistake.command + ' ' + path + folder.option());
  expect_answer(answer, mistake.exit_code, mistake.words);
  EXPECT_TRUE(has_place(answer.text)) << answer.text;
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

} // namespace

TEST_P(MistakeInAScene, IsAnsweredWithPlaceValueAndWayOut)
{
  const Folder folder("mistake");
  expect_told(GetParam(), press_scene(), folder);
}
INSTANTIATE_TEST_SUITE_P(Press, MistakeInAScene, testing::ValuesIn(of_the_press), name_of);

class MistakeInAFrame : public MistakeInAScene
{
};

TEST_P(MistakeInAFrame, IsAnsweredWithPlaceValueAndWayOut)
{
  const Folder      folder("mistake");
  const std::string there = (folder / "start.toml").string();
  ASSERT_EQ(gestell("new slider-crank '" + there + "'").exit_code, 0);
  expect_told(GetParam(), read(there), folder);
}
INSTANTIATE_TEST_SUITE_P(Portal, MistakeInAFrame, testing::ValuesIn(of_a_frame), name_of);

TEST(MistakeInAFile, IsAnsweredWithItsLineAndWhatToSaveItAs)
{
  const Folder folder("mistake");
  const auto   check = [&](const std::string &text) { return gestell("check " + folder.file("scene.toml", text)); };
  std::string  wide;
  for (const char c : press_scene())
    wide += {c, '\0'};
  expect_answer(check("\xFF\xFE" + wide), 2, {"scene.toml:1: ", "encoding UTF-8"});
  expect_answer(check(edited(press_scene(), {{"# drive", "# Antrieb f\xFCr"}})), 2,
                {"scene.toml:17: ", "save the file as UTF-8"});
  expect_answer(check(edited(press_scene(), {{"step   = \"10 us\"", "step   = 1e400"}})), 2,
                {"scene.toml:196: ", "exceeds 1.8e308"});
  expect_answer(check("ISO-10303-21;\n"), 2, {"scene.toml:1: ", "gestell mesh FILE", "frame.cad"});
  expect_answer(check(""), 2, {"has no moving part", "[body.NAME]"});
  EXPECT_EQ(check("\xEF\xBB\xBF" + press_scene()).exit_code, 0); // what editors of Windows put there
  EXPECT_EQ(check(std::regex_replace(press_scene(), std::regex("\n"), "\r\n")).exit_code, 0);
  EXPECT_EQ(check(edited(press_scene(), {{"method =", "\tmethod\t="}})).exit_code, 0);
}

TEST(MistakeOnTheCommandLine, IsAnsweredWithTheOptionAndWhatItTakes)
{
  const Folder      folder("mistake");
  const std::string file = scene("press_minimal.toml");
  const auto run = [&](const std::string &options) { return gestell("run " + file + folder.option() + options); };
  expect_answer(run("--compare nothere.toml"), 2, {"gestell: run: --compare", "there is no file nothere.toml"});
  expect_answer(run("--sensitivities s_cl"), 2, {"--sensitivities s_cl", "write parameters.s_cl"});
  expect_answer(run("--sensitivities run.step"), 2, {"run.step", "parameters.NAME"});
  expect_answer(run("--set run.stp=1e-5"), 2, {"--set run.stp=1e-5", "did you mean 'step'"});
  expect_answer(run("--set run.step"), 2, {"needs the form key.path=value"});
  expect_answer(run("--set frame.damping='[[-1e6, 0], [0, -1e6]]'"), 2, {"frame.damping"});
  expect_answer(run("--set output.signals='[\"rod.force\", \"rod.force\"]'"), 2, {"duplicate"});
  expect_answer(run("--set run.step=1e-13"), 2, {"run.step"});
  expect_answer(run("--set run.method=newmark --set run.beta=0 --set run.step=1e-2"), 2, {"unstable"});
  expect_answer(run("--set parameters.c_el='\"1000 kN/mm\"'"), 2, {"elastic_stiffness"});
  expect_answer(run("--jobs 0"), 2, {"gestell: run: --jobs", "above zero, got 0"});
  expect_answer(run("--checkpoint nan"), 2, {"--checkpoint", "zero or above, got nan"});
  expect_answer(run("--checkpoint -5"), 2, {"--checkpoint", "zero or above, got -5"});
  expect_answer(run("--fast"), 2, {"there is no option --fast"});
  expect_answer(run("--qiuet"), 2, {"there is no option --qiuet; did you mean '--quiet'?"});
  expect_answer(run("--resume"), 2, {"checkpoint.bin", "does not exist", "without --resume"});
  expect_answer(run("--resume --sensitivities all"), 2, {"--resume", "omit one of the two"});
  expect_answer(gestell("chek " + file), 2, {"no command 'chek'", "did you mean 'check'"});
  expect_answer(gestell("foo"), 2, {"there is no command 'foo'; valid: 'run', 'modes'"});
  expect_answer(gestell("check a.toml b.toml"), 2, {"'b.toml' is an unexpected extra argument"});
  expect_answer(gestell("check nothere.toml"), 2, {"nothere.toml", "give the path of a .toml file"});
  expect_answer(gestell("check"), 2, {"gestell: check: SCENE is required", "--help"});
  expect_answer(gestell("run " + file + " -o /proc/x"), 2, {"/proc/x", "name a folder that can be written with -o"});
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

TEST(DampingThatIsWanted, IsRefusedWithTheReasonWhereTheFrameCannotGiveIt)
{
  const Folder folder("mistake");
  const auto   ask = [&](const std::string &wanted)
  { return gestell("modes " + scene("cam_follower.toml") + folder.option() + "--damping-for " + wanted); };
  expect_answer(ask("1=0.02"), 0, {"frame.damping.ratio = 0.0237", "mode 1 of the coupled machine"});
  expect_answer(ask("1=0.0001"), 2,
                {"--damping-for 1=0.0001", "0.0253 % without damping", "would have to be negative"});
  expect_answer(ask("2=0.5"), 2, {"even a ratio of 0.999", "the frame contributes too little to this mode"});
  expect_answer(ask("9=0.1"), 2, {"mode 9 does not exist; the machine has 2 modes"});
  expect_answer(ask("1"), 2, {"--damping-for 1: needs the number of a mode", "such as 3=0.02"});
}

/// Without dampers a mode has the ratio of the frame.
TEST(DampingThatIsWanted, IsThatOfAFrameWithoutDampers)
{
  const Folder folder("wanted_damping");
  expect_answer(gestell("modes " GESTELL_SOURCE_DIR "/apps/verification/scenes/bar_life.toml" + folder.option() +
                        "--damping-for 1=0.05"),
                0, {"With frame.damping.ratio = 0.05 mode 1", "has the damping ratio 0.05; without it, 0."});
}

// The file system says of such names neither that anything is there nor that nothing is.
TEST(NameThatCannotBeReached, IsAnsweredWithItsPlaceAndTheReasonWhereverItStands)
{
  const Folder      folder("mistake");
  const std::string longer(300, 'x'), ring = (folder / "ring").string(), press_scene = scene("press_minimal.toml");
  std::filesystem::create_symlink("ring", ring);
  for (const auto &[name, reason] :
       {std::pair<std::string, std::string>{longer, "File name too long"}, {ring, "Too many levels of symbolic links"}})
  {
    for (const std::string command : {"check", "run", "study", "reduce", "show", "mesh"})
      expect_answer(gestell(command + " " + name), 2, {name, reason});
    const auto check = [&, key = name](const std::string &text)
    { return gestell("check " + folder.file("scene.toml", std::regex_replace(text, std::regex("NAME"), key))); };
    expect_answer(check("extends = \"NAME\"\n"), 2, {"scene.toml:1: extends = ", name, reason});
    expect_answer(check("[frame]\ncad = \"NAME\"\n"), 2, {"scene.toml:2: frame.cad", name, reason});
    expect_answer(gestell("run " + press_scene + " -o " + name), 2, {name, reason, "name a folder"});
    expect_answer(gestell("export " + press_scene + " --fmu " + name + "/x.fmu"), 2, {name, reason});
    expect_answer(gestell("new crane " + name + "/x.toml"), 2, {name, reason});
  }
  expect_answer(gestell("run " + press_scene + " -o ''"), 2, {"--output", "is empty; give a value"});
}

// They have no end, and some of them no begin.
TEST(DeviceInPlaceOfAFile, IsRefusedByEveryDoor)
{
  const Folder folder("mistake");
  for (const std::string command : {"check", "run", "study"})
    for (const char *device : {"/dev/zero", "/dev/null"})
      expect_answer(gestell(command + " " + device), 2, {device, "is a device"});
  expect_answer(gestell("run " + scene("press_minimal.toml") + folder.option() + "--compare /dev/zero"), 2,
                {"--compare", "/dev/zero is a device"});
  const auto check = [&](const std::string &text) { return gestell("check " + folder.file("scene.toml", text)); };
  expect_answer(check("extends = \"/dev/zero\"\n"), 2, {"/dev/zero", "is a device"});
  expect_answer(check("[frame]\nmass = \"/dev/zero\"\nstiffness = \"/dev/zero\"\n"), 2,
                {"scene.toml:2: frame.mass", "is a device"});
  expect_answer(shell("(yes '# a line' | '" GESTELL_BINARY_DIR "/bin/gestell' check /dev/stdin 2>&1)"), 2,
                {"more than 64 MB"});
}

// Memory and time grow with them: judged before anything is computed.
TEST(Mistakes, CountsBeyondAllMemoryAreRefusedAtOnce)
{
  for (const std::string call :
       {"chart %1 --samples 1000000000", "modes %1 --along crank --positions 1000000000",
        "frf %1 --from frame.crown.uz --to F_P --points 1000000000", "periodic %1 --starts 1000000000",
        "periodic %1 --harmonics 1000000000", "periodic %1 --section 1000000000"})
  {
    std::string own = call;
    own.replace(own.find("%1"), 2, scene("press_minimal.toml"));
    expect_answer(gestell(own), 2, {"needs a number up to 1", ", got 1000000000"});
  }
}

} // namespace gestell::tests
