// What a scene may say in more than one way, and where a message points to.

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/written_text.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;

TEST(PlaceOfAKey, IsBeforeTheOptionsThatChangedItsTable)
{
  EXPECT_EQ(apps::place_of_key("a.toml:3: frame", "damping"), "a.toml:3: frame.damping");
  EXPECT_EQ(apps::place_of_key("a.toml:3: frame: with --set frame.unit=1 mm", "damping"),
            "a.toml:3: frame.damping: with --set frame.unit=1 mm");
}

TEST(Messages, TellAFormulaWhereAValueIsNeeded)
{
  const std::string brake = "[element.drive]\ntype = \"speed drive\"\non = \"shaft\"\nproportional_gain = 1\n"
                            "speed = 1\ninitial_speed = \"10 rad/s*sin(2*pi*1 Hz*t)\"\n";
  expect_complaint(rotor(2., "1 s") + brake, "It would be a formula of the time t, but this key takes a value");
  // a wrong unit alone is no formula
  EXPECT_EQ(complaint(rotor(2., "1 s") + "[element.f]\ntype = \"friction\"\nfrom = \"shaft\"\nforce = \"2 t\"\n")
                .find("formula"),
            std::string::npos);
}

/// Of the options, those that set a key of the table or of its inner tables.
TEST(Messages, AboutATableNameTheOptionsThatChangedIt)
{
  const auto said = [](const std::vector<std::string> &options)
  { return complaint(test::cad_scene("ratio = 0.02", "ratio = 0.02, modes = [{ mode = 2, ratio = 0.01 }]"), options); };
  EXPECT_EQ(said({"name=other"}), "");
  const std::string clamped = said({"name=other", "frame.support.feet.clamped=true"});
  EXPECT_NE(clamped.find("frame.support.feet: with --set frame.support.feet.clamped=true: "), std::string::npos)
      << clamped;
  EXPECT_EQ(clamped.find("name=other"), std::string::npos) << clamped;
  EXPECT_EQ(complaint(test::cad_scene("foundation =", "clamped = true\nfoundation ="), {"name=other"}).find("--set"),
            std::string::npos);
}

/// Also of parameters on which the value depends through others.
TEST(Messages, AboutAValueNameTheOptionsThatChangedItsParameters)
{
  const std::string parameters = "[parameters]\nF = \"3 N\"\nG = \"2*F\"\nother = 1\n",
                    scene      = rotor(2., "1 s") + parameters +
                            "[element.f]\ntype = \"friction\"\nfrom = \"shaft\"\nforce = \"G*(1 m)\"\n";
  EXPECT_EQ(complaint(scene, {"parameters.other=2"}).find("parameters.F"), std::string::npos);
  const std::string said = complaint(scene, {"parameters.F=3 kg"});
  EXPECT_NE(said.find("element.f.force: "), std::string::npos) << said;
  EXPECT_NE(said.find(" (with --set parameters.F=3 kg)"), std::string::npos) << said;
}

const std::string two_slides =
    slider_body("a", "1", "[1, 0, 0]") + slider_body("b", "1", "[1, 0, 0]") + rotor_body("w", "1", "[0, 0, 1]");

std::string sum(const std::string &terms)
{
  return two_slides + measure("s", "sum", {{"terms", terms}}) + start("q = { a = 3, b = 5, w = 2 }") +
         steps("1 ms", "2 ms") + signals("s = 's.value'");
}

// A plain factor is a number where that fits, and else in SI: the radius of a pinion in m.
TEST(Messages, PlainFactorsOfASumFit)
{
  EXPECT_NEAR(run(sum("[{ of = \"b\" }, { of = \"a\", factor = 2 }]")).signal("s").final, 11., 1e-12);
  EXPECT_NEAR(run(sum("[{ of = \"w\", factor = -0.5 }, { of = \"a\" }]")).signal("s").final, 2., 1e-12);
  EXPECT_EQ(run(sum("[{ of = \"w\", factor = -0.5 }, { of = \"a\" }]")).signal("s").unit, "m");
  EXPECT_NEAR(run(sum("[{ of = \"a\", factor = 2 }, { of = \"b\", factor = -1 }]")).signal("s").final, 1., 1e-12);
  expect_complaint(sum("[{ of = \"a\", factor = 2 }, { of = \"w\", factor = -1 }]"), "give one factor a unit");
  expect_complaint(sum("[{ of = \"a\" }, { of = \"w\", factor = \"2 kg\" }]"), "all terms must be lengths");
}

