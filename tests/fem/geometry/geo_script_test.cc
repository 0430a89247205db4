// Scripts of gmsh are programs: what they may do without trust.

#include "fem/geometry/geo_script.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace
{

/// "7: why", or nothing.
std::string judgement(const std::string &script)
{
  const RefuseLine refuse = [](int line, const std::string &what)
  { throw std::invalid_argument(std::to_string(line) + ": " + what); };
  return gestell::tests::refusal([&] { judge_geo(geo_tokens(script, refuse), refuse); });
}

std::string text_as_judged(const std::string &script)
{
  return geo_text(geo_tokens(script, [](int, const std::string &what) { throw std::invalid_argument(what); }));
}

const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n";

using Harmful = ::testing::TestWithParam<const char *>;

TEST_P(Harmful, LineOfAScriptIsRefusedByItsNumber)
{
  EXPECT_THAT(judgement("a = 1; /* one\n two */\n" + std::string(GetParam())), ::testing::StartsWith("3: "));
}

INSTANTIATE_TEST_SUITE_P(
    OfGmsh, Harmful,
    ::testing::Values("SystemCall \"true\";", "NonBlockingSystemCall Str(\"true\");", "If (0) System \"true\"; EndIf",
                      "OnelabRun(\"a\", \"b\");", "Plugin(Triangulate).Run;", "Save \"a.msh\";", "Print \"a.png\";",
                      "CreateDir \"a\";", "Printf(\"a\") > \"b\";", "Printf(\"%g\", 1) >> \"b\";", "Exit;",
                      "Merge Str(\"a.step\");", "Include StrCat(\"a\", \"b\");", "ShapeFromFile(s);",
                      "x() = ListFromFile(\"a\");", "s = GetEnv(\"HOME\");", "StringToName[\"Save\"] \"a\";",
                      "S2N(\"Save\") = 1;", "General.LogFileName = \"a\";", "General.TextEditor = \"a\";",
                      "Solver.Executable0 = \"a\";", "Solver[0].Name = \"a\";", "PostProcessing.Format = 1;",
                      "View[0].Name = \"a\";", "Geometry.DoubleClickedPointCommand = \"a\";",
                      "Field[1] = ExternalProcess;", "Field[1] = Structured;", "Command \"a\";", "Command 3;",
                      "Command other;", "command();", "Sleep 10;", "Printf(\"%n\", 1);", "Printf(\"%s\", 1);",
                      "x = \"a EndIf b\";", "EnEndIf = 1;", "x = \"two\nlines\";", "x = 1 @ 2;", "x = {1, 2;",
                      "Delete Empty Views;"));

using Harmless = ::testing::TestWithParam<const char *>;

TEST_P(Harmless, LineOfAScriptPasses)
{
  EXPECT_EQ(judgement(GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(
    OfGmsh, Harmless,
    ::testing::Values(
        "// Save \"a\"; in words", "/* SystemCall\n \"a\"; */ x = 1;",
        "DefineConstant[ d = {0.1, Name \"a/b\", Min 0} ];", "Mesh.MeshSizeMax = 0.1; Mesh 3;",
        "Geometry.OCCAutoFix = 0; General.Terminal = 0;", "Physical Surface(\"feet\") = {1, 2};",
        "Field[1] = Box; Field[1].VIn = h; Background Field = 1;", "Transfinite Curve {1} = 10 Using Progression 1.1;",
        "Transfinite Surface {1} = {1, 2, 3, 4} Left;", "For i In {0 : #a() - 1}\n x += a(i);\nEndFor",
        "Macro Plate\n v = newv;\nReturn\nCall Plate;", "If (a == 1) b = 2; ElseIf (a > 2) b = 3; Else b = 4; EndIf",
        "Printf(\"%.3g of %g\", a, b);", "out() = Extrude {0, 0, 1} { Surface{1}; Layers{3}; Recombine; };",
        "Mesh.Algorithm3D = 10; SetOrder 2;", "v() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };",
        "Merge \"a.step\";", "s() = Boundary{ Volume{1}; }; p() = PointsOf{ Volume{1}; };",
        "MeshSize{ PointsOf{ Volume{1}; } } = 0.1;", "OptimizeMesh \"Netgen\";",
        "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};", "Color Red { Volume{1}; }"));

TEST(GeoText, HasTheTokensInTheirLinesAndNoComments)
{
  EXPECT_EQ(text_as_judged("a=1; // one\n/* Save\n \"x\"; */ b() += {a, 2e-3, .5}; s = 'say \"so\"';"),
            "a = 1 ; \n\nb ( ) += { a , 2e-3 , .5 } ; s = 'say \"so\"' ; \n");
}

TEST(GeoScript, WithCommentsMacrosAndLoopsDrawsTheSameAsWhenItIsTrusted)
{
  const std::string script =
      "// drawn\nSetFactory(\"OpenCASCADE\"); n = 0;\nMacro Cube /* of one */\n"
      "  Box(newv) = {3 * n, 0, 0, 1, 1, 1}; n += 1;\nReturn\n"
      "For i In {1 : 2}\n  If (i == 1) /* first\n */ Call Cube;\n  Else\n    Call Cube;\n  EndIf\n"
      "EndFor\n";
  FrameSpecification s = specification(write_text("cubes.geo", script), 1.);
  s.mesh.bodies        = 2;
  const double judged  = report_geometry(s).volume;
  s.scripts            = Scripts::trusted;
  EXPECT_EQ(judged, report_geometry(s).volume);
  EXPECT_NEAR(judged, 2., 1e-12);
}

/// Scenes of others; "DID" stands for a file that no one may make.
class OthersScript : public ::testing::Test
{
protected:
  OthersScript() { std::filesystem::remove(did_); }

  std::string write(const std::string &name, std::string text) const
  {
    for (std::size_t at = text.find("DID"); at != std::string::npos; at = text.find("DID"))
      text.replace(at, 3, did_);
    std::filesystem::create_directories(std::filesystem::path(folder() + "/" + name).parent_path());
    return write_text(name, text);
  }

  /// What is said of it; nothing was run.
  std::string told_of(const std::string &cad) const
  {
    const std::string reported = refusal(specification(cad, 1.));
    EXPECT_FALSE(std::filesystem::exists(did_)) << cad;
    return reported;
  }

  const std::string did_ = folder() + "/did";
};

TEST_F(OthersScript, IsRefusedWithItsLineAndRunsWhenItIsTrusted)
{
  FrameSpecification s = specification(write("evil.geo", box + "SystemCall \"touch DID\";\n"), 1.);
  EXPECT_THAT(told_of(s.cad), AllOf(HasSubstr("evil.geo:3: SystemCall runs a program"), HasSubstr("--trust-scripts")));
  EXPECT_THROW(inspect_geometry(s), std::invalid_argument); // gestell check
  EXPECT_FALSE(std::filesystem::exists(did_));
  s.scripts = Scripts::trusted;
  EXPECT_EQ(refusal(s), "");
  EXPECT_TRUE(std::filesystem::exists(did_));
}

TEST_F(OthersScript, CannotHideInACommentThatAMacroJumpsInto)
{
  EXPECT_EQ(told_of(write("macro.geo", box + "Macro Hidden /*\nSystemCall \"touch DID\"; */\nReturn\nCall Hidden;\n")),
            "");
}

TEST_F(OthersScript, CannotCallItselfAMesh)
{
  EXPECT_THAT(told_of(write("mesh.msh", box + "SystemCall \"touch DID\";\n")), HasSubstr("is not a gmsh mesh"));
}

TEST_F(OthersScript, CannotCallItselfAStepFileInAnotherSpelling)
{
  EXPECT_NE(
      told_of(write("frame.Step", "// ISO-10303-21;\n" + box + "SystemCall \"touch DID\";\n// END-ISO-10303-21;\n")),
      "");
}

TEST_F(OthersScript, CannotBeTheOptionsOfAFile)
{
  const std::string cad = draw("cube.step", [] { gmsh::model::occ::addBox(0., 0., 0., 1000., 1000., 1000.); });
  write("cube.step.opt", "SystemCall \"touch DID\";\n");
  EXPECT_EQ(told_of(cad), "");
}

TEST_F(OthersScript, ReadsFilesBelowItsOwnFolderWhichAreJudgedToo)
{
  draw("cube.step", [] { gmsh::model::occ::addBox(0., 0., 0., 1000., 1000., 1000.); });
  write("parts/sizes.inc", "side = 2;\n");
  const std::string factory = "SetFactory(\"OpenCASCADE\");\nGeometry.OCCTargetUnit = \"M\";\n";
  EXPECT_EQ(told_of(write("good.geo", factory + "Include \"parts/sizes.inc\";\nMerge \"cube.step\";\n"
                                                "Box(2) = {3, 0, 0, side, 1, 1};\nCoherence;\nDelete{ Volume{1}; }\n")),
            "");
  write("parts/evil.inc", "x = 1;\nSave \"DID\";\n");
  EXPECT_THAT(told_of(write("includes.geo", box + "Include \"parts/evil.inc\";")),
              HasSubstr("evil.inc:2: Save writes"));
  write("parts/evil.msh", "SystemCall \"touch DID\";\n");
  EXPECT_THAT(told_of(write("merges.geo", box + "Merge \"parts/evil.msh\";")), HasSubstr("is not a gmsh mesh"));
  EXPECT_THAT(told_of(write("parts/out.geo", box + "Merge \"../cube.step\";")),
              AllOf(HasSubstr("out.geo:3: reads \"../cube.step\""), HasSubstr("not in the folder")));
  EXPECT_THAT(told_of(write("lost.geo", box + "Include \"none.geo\";")), HasSubstr("there is no such file"));
}

TEST_F(OthersScript, ThatGmshCannotReadIsNamedByItsOwnPath)
{
  const std::string cad = write("wrong.geo", "SetFactory(\"OpenCASCADE\");\n\nBox(1) = {0, 0, 0, 1, 1};\n");
  EXPECT_THAT(told_of(cad), HasSubstr(cad + "', line 3"));
}

} // namespace
