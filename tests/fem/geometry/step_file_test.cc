// STEP files that are damaged though they end as they should, and the names, colours and layers of their faces.

#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_LayerTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace
{

std::string text_of_cubes(double x)
{
  return read_text(draw("cubes.step",
                        [x]
                        {
                          gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.);
                          if (x > 0.)
                            gmsh::model::occ::addBox(x, 0., 0., 100., 100., 100.);
                        }));
}

/// The text with the first `from` after `after` replaced.
std::string with(std::string text, const std::string &from, const std::string &to, const std::string &after = "")
{
  const auto at = text.find(from, text.find(after));
  if (at == std::string::npos)
    throw std::logic_error("the sample has no " + from);
  return text.replace(at, from.size(), to);
}

/// Without the first face of its first shell.
std::string opened(const std::string &text)
{
  const std::string shell = "CLOSED_SHELL('',(";
  const auto        from  = text.find(shell) + shell.size();
  return std::string(text).erase(from, text.find(',', from) + 1 - from);
}

std::string step_refusal(const std::string &text)
{
  return refusal(specification(write_text("damaged.step", text), 0.05));
}

TEST(StepFile, ThatLostEntitiesIsRefusedThoughItEndsAsItShould)
{
  std::string text = text_of_cubes(0.);
  const auto  cut  = text.find("\n#", text.size() / 2);
  text             = text.substr(0, cut) + "\nENDSEC;\nEND-ISO-10303-21;\n";
  EXPECT_THAT(step_refusal(text), AllOf(StartsWith("scene.toml:3: frame"), HasSubstr("is damaged, although its end"),
                                        HasSubstr("entities that are not in the file")));
}

TEST(StepFile, ThatLostItsUnitIsRefused)
{
  EXPECT_THAT(step_refusal(with(text_of_cubes(0.), "LENGTH_UNIT() ", "")),
              AllOf(HasSubstr("has no unit of length"), HasSubstr("millimetres or metres")));
}

// OpenCASCADE computes with it and does not come to an end.
TEST(StepFile, WithANumberThatIsNoneIsRefusedWithItsEntity)
{
  for (const std::string none : {"NaN", "-nan(ind)", "inf", "-INF", "1.#QNAN"})
    EXPECT_THAT(step_refusal(with(text_of_cubes(0.), "(0.,0.,0.)", "(0.," + none + ",0.)", "CARTESIAN_POINT")),
                AllOf(HasSubstr("entity #"), HasSubstr("in place of a number")))
        << none;
}

TEST(StepFile, WithReferencesInTextAndCommentsIsWhole)
{
  const std::string text = text_of_cubes(0.);
  EXPECT_EQ(step_refusal(with(text, "'Open CASCADE Model'", "'it''s #99999 here'")), "");
  EXPECT_EQ(step_refusal(with(text, "DATA;", "DATA;\n/* #88888 = not an entity */")), "");
}

TEST(StepFile, WithAnOpenShellIsRefusedWithTheEdgesThatAreOpen)
{
  EXPECT_THAT(step_refusal(opened(text_of_cubes(0.))),
              AllOf(HasSubstr("no closed solid, only 5 faces"), HasSubstr("open at 4 edges"), HasSubstr("sew")));
  EXPECT_THAT(step_refusal(opened(text_of_cubes(100.))),
              AllOf(HasSubstr("contains 2 solids, but only 1 are closed"), HasSubstr("5 faces that bound no solid"),
                    HasSubstr("open at 4 edges")));
}

TEST(FaceNames, OfAStepFileAreGroupsThatSelectorsFindAlsoAfterJoining)
{
  std::string       text = text_of_cubes(100.);
  const std::string face = "ADVANCED_FACE(''";
  text                   = with(text, face, "ADVANCED_FACE('left end'");
  text                   = with(text, face, "ADVANCED_FACE('NONE'");
  FrameSpecification s   = specification(write_text("named.step", text), 0.05);
  s.surfaces["end"]      = group("left end");

  const GeometryReport report = report_geometry(s);
  ASSERT_EQ(report.surfaces.at("end").size(), 1u);
  int n_named = 0;
  for (const Face &outer : report.faces)
  {
    n_named += !outer.name.empty();
    if (outer.tag == report.surfaces.at("end")[0])
    {
      EXPECT_NEAR(outer.max[0], 0., 1e-6); // OpenCASCADE writes the face at x = 0 first
    }
  }
  EXPECT_EQ(n_named, 1); // faces without a name are not called like their solid
  s.surfaces["end"] = group("right end");
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("group \"right end\""), HasSubstr("left end")));
}

TEST(ColoursAndLayers, OfFacesAreGroupsThatSelectorsFind)
{
  const std::string path = folder() + "/styled.step";
  {
    Handle(TDocStd_Document) document;
    const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
    application->NewDocument("MDTV-XCAF", document);
    const auto         shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
    const TopoDS_Shape box    = BRepPrimAPI_MakeBox(100., 200., 300.).Shape();
    const TDF_Label    part   = shapes->AddShape(box, false);
    TopExp_Explorer    face(box, TopAbs_FACE);
    XCAFDoc_DocumentTool::ColorTool(document->Main())
        ->SetColor(shapes->AddSubShape(part, face.Current()), Quantity_Color(1., 0., 0., Quantity_TOC_sRGB),
                   XCAFDoc_ColorSurf);
    face.Next();
    XCAFDoc_DocumentTool::LayerTool(document->Main())->SetLayer(shapes->AddSubShape(part, face.Current()), "feet");
    STEPCAFControl_Writer writer;
    writer.SetColorMode(true);
    writer.SetLayerMode(true);
    Interface_Static::SetCVal("xstep.cascade.unit", "MM");
    writer.Transfer(document, STEPControl_AsIs);
    ASSERT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
    application->Close(document);
  }
  FrameSpecification s        = specification(path, 0.1);
  s.surfaces["red"]           = group("#ff0000");
  s.surfaces["feet"]          = group("feet");
  const GeometryReport report = report_geometry(s);
  const auto           centre = [&](const std::string &name)
  {
    const int tag = report.surfaces.at(name).at(0);
    return std::find_if(report.faces.begin(), report.faces.end(), [&](const Face &f) { return f.tag == tag; })->centre;
  };
  EXPECT_NEAR(centre("red")[0], 0., 1e-9); // the faces of a box come as x = 0, x = 100 mm, ...
  EXPECT_NEAR(centre("feet")[0], 0.1, 1e-9);
  s.surfaces["red"] = group("#00ff00");
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("\"#ff0000\""), HasSubstr("\"feet\"")));
}

} // namespace
