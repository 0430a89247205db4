// What the program says of frames: free ones, the range of the model, what is fact and what is a warning.

#include "tests/support/program.h"

#include <gtest/gtest.h>

#include <sstream>

namespace gestell::tests
{
namespace
{

// The crank turns about the middle of its bearing, which the CAD file tells.
TEST(Portal, ClosesAtEveryAngleWhereItsInterfacesAre)
{
  for (int k = 0; k < 8; ++k)
  {
    const Answer answer = gestell("check " + scene("portal_slider_crank.toml") + " --set start.q.crank='\"" +
                                  std::to_string(45 * k) + " deg\"'");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_FALSE(answer.says("warning")) << answer.text;
    EXPECT_FALSE(answer.says("closed when the frame is made")) << answer.text;
  }
  const Answer open =
      gestell("check " + scene("portal_slider_crank.toml") + " --set parameters.l='\"60 mm\"'"); // below r
  EXPECT_EQ(open.exit_code, 2) << open.text;
  EXPECT_TRUE(open.says("stays open")) << open.text;
}

/// A block of 0.2 x 0.1 x 1 m with a mass of 8 kg on a spring above.
std::string block(const std::string &more)
{
  return R"(name = "block"
gravity = [0, 0, "-9.81 m/s^2"]
[frame]
cad      = "block.geo"
unit     = "1 m"
mesh     = { size = "0.1 m" }
material = "steel"
damping  = { ratio = 0.02 }
[frame.surface.foot]
plane = { normal = [0, 0, -1], through = [0, 0, 0] }
[frame.surface.top]
plane = { normal = [0, 0, 1], through = [0, 0, 1] }
[frame.interface.top]
surface  = "top"
coupling = "rigid"
[body.load]
type  = "slider"
axis  = [0, 0, 1]
mass  = "8 kg"
guide = "frame.top"
[element.spring]
type      = "spring-damper"
from      = "load"
to        = "frame.top"
stiffness = "500 N/mm"
damping   = "50 N s/m"
[run]
step = "0.5 ms"
end  = "5 ms"
[output.signals]
z = "load.displacement"
)" + more;
}

const std::string support = "[frame.support.foot]\nsurface = \"foot\"\nclamped = true\n";
const std::string rest    = "[start]\nrule = \"static\"\n";

class FrameAnswers : public ::testing::Test
{
protected:
  Answer ask(const std::string &command, const std::string &scene, const std::string &more = "")
  {
    folder_.file("block.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.2, 0.1, 1};\n");
    return gestell(command + " " + folder_.file("scene.toml", scene) + (command == "check" ? "" : folder_.option()) +
                   more);
  }

  Folder folder_{"frame_answers"};
};

int count(const std::string &text, const std::string &part)
{
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

TEST_F(FrameAnswers, FreeMotionsHaveNoFrequencyAndAreNamed)
{
  const Answer answer = ask("modes", block(""));
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "   rigid motion\n"), 6) << answer.text;
  EXPECT_EQ(count(answer.text, "   free motion: nothing elastic holds it\n"), 6) << answer.text;
  EXPECT_FALSE(answer.says("unstable")) << answer.text;
}

TEST_F(FrameAnswers, AFrameThatNothingHoldsIsToldToFall)
{
  const Answer falls = ask("run", block(""));
  ASSERT_EQ(falls.exit_code, 0) << falls.text;
  EXPECT_EQ(count(falls.text, "scene.toml:3: frame: nothing holds the frame as a whole at the start, so that it falls"),
            1)
      << falls.text;
  const std::string springs = "[element.z]\ntype = \"spring-damper\"\nfrom = \"frame.top\"\nto = \"ground\"\n"
                              "direction = [0, 0, 1]\nstiffness = \"1 kN/mm\"\n";
  EXPECT_TRUE(ask("run", block(springs)).says("nothing holds the frame as a whole")); // five ways are left
  EXPECT_FALSE(ask("run", block(support)).says("nothing holds"));
}

/// Of a text, the line that has a part.
std::string line_with(const std::string &part, const std::string &text)
{
  const std::size_t at = text.find(part), begin = text.rfind('\n', at);
  return at == std::string::npos ? "" : text.substr(begin + 1, text.find('\n', at) - begin - 1);
}

std::string spring(const std::string &name, const std::string &at, const std::string &direction)
{
  return "[element." + name + "]\ntype = \"spring-damper\"\nfrom = \"frame." + at +
         "\"\nto = \"ground\"\ndirection = " + direction + "\nstiffness = \"1 kN/mm\"\n";
}

std::string directions(const std::string &list)
{
  return support + "directions = " + list + "\n";
}