// Factors of one motion count together, under each of its names and through other measures.
TEST(Messages, ASumThatIsZeroWhateverMovesIsRefused)
{
  const std::string zero = "measure.s.terms: cancel each other: the sum is always zero";
  expect_complaint(sum("[{ of = \"a\" }, { of = \"a\", factor = -1 }]"), zero);
  expect_complaint(sum("[{ of = \"a\", factor = 0 }]"), zero);
  expect_complaint(sum("[{ of = \"w\", factor = 0.3 }, { of = \"w.angle\", factor = -0.1 }, { of = \"w\", "
                       "factor = -0.2 }]"),
                   zero);
  EXPECT_EQ(complaint(sum("[{ of = \"a\" }, { of = \"b\", factor = -1 }]")), "");
  const std::string way  = measure("d", "along", {{"from", "b"}, {"to", "a"}, {"direction", "[1, 0, 0]"}}),
                    half = measure("h", "sum", {{"terms", "[{ of = \"d\", factor = 0.5 }]"}});
  expect_complaint(way + half + sum("[{ of = \"d\" }, { of = \"h\", factor = -2 }]"), zero);
}

// A table of TOML has no order: a measure may name one that stands below it.
TEST(Messages, TheOrderOfMeasuresDoesNotMatter)
{
  const std::string way  = measure("d", "along", {{"from", "b"}, {"to", "a"}, {"direction", "[1, 0, 0]"}}),
                    once = measure("s", "sum", {{"terms", "[{ of = \"d\", factor = 3 }]"}}),
                    both = measure("r", "sum", {{"terms", "[{ of = \"s\" }, { of = \"a\" }]"}}),
                    rest = start("q = { a = 3, b = 5, w = 2 }") + steps("1 ms", "2 ms") + signals("r = 'r.value'");
  for (const std::string &measures : {way + once + both, both + once + way, once + way + both})
    EXPECT_NEAR(run(two_slides + measures + rest).signal("r").final, 9., 1e-12) << measures;
}

TEST(Messages, ACycleOfMeasuresIsNamed)
{
  const std::string s = measure("s", "sum", {{"terms", "[{ of = \"t\" }]"}}),
                    t = measure("t", "sum", {{"terms", "[{ of = \"s\" }]"}});
  expect_complaint(two_slides + s + t, "measure.s: is defined by itself: 's' -> 't' -> 's'; define one of these");
  expect_complaint(two_slides + measure("s", "sum", {{"terms", "[{ of = \"s\" }, { of = \"a\" }]"}}), "'s' -> 's'");
}

const std::string pendulum = planar_body("p", "1", "1", "[1, 0, 0]", "[0, 0, 1]") + steps("1 ms", "2 ms") +
                             revolute("hinge", "ground", "p", "[0, 0, 0]");

TEST(Messages, APlanarHingeMayGiveTheAxisItHas)
{
  EXPECT_EQ(complaint(pendulum + "axis = [0, 0, -2]\n"), "");
  expect_complaint(pendulum + "axis = [0, 1, 0]\n", "joint.hinge.axis: 'p' rotates about its own axis only");
}

// The joint stands in line 10 of the scene.
TEST(Messages, PointToTheJointThatStaysOpen)
{
  expect_complaint(pendulum + "[start]\nq = { \"p.ux\" = 5, \"p.uy\" = 0 }\n", "scene.toml:10: joint.hinge: ");
}

