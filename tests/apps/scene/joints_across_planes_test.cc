// Joints hold in all directions that they claim, whatever the bodies are that they join, or the scene is refused.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

const std::string short_run = "[run]\nmethod = \"bdf\"\nstep = \"5 ms\"\nend = \"50 ms\"\n[output]\npicture_step = 0\n";

struct Kind
{
  std::string name, text;
};

/// Of each kind of body one or more, in planes and about axes of no relation.
const std::vector<Kind> kinds = {
    {"ground", ""},
    {"rotor", "type = \"rotor\"\naxis = [0, 1, 0]\ninertia = 0.1\n"},
    {"crossed rotor", "type = \"rotor\"\naxis = [1, 0, 0]\ninertia = 0.1\n"},
    {"slider", "type = \"slider\"\naxis = [1, 0, 0]\nmass = 2\nposition = [0.3, 0, 0]\n"},
    {"crossed slider", "type = \"slider\"\naxis = [0, 1, 0]\nmass = 2\nposition = [0.3, 0, 0]\n"},
    {"point", "type = \"point\"\nmass = 2\nposition = [0.1, 0.05, 0.2]\n"},
    {"planar", "type = \"planar\"\nnormal = [0, 1, 0]\nmass = 2\ninertia = 0.1\nposition = [0.3, 0.05, 0.1]\n"},
    {"crossed planar", "type = \"planar\"\nnormal = [1, 0, 0]\nmass = 2\ninertia = 0.1\nposition = [0.1, 0.2, 0.1]\n"},
    {"skew planar", "type = \"planar\"\nnormal = [0, 0.6, 0.8]\nmass = 2\ninertia = 0.1\nposition = [0.3, 0.2, 0]\n"},
    {"rigid", "type = \"rigid\"\nmass = 2\ninertia = [0.1, 0.12, 0.15]\nposition = [0.3, 0, 0.1]\n"}};

std::string body(const std::string &name, const Kind &kind)
{
  return kind.text.empty() ? "" : "[body." + name + "]\n" + kind.text;
}

std::string marker(const std::string &name, const Kind &kind)
{
  return kind.text.empty() ? "ground" : name;
}

constexpr double at_a[] = {0.1, 0.05, 0.2};

std::string place(double y)
{
  return "[0.1, " + std::to_string(y) + ", 0.2]";
}

std::string pair_of(const Kind &a, const Kind &b, const std::string &type, double y_b)
{
  const bool  in_space = a.name == "rigid" || b.name == "rigid";
  std::string scene = body("a", a) + body("b", b) + "[joint.j]\ntype = \"" + type + "\"\nfrom = \"" + marker("a", a) +
                      "\"\nto = \"" + marker("b", b) + "\"\nat_from = " + place(at_a[1]) + "\nat_to = " + place(y_b) +
                      "\n" + (type == "revolute" && in_space ? "axis = [0, 1, 0]\n" : "") + short_run +
                      "[output.signals]\n";
  std::string places;
  for (const auto &[name, kind, y] : {std::tuple{"a", a, at_a[1]}, std::tuple{"b", b, y_b}})
    if (!kind.text.empty())
    {
      places += std::string("[place.p_") + name + "]\non = \"" + name + "\"\nat = " + place(y) + "\n";
      for (const char *axis : {"x", "y", "z"})
        scene += std::string(name) + axis + " = \"p_" + name + "." + axis + "\"\n";
    }
  return "gravity = [1, 2, -3]\n" + places + scene;
}

/// Largest distance [m] of the two places in any direction and at any time.
double opening(const SceneRun &motion, const Kind &a, const Kind &b, double y_b)
{
  const double at_b[] = {at_a[0], y_b, at_a[2]};
  double       open   = 0.;
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
  {
    std::size_t column = 1;
    double      x[2][3];
    for (const auto &[body, kind, fixed] : {std::tuple{0, a, at_a}, std::tuple{1, b, at_b}})
      for (int d = 0; d < 3; ++d)
        x[body][d] = kind.text.empty() ? fixed[d] : motion.at(row, column++);
    for (int d = 0; d < 3; ++d)
      open = std::max(open, std::abs(x[0][d] - x[1][d]));
  }
  return open;
}

// What a joint holds together stays together in x, y and z; what cannot is refused at the start.
TEST(JointsAcrossPlanes, HoldInEveryDirectionOrAreRefused)
{
  int held = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    for (std::size_t k = i; k < kinds.size(); ++k)
      for (const std::string type : {"revolute", "spherical", "rigid"})
        for (const double y_b : {at_a[1], at_a[1] + 0.02})
        {
          const Kind &a = kinds[i], &b = kinds[k];
          try
          {
            const SceneRun motion = run(pair_of(a, b, type, y_b));
            EXPECT_LT(opening(motion, a, b, y_b), 1e-9) << type << ", " << a.name << ", " << b.name;
            ++held;
          }
          catch (const std::invalid_argument &)
          {
          }
        }
  EXPECT_GT(held, 60);
}