std::string foundation(const std::string &values)
{
  return "[frame.support.foot]\nsurface = \"foot\"\nfoundation = { " + values + " }\n";
}

TEST_F(FrameAnswers, CheckTellsOfAFrameThatFallsInTheLineOfRun)
{
  const std::string nothing = "nothing holds the frame as a whole";
  const Answer      checked = ask("check", block(""));
  EXPECT_EQ(checked.exit_code, 0) << checked.text;
  EXPECT_EQ(count(checked.text, nothing), 1) << checked.text;
  EXPECT_EQ(line_with(nothing, checked.text), line_with(nothing, ask("run", block("")).text));

  EXPECT_TRUE(ask("check", block(spring("z", "top", "[0, 0, 1]"))).says(nothing)); // five ways are left
  for (const std::string &holds : {support, foundation("stiffness = \"1 kN/mm\"")})
  {
    const Answer held = ask("check", block(holds));
    EXPECT_EQ(held.exit_code, 0) << held.text;
    EXPECT_FALSE(held.says("warning")) << held.text;
  }
}

TEST_F(FrameAnswers, CheckTellsOfSupportsThatLeaveADirectionFree)
{
  const std::string nothing = "nothing holds the frame as a whole";
  for (const std::string &slips :
       {directions("[\"y\", \"z\"]"), foundation("stiffness = [0, \"1 kN/mm\", \"1 kN/mm\"]"),
        foundation("stiffness = [0, \"1 kN/mm\", \"1 kN/mm\"], damping = \"1 kN s/m\"")})
  {
    const std::string line = line_with(nothing, ask("check", block(slips)).text);
    EXPECT_NE(line.find("translation along x"), std::string::npos) << slips << line;
    EXPECT_EQ(line, line_with(nothing, ask("run", block(slips)).text));
    const Answer sprung = ask("check", block(slips + spring("x", "top", "[1, 0, 0]")));
    EXPECT_TRUE(sprung.exit_code == 0 && !sprung.says(nothing)) << slips << sprung.text;
  }
  EXPECT_TRUE(ask("check", block(foundation("damping = \"1 kN s/m\""))).says(nothing)); // nothing brings it back
}

/// Three masses on two springs in a row, on the ground by a third one; the topmost is an interface.
std::string chain(const std::string &lowest, const std::string &more = "")
{
  return R"(gravity = [0, 0, -9.81]
[frame]
mass         = [[100, 0, 0], [0, 100, 0], [0, 0, 100]]
stiffness    = [[)" +
         lowest + R"(, -1e6, 0], [-1e6, 2e6, -1e6], [0, -1e6, 1e6]]
translations = [[0, 0, 1], [0, 0, 1], [0, 0, 1]]
[frame.interface.top]
rows = { uz = 3 }
[run]
step = "1 ms"
end  = "0.1 s"
[output.signals]
x = "frame.top.uz"
)" + more;
}

TEST_F(FrameAnswers, CheckTellsOfFramesFromMatricesThatFall)
{
  const std::string nothing = "nothing holds the frame as a whole", reduced = "[reduction]\nmodes = 1\n";
  for (const std::string &more : {std::string(), reduced})
  {
    EXPECT_EQ(count(ask("check", chain("1e6", more)).text, nothing), 1) << more;
    EXPECT_EQ(count(ask("run", chain("1e6", more)).text, nothing), 1) << more;
    const Answer stands = ask("check", chain("2e6", more)),
                 hangs  = ask("check", chain("1e6", more + spring("z", "top", "[0, 0, 1]")));
    EXPECT_TRUE(stands.exit_code == 0 && !stands.says(nothing)) << more << stands.text;
    EXPECT_TRUE(hangs.exit_code == 0 && !hangs.says(nothing)) << more << hangs.text;
  }
}

TEST_F(FrameAnswers, WhatWasCheckedAndIsInOrderIsNoWarning)
{
  std::string scene = block(support);
  scene.replace(scene.find("0.1 m"), 5, "0.05 m");
  const Answer answer = ask("modes", scene + "[reduction]\nmodes = 20\n");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(answer.says("frame: modes: the inertia of C - omega^2 M at ")) << answer.text;
  EXPECT_TRUE(answer.says("frame: mesh: ")) << answer.text;
  EXPECT_FALSE(answer.says("warning")) << answer.text;
  EXPECT_EQ(read(folder_.results() / "report.html").find("class=\"warnings\""), std::string::npos);
}

