// Materials and names of the parts of a STEP file, wherever an assembly places them, and open shells that are sewn.

#include "fem/assembly/cell_materials.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shell.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_MaterialTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <gp_Trsf.hxx>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

namespace
{

std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// "frame" of two instances of "plate", a cuboid of 100 mm with one named face, beside each other; of 2.7 g/cm^3.
std::string two_plates()
{
  const std::string path = folder() + "/two_plates.step";
  Handle(TDocStd_Document) document;
  const Handle(XCAFApp_Application) application = XCAFApp_Application::GetApplication();
  application->NewDocument("MDTV-XCAF", document);
  const auto         shapes    = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto         materials = XCAFDoc_DocumentTool::MaterialTool(document->Main());
  const TopoDS_Shape box       = BRepPrimAPI_MakeBox(100., 100., 100.).Shape();
  const TDF_Label    plate     = shapes->AddShape(box, false);
  const TDF_Label    frame     = shapes->NewShape();
  TDataStd_Name::Set(plate, "plate");
  TDataStd_Name::Set(frame, "frame");
  gp_Trsf beside;
  beside.SetTranslation(gp_Vec(100., 0., 0.));
  shapes->AddComponent(frame, plate, TopLoc_Location());
  shapes->AddComponent(frame, plate, TopLoc_Location(beside));
  shapes->UpdateAssemblies();
  const auto word = [](const char *text) { return new TCollection_HAsciiString(text); };
  materials->SetMaterial(plate, materials->AddMaterial(word("EN AW-6060"), word(""), 2.7, word("density measure"),
                                                       word("POSITIVE_RATIO_MEASURE")));
  STEPCAFControl_Writer writer;
  writer.SetNameMode(true);
  writer.SetMaterialMode(true);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  writer.Transfer(document, STEPControl_AsIs);
  EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  application->Close(document);
  return write_text("named.step", replaced(read_text(path), "ADVANCED_FACE(''", "ADVANCED_FACE('left end'"));
}

TEST(PartsOfAStepFile, HaveNamesAndMaterialsInEveryPlace)
{
  FrameSpecification s        = specification(two_plates(), 0.05);
  s.surfaces["end"]           = group("left end"); // the second one lies between the plates
  const GeometryReport report = report_geometry(s);
  ASSERT_EQ(report.solids.size(), 2u);
  for (const Solid &solid : report.solids)
  {
    EXPECT_EQ(solid.name, "plate");
    EXPECT_EQ(solid.material, "EN AW-6060");
    EXPECT_NEAR(solid.density, 2700., 1e-9);
  }
}

TEST(DensitiesOfAStepFile, AreReadInAnyUnit)
{
  const std::string text  = read_text(two_plates());
  const std::string grams = "( MASS_UNIT() NAMED_UNIT(*) SI_UNIT($,.GRAM.) )",
                    cm    = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) )";
  const auto density      = [&](const std::string &mass, const std::string &length, const std::string &value)
  {
    std::string other = replaced(text, grams, "( MASS_UNIT() NAMED_UNIT(*) SI_UNIT(" + mass + ",.GRAM.) )");
    other             = replaced(other, cm, "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(" + length + ",.METRE.) )");
    other             = replaced(other, "MEASURE(2.7)", "MEASURE(" + value + ")");
    return inspect_geometry(specification(write_text("other.step", other), 0.05)).solids.at(0).density;
  };
  EXPECT_NEAR(density(".KILO.", "$", "2700."), 2700., 1e-9);
  EXPECT_NEAR(density(".KILO.", ".MILLI.", "2.7E-06"), 2700., 1e-9);
  EXPECT_NEAR(density("$", ".MILLI.", "0.0027"), 2700., 1e-9);
  EXPECT_EQ(density("$", ".CENTI.", "-1."), 0.);

  const auto pounds = [&](const std::string &measure, double value)
  {
    std::string other =
        replaced(text, grams, "( CONVERSION_BASED_UNIT('POUND',#90001) MASS_UNIT() NAMED_UNIT(#90000) )");
    other = replaced(other, "MEASURE(2.7)", "MEASURE(" + std::to_string(value) + ")");
    other = replaced(other, "ENDSEC;\nEND-ISO",
                     "#90000 = DIMENSIONAL_EXPONENTS(0.,1.,0.,0.,0.,0.,0.);\n" + measure + "\nENDSEC;\nEND-ISO");
    return inspect_geometry(specification(write_text("pounds.step", other), 0.05)).solids.at(0).density;
  };
  EXPECT_NEAR(pounds("#90001 = MASS_MEASURE_WITH_UNIT(MASS_MEASURE(453.59237),#90002);\n"
                     "#90002 = ( MASS_UNIT() NAMED_UNIT(*) SI_UNIT($,.GRAM.) );",
                     0.01),
              4535.9237, 1e-6);
}