TEST(JointsAcrossPlanes, AGapThatNoBodyCanCloseIsReportedWithItsSize)
{
  const Kind &planar = kinds[6], &rotor = kinds[1], &ground = kinds[0];
  for (const auto &[a, b] :
       {std::pair{planar, planar}, std::pair{rotor, planar}, std::pair{ground, planar}, std::pair{rotor, rotor}})
    for (const std::string type : {"revolute", "spherical", "rigid"})
    {
      const std::string said = test::complaint(pair_of(a, b, type, at_a[1] + 0.02));
      EXPECT_NE(said.find("joint.j: has a gap of 0.02 m along [0, 1, 0]"), std::string::npos) << type << ": " << said;
      EXPECT_NE(said.find("give only 'at'"), std::string::npos) << said;
    }
}

// A pin has one axis: that of the one body is not that of the other.
TEST(JointsAcrossPlanes, ARevoluteJointOfTwoAxesIsRefused)
{
  expect_complaint(pair_of(kinds[1], kinds[7], "revolute", at_a[1]), "axes that are 90 deg apart");
  expect_complaint(pair_of(kinds[6], kinds[8], "revolute", at_a[1]), "\"spherical\" if they only share a point");
}

TEST(JointsAcrossPlanes, AScrewAskewToItsShaftIsRefused)
{
  expect_complaint(body("shaft", kinds[1]) + body("nut", kinds[3]) +
                       "[joint.j]\ntype = \"screw\"\nfrom = \"shaft\"\nto = \"nut\"\nat_from = [0, 0, 0]\n"
                       "at_to = [0.3, 0, 0]\naxis = [0.6, 0.8, 0]\npitch = \"10 mm\"\n" +
                       short_run + "signals = { }\n",
                   "is not parallel to the axis of 'shaft'");
}

// The pin of a crank about y leaves the plane z = 0.2 of the body at once: held there, the crank stands still.
TEST(JointsAcrossPlanes, ABodyHoldsInItsPlaneWhatWouldLeaveIt)
{
  const Kind     across{"across",
                    "type = \"planar\"\nnormal = [0, 0, 1]\nmass = 2\ninertia = 0.1\nposition = [0, 0, 0.2]\n"};
  std::string    scene  = pair_of(kinds[1], across, "spherical", at_a[1]);
  const SceneRun motion = run(scene + "phi = \"a.angle\"\n[start]\nv = { \"b.angle\" = 1 }\n", {});
  EXPECT_NEAR(motion.signal("phi").max - motion.signal("phi").min, 0., 1e-9);
}

// Described where the pin does not move across, the joint holds it there all the same: a crank on a slide locks.
TEST(JointsAcrossPlanes, ADirectionThatIsIdleInTheReferenceConfigurationIsHeld)
{
  const std::string crank = rotor_body("crank", "0.1", "[0, 1, 0]") + slider_body("slide", "1", "[1, 0, 0]") +
                            revolute("pin", "crank", "slide", "[0, 0, 0.1]");
  expect_complaint(crank + start("v = { crank = 1 }") + short_run + "signals = { x = \"slide.displacement\" }\n",
                   "constrains nothing that could move");
}

/// Along its normal a body in a plane cannot slide, so that both directions of the plane are held.
TEST(JointsAcrossPlanes, ALineAcrossThePlaneHoldsBothDirections)
{
  for (const std::string type : {"cylindrical", "prismatic"})
  {
    const SceneRun motion = run("gravity = [1, 2, -3]\n" + body("bar", kinds[6]) + "[joint.j]\ntype = \"" + type +
                                "\"\nfrom = \"ground\"\nto = \"bar\"\nat = [0.3, 0.05, 0.1]\naxis = [0, 1, 0]\n" +
                                short_run + "[output.signals]\nx = \"bar.ux\"\nz = \"bar.uz\"\n");
    EXPECT_NEAR(motion.signal("x").max, 0., 1e-9) << type;
    EXPECT_NEAR(motion.signal("z").min, 0., 1e-9) << type;
  }
}

// Two bodies that turn about different axes, welded: neither turns.
TEST(JointsAcrossPlanes, AWeldHoldsBothAxes)
{
  const Kind     centred{"centred",
                     "type = \"planar\"\nnormal = [0, 0, 1]\nmass = 2\ninertia = 0.1\nposition = [0, 0, 0]\n"};
  const SceneRun motion =
      run(body("a", kinds[1]) + body("b", centred) + joint("j", "rigid", "a", "b", "[0, 0, 0]") +
          element("torque", "force", {{"from", "a"}, {"about", "[0, 1, 0]"}, {"constant", "5 N m"}}) + short_run +
          "signals = { phi = \"a.angle\" }\n");
  EXPECT_NEAR(motion.signal("phi").max, 0., 1e-9);
}

} // namespace
} // namespace gestell::tests
