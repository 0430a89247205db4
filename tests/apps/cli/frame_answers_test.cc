// What the program says of frames: free ones, the range of the model, what is fact and what is a warning.

#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

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
    EXPECT_FALSE(answer.says("assembled when the frame is created")) << answer.text;
  }
  const Answer open =
      gestell("check " + scene("portal_slider_crank.toml") + " --set parameters.l='\"60 mm\"'"); // below r
  expect_answer(open, 2, {"has a gap of"});
}

/// A block of 0.2 x 0.1 x 1 m with a mass of 8 kg on a spring above.
std::string block(const std::string &more)
{
  return "name = 'block'\ngravity = [0, 0, '-9.81 m/s^2']\n" +
         cad_frame("block.geo", "0.1 m", {{"damping", "{ ratio = 0.02 }"}}) +
         plane_surface("foot", "[0, 0, -1]", "[0, 0, 0]") + plane_surface("top", "[0, 0, 1]", "[0, 0, 1]") +
         table("frame.interface.top", {{"surface", "top"}, {"coupling", "rigid"}}) +
         slider_body("load", "8 kg", "[0, 0, 1]", {{"guide", "frame.top"}}) +
         element("spring", "spring-damper",
                 {{"from", "load"}, {"to", "frame.top"}, {"stiffness", "500 N/mm"}, {"damping", "50 N s/m"}}) +
         steps("0.5 ms", "5 ms") + signals("z = 'load.displacement'") + more;
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

TEST_F(FrameAnswers, RigidBodyModesHaveNoFrequencyAndAreNamed)
{
  const Answer answer = ask("modes", block(""));
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "   rigid-body mode\n"), 6) << answer.text;
  EXPECT_EQ(count(answer.text, "   rigid-body mode: no stiffness\n"), 6) << answer.text;
  EXPECT_FALSE(answer.says("unstable")) << answer.text;
}

/// The top is 0.2 x 0.1 m; up to half of that beside it is taken, and more along the way of a guide.
TEST_F(FrameAnswers, JointsFarFromTheFacesOfTheirInterfaceGiveAWarning)
{
  const auto pendulum = [](const std::string &type, const std::string &at, const Keys &more = {})
  {
    return block(support + planar_body("bob", "2 kg", "0.1 kg m^2", at) +
                 joint("pin", type, "frame.top", "bob", at, more));
  };
  const std::string far = "joint \"pin\": its point on \"frame.top\" is ";
  for (const auto &[scene, lies] :
       {std::pair(pendulum("revolute", "[0.1, 0.05, 2.4]"), "1.4 m outside the faces of this interface, which are "
                                                            "0.1 m across"),
        std::pair(pendulum("revolute", "[0.302, 0.05, 1]"), "0.102 m outside"),
        std::pair(pendulum("prismatic", "[0.302, 0.05, 1]", {{"axis", "[0, 0, 1]"}}), "0.102 m outside")})
    for (const std::string command : {"check", "modes"})
    {
      const Answer answer = ask(command, scene);
      EXPECT_EQ(answer.exit_code, 0) << answer.text;
      EXPECT_EQ(count(answer.text, far + lies), 1) << command << '\n' << answer.text;
    }
  for (const std::string &near : {pendulum("revolute", "[0.1, 0.05, 1.04]"), pendulum("revolute", "[0.298, 0.05, 1]"),
                                  pendulum("prismatic", "[0.1, 0.05, 2.4]", {{"axis", "[0, 0, 1]"}})})
    EXPECT_FALSE(ask("check", near).says("outside the faces"));
}

/// Also its own node; what an interface guides may be anywhere along its way.
TEST_F(FrameAnswers, NodesFarFromTheFacesOfTheirInterfaceGiveAWarning)
{
  const auto at = [](const std::string &position)
  {
    const std::string key  = "[frame.interface.top]\n";
    std::string       text = block(support);
    return text.insert(text.find(key) + key.size(), "position = " + position + "\n");
  };
  for (const std::string command : {"check", "modes", "reduce"})
  {
    const Answer answer = ask(command, at("[0.32, 0.05, 1]"));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_EQ(count(answer.text, "frame.interface.top.position: the node is 0.12 m outside the faces"), 1)
        << command << '\n'
        << answer.text;
  }
  EXPECT_FALSE(ask("check", at("[0.1, 0.05, 1.4]")).says("outside the faces"));
}

/// Of a text, the line that has a part.
std::string line_with(const std::string &part, const std::string &text)
{
  const std::size_t at = text.find(part), begin = text.rfind('\n', at);
  return at == std::string::npos ? "" : text.substr(begin + 1, text.find('\n', at) - begin - 1);
}

std::string spring(const std::string &name, const std::string &at, const std::string &direction)
{
  return element(name, "spring-damper",
                 {{"from", "frame." + at}, {"to", "ground"}, {"direction", direction}, {"stiffness", "1 kN/mm"}});
}