// A unit that is a multiple of itself has no size.
TEST(DensitiesOfAStepFile, InAUnitOfItselfAreIgnored)
{
  std::string       text  = read_text(two_plates());
  const std::string grams = "( MASS_UNIT() NAMED_UNIT(*) SI_UNIT($,.GRAM.) )";
  const auto        at = text.find(grams), from = text.rfind('#', at);
  const std::string number = text.substr(from, text.find_first_of(" =", from) - from);
  text = replaced(text, grams, "( CONVERSION_BASED_UNIT('X',#90001) MASS_UNIT() NAMED_UNIT(#90000) )");
  text = replaced(text, "ENDSEC;\nEND-ISO",
                  "#90000 = DIMENSIONAL_EXPONENTS(0.,1.,0.,0.,0.,0.,0.);\n#90001 = "
                  "MASS_MEASURE_WITH_UNIT(MASS_MEASURE(2.)," +
                      number + ");\nENDSEC;\nEND-ISO");
  EXPECT_EQ(inspect_geometry(specification(write_text("itself.step", text), 0.05)).solids.at(0).density, 0.);
}

TEST(DensitiesOfAStepFile, AreTakenWhereTheSceneHasNone)
{
  FrameSpecification s = specification(two_plates(), 0.05);
  s.material           = {70e9, 0.33, 0., "scene.toml:5: frame.material"};
  Mesh mesh            = make_mesh(s);
  EXPECT_THAT(mesh.statements, Contains("solid \"plate\" and 1 more: the density is 2700 kg/m^3 (EN AW-6060), from the "
                                        "file"));
  EXPECT_NEAR(cell_materials(mesh, s).materials.at(1).rho, 2700., 1e-9);

  s.material.rho = 7850.;
  mesh           = make_mesh(s);
  EXPECT_THAT(mesh.notes, Contains(HasSubstr("the density is 7850 kg/m^3, but 2700 kg/m^3 (EN AW-6060) in the file")));
  EXPECT_EQ(cell_materials(mesh, s).materials.at(1).rho, 7850.);
  s.material.rho = 2701.; // the file rounds
  EXPECT_THAT(make_mesh(s).notes, IsEmpty());

  s.cad          = press_frame();
  s.material.rho = 0.;
  EXPECT_THAT(gestell::tests::refusal([&] { inspect_geometry(s); }),
              AllOf(StartsWith("scene.toml:5: frame.material: no density rho is given"),
                    HasSubstr("has none for solid"), HasSubstr("7850 kg/m^3")));
}

/// A cuboid of 200 x 100 x 50 mm without solid; its top face, apart from the others, lies `gap` [mm] above them.
std::string open_box(double gap)
{
  const BRep_Builder builder;
  TopoDS_Shell       shell;
  builder.MakeShell(shell);
  const TopoDS_Shape box    = BRepPrimAPI_MakeBox(200., 100., 50.).Shape(),
                     raised = BRepPrimAPI_MakeBox(200., 100., 50. + gap).Shape();
  TopExp_Explorer face(box, TopAbs_FACE), top(raised, TopAbs_FACE);
  for (int i = 0; face.More(); face.Next(), top.Next(), ++i)
    builder.Add(shell, i == 5 ? top.Current() : face.Current());
  const std::string path = folder() + "/open.brep";
  BRepTools::Write(shell, path.c_str());
  return path;
}

TEST(OpenShells, AreSewnOnRequest)
{
  FrameSpecification s = specification(open_box(0.02), 0.02);
  s.unit               = 1e-3;
  EXPECT_THAT(refusal(s), HasSubstr("open at 8 edges"));
  s.sew           = 5e-5;
  const Mesh mesh = make_mesh(s);
  EXPECT_NEAR(volume_of_cells(mesh), 1e-3, 1e-3 * 0.02 / 50.);
  EXPECT_THAT(mesh.statements, Contains("repair sews 4 edges of 5 faces within 0.05 mm, closes 1 solid, and leaves 0 "
                                        "edges open"));
}

TEST(OpenShells, StayOpenWhereTheGapIsWider)
{
  FrameSpecification s = specification(open_box(0.2), 0.02);
  s.unit               = 1e-3;
  s.sew                = 5e-5;
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("open at 8 edges"), HasSubstr("repair has sewn within 0.05 mm")));
}

// The side faces are 2 A / P = 40 mm wide at most and 33 mm at least.
TEST(OpenShells, AreNotSewnWithATolerancePastTheirWalls)
{
  FrameSpecification s = specification(open_box(0.02), 0.02);
  s.unit               = 1e-3;
  s.sew                = 0.06;
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("repair sews within 60 mm"), HasSubstr("has a face or wall of 33.333 mm"),
                                HasSubstr("less than a third"), HasSubstr("repair = { sew = ")));
  s.cad = press_frame();
  EXPECT_THAT(refusal(s), HasSubstr("repair sews within 60 mm"));
}

} // namespace