// What is typed without quotes is no TOML; the line is shown as it must be.
TEST(Messages, SaysWhatALineThatIsNotTomlShouldBe)
{
  const auto expect = [](const std::string &line, const std::string &hint)
  { expect_complaint("name = \"a\"\n" + line + "\n", "scene.toml:2: is not valid TOML here: " + hint); };
  expect("step = 5 us", "put a value with a unit, and an expression, in quotes: \"5 us\"");
  expect("a = [0, 0, -9.81 m/s^2]", "put a value with a unit, and an expression, in quotes: \"-9.81 m/s^2\"");
  expect("k = 20°", "put a value with a unit, and an expression, in quotes: \"20°\"");
  expect("k = 2*crank - 8 mm # twice", "put a value with a unit, and an expression, in quotes: \"2*crank - 8 mm\"");
  expect("x = 1,5", "write a decimal point: 1.5");
  expect("x = 1,5 mm", "write a decimal point: \"1.5 mm\"");
  expect("x = 1,5e-3", "write a decimal point: 1.5e-3");
  expect("x = .5", "a number has digits on both sides of its point");
  expect("method = bdf", "a string needs quotes: \"bdf\"");
  expect("on = True", "write true or false");
  expect("method = “abc”", "quotes are \" or ', not “");
  expect("k : 3", "a key and its value are separated by =");
  expect("k = ", "a value is missing");
  expect("[element.crank pin]",
         "a name with characters other than letters, digits, _ and - needs quotes: [element.\"crank pin\"]");
  expect("crank pin = 3", "a key with characters other than letters, digits, _ and - needs quotes: \"crank pin\"");
  expect("k = \"abc", "a quote opened here is not closed");
}

TEST(Messages, NamesWhatIsDefinedTwice)
{
  const auto expect = [](const std::string &text, int line, const std::string &hint)
  { expect_complaint(text, "scene.toml:" + std::to_string(line) + ": is not valid TOML here: " + hint); };
  expect("[element.\"crank pin\"]\nk = 1\n[element.\"crank pin\"]\nk = 2\n", 3,
         "[element.\"crank pin\"] is defined twice in the file");
  expect("[element.'rod']\nk = 1\n[element.'rod']\n", 3, "[element.'rod'] is defined twice in the file");
  expect("[a.b]\nk = 1\n[[a.b]]\n", 3, "[a.b] is a single table above");
  expect("[body]\n\"x y\" = 1\n\"x y\" = 2\n", 3, "the key '\"x y\"' is defined twice in this table");
  expect("frame = \"a\"\n[frame.mesh]\nsize = 1\n", 2, "frame.mesh: the same name is used above for another value");
  expect("[body.slide]\nmass = 1\n[body]\nslide = 3\n", 4, "'slide' is already a table above");
  expect("a = [1, 2", 1, "the file ends inside an array");
}

TEST(Messages, SayHowALargeNumberIsWritten)
{
  expect_complaint("x = 1e400\n", "scene.toml:1: a number exceeds 1.8e308");
  expect_complaint("x = 99999999999999999999\n", "scene.toml:1: a number has too many digits");
}

TEST(Messages, ProposeTheInterfaceWhoseNameIsGivenAlone)
{
  expect_complaint(pendulum + "[frame]\nmass = [[1]]\ndamping = [[0]]\nstiffness = [[1]]\n"
                              "[frame.interface.guide]\nrows = { ux = 1 }\n[element.s]\ntype = \"spring-damper\"\nfrom "
                              "= \"p\"\nto = \"guide\"\n"
                              "direction = [1, 0, 0]\nstiffness = 1\n",
                   "did you mean 'frame.guide'?");
}

// Of some hundred signals the nearest few.
TEST(Messages, AnUnknownSignalIsAnsweredInALine)
{
  std::string many;
  for (int i = 0; i < 20; ++i)
    many += point_body("b" + std::to_string(i), "1", vector(i, 0., 0.));
  const std::string said = complaint(many + pendulum + "[output.signals]\nx = \"nothing like that\"\n");
  EXPECT_NE(said.find("the nearest of "), std::string::npos) << said;
  EXPECT_LT(said.size(), 300u) << said;
  const std::string part = complaint(many + pendulum + "[output.signals]\nx = \"hinge\"\n");
  EXPECT_NE(part.find("did you mean one of 'hinge."), std::string::npos) << part;
}