std::string directions(const std::string &list)
{
  return support + "directions = " + list + "\n";
}

std::string foundation(const std::string &values)
{
  return "[frame.support.foot]\nsurface = \"foot\"\nfoundation = { " + values + " }\n";
}

TEST_F(FrameAnswers, CheckReportsAFrameThatFallsInTheLineOfRun)
{
  const std::string nothing = "no support constrains the frame as a whole";
  const Answer      checked = ask("check", block("")), run = ask("run", block(""));
  for (const Answer &falls : {checked, run})
  {
    EXPECT_EQ(falls.exit_code, 0) << falls.text;
    EXPECT_EQ(count(falls.text, "scene.toml:3: frame: " + nothing + " at the start, so that it falls"), 1)
        << falls.text;
  }
  EXPECT_EQ(line_with(nothing, checked.text), line_with(nothing, run.text));
  for (const std::string command : {"check", "run"})
    EXPECT_TRUE(ask(command, block(spring("z", "top", "[0, 0, 1]"))).says(nothing)); // five ways are left
  EXPECT_FALSE(ask("run", block(support)).says("no support constrains"));
  for (const std::string &holds : {support, foundation("stiffness = \"1 kN/mm\"")})
  {
    const Answer held = ask("check", block(holds));
    EXPECT_EQ(held.exit_code, 0) << held.text;
    EXPECT_FALSE(held.says("warning")) << held.text;
  }
}

TEST_F(FrameAnswers, CheckReportsSupportsThatLeaveADirectionFree)
{
  const std::string nothing = "no support constrains the frame as a whole";
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

/// A chain of masses on springs, on the ground by what the stiffness of the lowest is above 1e6.
std::string chain(const std::string &lowest, const std::string &more = "")
{
  return mass_chain(lowest) + steps("1 ms", "0.1 s") + signals("x = 'frame.top.uz'") + more;
}

TEST_F(FrameAnswers, CheckReportsFramesFromMatricesThatFall)
{
  const std::string nothing = "no support constrains the frame as a whole", reduced = "[reduction]\nmodes = 1\n";
  for (const std::string &more : {std::string(), reduced})
  {
    EXPECT_EQ(count(ask("check", chain("1e6", more)).text, nothing), 1) << more;
    EXPECT_EQ(count(ask("run", chain("1e6", more)).text, nothing), 1) << more;
    const Answer at_rest = ask("check", chain("2e6", more)),
                 hangs   = ask("check", chain("1e6", more + spring("z", "top", "[0, 0, 1]")));
    EXPECT_TRUE(at_rest.exit_code == 0 && !at_rest.says(nothing)) << more << at_rest.text;
    EXPECT_TRUE(hangs.exit_code == 0 && !hangs.says(nothing)) << more << hangs.text;
  }
}

TEST_F(FrameAnswers, WhatWasCheckedAndIsInOrderIsNotAWarning)
{
  std::string scene = block(support);
  scene.replace(scene.find("0.1 m"), 5, "0.05 m");
  const Answer answer = ask("modes", scene + "[reduction]\nmodes = 20\n");
  expect_answer(answer, 0, {"frame: modes: the inertia of C - omega^2 M at ", "frame: mesh: "});
  EXPECT_FALSE(answer.says("warning")) << answer.text;
  EXPECT_EQ(read(folder_.results() / "report.html").find("class=\"warnings\""), std::string::npos);
}

TEST_F(FrameAnswers, ModesAboveTheRangeOfTheModelAreBelowALineThatSaysSo)
{
  const Answer answer = ask("modes", block(support + "[reduction]\nfrequency = \"200 Hz\"\n"));
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_EQ(count(answer.text, "  above 200 Hz, the frequency limit of the reduced frame"), 2) << answer.text;
  EXPECT_EQ(count(read(folder_.results() / "report.html"), "above 200 Hz, the frequency limit of the reduced frame"),
            2);
  EXPECT_NE(read(folder_.results() / "summary.json").find("\"frequency_limit_hz\": 200"), std::string::npos);
}

TEST_F(FrameAnswers, CheckReadsTheGeometryAndFindsItsSurfaces)
{
  expect_answer(
      ask("check", block(support)), 0,
      {"1 solid, 0.02 m^3; surfaces: foot 1 face, top 1 face; not meshed", "is valid: 1 body, 1 element, 1 signal\n"});

  expect_answer(ask("check", block(support + "[frame.mass.motor]\non = \"top\"\nmass = 80\ninertia = [1, 1, 3]\n")), 2,
                {"frame.mass.motor: mass \"motor\": its principal moments of inertia"});
  const Answer pushed =
      ask("check", block(support + "[element.push]\ntype = \"force\"\nfrom = \"load\"\nconstant = \"5 N\"\n"));
  EXPECT_TRUE(pushed.says("1 body, 2 elements, 1 signal\n")) << "a force is an element, too: " << pushed.text;

  std::string scene = block(support);
  scene.replace(scene.find("through = [0, 0, 1]"), 19, "through = [0, 0, 2]");
  expect_answer(ask("check", scene), 2, {"frame.surface.top: no face matches"});

  scene = block(support);
  scene.replace(scene.find("block.geo"), 9, "block.step");
  folder_.file("block.step", "ISO-10303-21;\nHEADER;\n");
  expect_answer(ask("check", scene), 2, {"block.step"});
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
    expect_answer(answer, 2, {"other.geo:3: SystemCall runs a program"});
    EXPECT_FALSE(std::filesystem::exists(did));
  }
  const Answer trusted = ask("check", scene, " --trust-scripts");
  EXPECT_EQ(trusted.exit_code, 0) << trusted.text;
  EXPECT_TRUE(std::filesystem::exists(did));
}