TEST_F(FrameAnswers, ModesAboveTheRangeOfTheModelStandBelowALineThatSaysSo)
{
  const Answer answer = ask("modes", block(support + "[reduction]\nfrequency = \"200 Hz\"\n"));
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "  above 200 Hz the reduced frame is not made to hold"), 2) << answer.text;
  EXPECT_EQ(count(read(folder_.results() / "report.html"), "above 200 Hz the reduced frame is not made to hold"), 2);
  EXPECT_NE(read(folder_.results() / "summary.json").find("\"frequency_limit_hz\": 200"), std::string::npos);
}

TEST_F(FrameAnswers, CheckReadsTheGeometryAndFindsItsSurfaces)
{
  const Answer good = ask("check", block(support));
  EXPECT_EQ(good.exit_code, 0) << good.text;
  EXPECT_TRUE(good.says("1 solid, 0.02 m^3; surfaces: foot 1 face, top 1 face; not meshed")) << good.text;
  EXPECT_TRUE(good.says("well formed: 1 body, 1 element, 1 signal\n")) << good.text;

  const Answer flat =
      ask("check", block(support + "[frame.mass.motor]\non = \"top\"\nmass = 80\ninertia = [1, 1, 3]\n"));
  EXPECT_EQ(flat.exit_code, 2);
  EXPECT_TRUE(flat.says("frame.mass.motor: mass \"motor\": its principal moments of inertia")) << flat.text;
  const Answer pushed =
      ask("check", block(support + "[element.push]\ntype = \"force\"\nfrom = \"load\"\nconstant = \"5 N\"\n"));
  EXPECT_TRUE(pushed.says("1 body, 2 elements, 1 signal\n")) << "a force is an element, too: " << pushed.text;

  std::string scene = block(support);
  scene.replace(scene.find("through = [0, 0, 1]"), 19, "through = [0, 0, 2]");
  const Answer lost = ask("check", scene);
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_TRUE(lost.says("frame.surface.top: no face fits")) << lost.text;

  scene = block(support);
  scene.replace(scene.find("block.geo"), 9, "block.step");
  folder_.file("block.step", "ISO-10303-21;\nHEADER;\n");
  const Answer broken = ask("check", scene);
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_TRUE(broken.says("block.step")) << broken.text;
}

TEST_F(FrameAnswers, AScriptThatRunsProgramsIsRefusedUnlessItIsTrusted)
{
  const std::string did   = (folder_ / "did").string();
  std::string       scene = block(support);
  scene.replace(scene.find("block.geo"), 9, "other.geo");
  const std::string script =
      folder_.file("other.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.2, 0.1, 1};\n"
                                "SystemCall \"touch '" +
                                    did + "'\";\n");
  for (const Answer &answer : {ask("check", scene), ask("run", scene), gestell("mesh " + script)})
  {
    EXPECT_EQ(answer.exit_code, 2) << answer.text;
    EXPECT_TRUE(answer.says("other.geo:3: SystemCall runs a program")) << answer.text;
    EXPECT_FALSE(std::filesystem::exists(did));
  }
  const Answer trusted = ask("check", scene, " --trust-scripts");
  EXPECT_EQ(trusted.exit_code, 0) << trusted.text;
  EXPECT_TRUE(std::filesystem::exists(did));
}

TEST_F(FrameAnswers, AConvergenceKeepsTheRowsOfItsMeshes)
{
  const Answer answer = ask("modes", block(support), " --converge 1e-4 --max-coordinates 6000");
  EXPECT_EQ(answer.exit_code, 3) << answer.text;
  EXPECT_GE(count(read(folder_.results() / "mesh_convergence.csv"), "\n"), 3);
}

TEST_F(FrameAnswers, AStaticStartOfAFreeFrameNamesTheFrameAndWhatHelps)
{
  const Answer answer = ask("run", block(rest));
  EXPECT_EQ(answer.exit_code, 2);
  for (const char *part :
       {"the frame moves as a whole", "translation along x, translation along y, translation along z",
        "rotation about z", "[frame.support.NAME]", "inertia_relief = true"})
    EXPECT_TRUE(answer.says(part)) << part << "\n" << answer.text;
  const Answer floats = ask("run", block(rest + "inertia_relief = true\n"));
  EXPECT_EQ(floats.exit_code, 0) << floats.text;
}

TEST_F(FrameAnswers, AStaticStartOfABodyThatFallsNamesTheBody)
{
  std::string scene = block(support + rest);
  scene.replace(scene.find("500 N/mm"), 8, "0 N/mm");
  const Answer answer = ask("run", scene);
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(answer.says("the motion of load has neither stiffness nor weight")) << answer.text;
}

} // namespace
} // namespace gestell::tests