TEST(Messages, AnElementOnABodyNamesItsKey)
{
  expect_complaint(rotor(1., "1 s") + "[element.f]\ntype = \"force\"\non = \"shaft\"\nconstant = \"1 N m\"\n",
                   "on: 'shaft' is not a measure; a body or an interface is named by `from`");
}

TEST(Messages, AShareAboveOneIsPercent)
{
  const std::string motor = "[element.m]\ntype = \"asynchronous motor\"\non = \"shaft\"\nbreakdown_torque = 1\n"
                            "synchronous_speed = \"1500/min\"\nbreakdown_slip = ";
  expect_complaint(rotor(1., "1 s") + motor + "15\n",
                   "breakdown_slip: needs a value of at most 1, got 15; write percent as \"15 %\"");
  EXPECT_EQ(complaint(rotor(1., "1 s") + motor + "\"15 %\"\n"), "");
}

std::vector<std::string> warnings(const std::string &text)
{
  return apps::check_scene(test::scene_of(text));
}

TEST(Messages, ABodyOnWhichNothingActsIsNamedWithItsPlace)
{
  const std::string stray = point_body("stray", "1", "[3, 0, 0]");
  EXPECT_EQ(warnings(pendulum), std::vector<std::string>{});
  const auto said = warnings(pendulum + stray);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("scene.toml:15: body.stray: only its weight acts on the body \"stray\""), std::string::npos)
      << said[0];
  EXPECT_EQ(warnings(pendulum + stray +
                     "[element.f]\ntype = \"force\"\nfrom = \"stray\"\ndirection = [1, 0, 0]\nconstant = 1\n"),
            std::vector<std::string>{});
}

TEST(Messages, AJointFarFromBothBodiesIsNamedWithTheDistance)
{
  const auto bar = [](const std::string &at)
  {
    return pendulum + planar_body("bar", "1", "1", "[1.4, 0, 0]", "[0, 0, 1]") +
           revolute("elbow", "p", "bar", "[" + at + ", 0, 0]");
  };
  EXPECT_EQ(warnings(bar("1.2")), std::vector<std::string>{});
  const auto said = warnings(bar("12")); // cm?
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("the joint \"elbow\" is 10.6 m from \"p\" and \"bar\""), std::string::npos) << said[0];
}

// What a file can be made of without an end, and what a parser with a stack would end by a signal for.
TEST(Messages, RefuseWhatIsDeeperThanAnyScene)
{
  const auto repeated = [](const std::string &text, int n)
  {
    std::string all;
    for (int i = 0; i < n; ++i)
      all += text;
    return all;
  };
  const auto deep = [&](const std::string &text) { expect_complaint("x = 1\n" + text, "more than 50 deep"); };
  deep("a = " + repeated("[", 6000) + repeated("]", 6000));
  deep("a = " + repeated("{b = ", 6000) + "1" + repeated("}", 6000));
  deep(repeated("a.", 20000) + "a = 1\n");
  deep("[" + repeated("a.", 20000) + "a]\n");
  std::string chain = "[parameters]\n";
  for (int i = 2000; i > 0; --i)
    chain += "p" + std::to_string(i) + " = \"p" + std::to_string(i - 1) + " + 1\"\n";
  expect_complaint(chain + "p0 = 1\n", "a chain of 500 parameters");
}

TEST(Messages, BracketsInTextsAndCommentsAreNotDeep)
{
  std::string note;
  for (int i = 0; i < 100; ++i)
    note += "[{(";
  const auto scene = test::scene_of("description = \"" + note + "\" # " + note + "\n" + pendulum);
  EXPECT_EQ(scene.description, note);
}

// What one program writes into a scene another call reads.
TEST(WrittenText, ReadsBackAsItWas)
{
  for (const std::string text : {"plain", "a \"quoted\" word", "back\\slash", "two\nlines\tand a tab"})
    EXPECT_EQ(test::scene_of("description = " + apps::written_text(text) + "\n" + pendulum).description, text);
}

TEST(Messages, ARunNeedsNoSignals)
{
  const auto motion = run(pendulum);
  EXPECT_EQ(motion.result.signals.size(), 0u);
}

} // namespace
} // namespace gestell::tests