TEST_F(FrameAnswers, AStudyGoesOnWithoutTheRunsWhoseDrawingKillsItsReader)
{
  expect_answer(gestell("new frame '" + (folder_ / "table.toml").string() + "'"), 0, {"written: "});
  const std::string study = folder_.file(
      "s.toml", "[scene]\nfile = 'table.toml'\nset = { 'run.end' = '2 ms', 'frame.mesh.size' = '200 mm' }\n"
                "[variables.drawing]\nkey = 'frame.cad'\nlevels = ['table.geo', '" GESTELL_SOURCE_DIR
                "/tests/fuzz/mesh/found/segmentation_fault.step']\n"
                "[outputs]\nu = 'signals.u_z.min'\n[design]\ntype = 'full factorial'\n");
  expect_answer(gestell("study " + study + folder_.option()), 0, {"2 runs made, 1 failed"});
  const std::string rows = read(folder_.results() / "runs.csv");
  EXPECT_EQ(count(rows, ",done,"), 1) << rows;
  EXPECT_EQ(count(rows, "gmsh was ended by signal") + count(rows, "holds no closed solid"),
            1) // OpenCASCADE 7.8 survives
      << rows;
  std::ofstream(folder_ / "table.geo", std::ios::app)
      << "// edited\n"; // rows of two drawings would stand under one name
  expect_answer(gestell("study " + study + folder_.option() + "--resume"), 2, {"table.geo", "changed"});
}

TEST_F(FrameAnswers, AnInterruptionBeforeTheRunLeavesNothing)
{
  const std::filesystem::path temporary = folder_ / "temporary";
  std::filesystem::create_directory(temporary);
  const std::string scene = folder_.file("scene.toml", block(support));
  folder_.file("block.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.2, 0.1, 1};\n");
  for (const char *seconds : {"0.2", "0.4", "0.6", "0.8"})
  {
    const Answer cut =
        shell("(TMPDIR='" + temporary.string() + "' GESTELL_CACHE='" + (folder_ / "cache").string() +
              "' timeout --signal INT --kill-after 10 " + seconds + " '" GESTELL_BINARY_DIR "/bin/gestell' run " +
              scene + folder_.option() + " --set frame.mesh.size='\"12 mm\"')"); // some seconds
    EXPECT_EQ(cut.exit_code, 124) << "137 where it did not heed the signal within ten seconds: " << cut.text;
    EXPECT_TRUE(std::filesystem::is_empty(temporary)) << seconds;
    EXPECT_FALSE(std::filesystem::exists(folder_.results())) << seconds;
  }
}

TEST_F(FrameAnswers, AConvergenceKeepsTheRowsOfItsMeshes)
{
  const Answer answer = ask("modes", block(support), " --converge 1e-4 --max-coordinates 6000");
  EXPECT_EQ(answer.exit_code, 3) << answer.text;
  EXPECT_GE(count(read(folder_.results() / "mesh_convergence.csv"), "\n"), 3);
}

TEST_F(FrameAnswers, AStaticInitialStateOfAFreeFrameNamesTheFrameAndWhatHelps)
{
  const Answer answer = ask("run", block(rest));
  EXPECT_EQ(answer.exit_code, 2);
  for (const char *part :
       {"the frame moves as a rigid body", "translation along x, translation along y, translation along z",
        "rotation about z", "[frame.support.NAME]", "inertia_relief = true"})
    EXPECT_TRUE(answer.says(part)) << part << "\n" << answer.text;
  const Answer floats = ask("run", block(rest + "inertia_relief = true\n"));
  EXPECT_EQ(floats.exit_code, 0) << floats.text;
}

TEST_F(FrameAnswers, AStaticInitialStateOfABodyThatFallsNamesTheBody)
{
  std::string scene = block(support + rest);
  scene.replace(scene.find("500 N/mm"), 8, "0 N/mm");
  expect_answer(ask("run", scene), 2, {"the motion of load has neither stiffness nor weight"});
}

} // namespace
} // namespace gestell::tests
