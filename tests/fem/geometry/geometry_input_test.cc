// Bad CAD files, sizes and selections: each is refused with its place, the value and the way out.

#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

namespace
{

constexpr const char *frame = "scene.toml:3: frame";
constexpr const char *mesh  = "scene.toml:4: frame.mesh";

std::string box()
{
  return draw("box.step", [] { gmsh::model::occ::addBox(0., 0., 0., 1000., 1000., 1000.); });
}

std::string two_boxes(double x, const std::string &name = "two.step")
{
  return draw(name,
              [x]
              {
                gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.);
                gmsh::model::occ::addBox(x, 0., 0., 100., 100., 100.);
              });
}

TEST(CadFile, ThatHoldsNoModelIsRefusedWithPlaceAndReason)
{
  const std::string whole = read_text(press_frame()), half = whole.substr(0, whole.size() / 2),
                    empty    = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
                    built_in = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 1, 0};\n"
                               "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\n"
                               "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n"
                               "Extrude {0, 0, 1} { Surface{1}; }\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"/no/such/press.step", "/no/such/press.step does not exist"},
      {"", "set cad"},
      {folder(), "is not a file"},
      {write_text("empty.step", ""), "is empty"},
      {write_text("frame.dxf", "0"), "\".dxf\""},
      {write_text("frame.dxf", "0"), "export the model as STEP"},
      {write_text("text.step", "hello"), "not a STEP file"},
      {write_text("cut.step", half), "is truncated"}, // gmsh would read it
      {write_text("cut.step", half), "END-ISO-10303-21"},
      {write_text("hole.step", half + "\nENDSEC;\nEND-ISO-10303-21;\n"), "hole.step"},
      {write_text("none.step", empty), "none.step"},
      {write_text("builtin.geo", built_in), "SetFactory"}};
  for (const auto &[cad, words] : files)
    EXPECT_THAT(refusal(specification(cad, 0.1)), AllOf(StartsWith(frame), HasSubstr(words))) << cad;
}

TEST(StepFile, ThatHoldsOnlyFacesIsRefused)
{
  const std::string sheet = draw("sheet.step", [] { gmsh::model::occ::addRectangle(0., 0., 0., 100., 100.); });
  EXPECT_THAT(refusal(specification(sheet, 0.01)),
              AllOf(StartsWith(frame), HasSubstr("no closed solid, only 1 faces"), HasSubstr("sew the faces")));

  const std::string open_box = draw("open.step",
                                    []
                                    {
                                      gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.);
                                      gmsh::model::occ::remove({{3, 1}});
                                      gmsh::model::occ::remove({{2, 1}});
                                    });
  EXPECT_THAT(refusal(specification(open_box, 0.01)), HasSubstr("no closed solid, only 5 faces"));
}

TEST(StepFile, InAnotherUnitIsRecognisedByItsSize)
{
  std::string       text  = read_text(press_frame());
  const std::string milli = "SI_UNIT(.MILLI.,.METRE.)";
  ASSERT_NE(text.find(milli), std::string::npos);
  text.replace(text.find(milli), milli.size(), "SI_UNIT($,.METRE.)");
  EXPECT_THAT(refusal(specification(write_text("metre.step", text), 0.1)),
              AllOf(StartsWith(frame), HasSubstr("m across"), HasSubstr("unit is probably wrong")));

  const std::string tiny = draw("tiny.step", [] { gmsh::model::occ::addBox(0., 0., 0., 0.2, 0.2, 0.2); });
  EXPECT_THAT(refusal(specification(tiny, 0.1)), AllOf(HasSubstr("m across"), HasSubstr("unit = 1 m")));
}

TEST(StepFile, ThatLiesFarFromTheOriginIsRefused)
{
  const auto reported = [](double x) {
    return refusal(specification(draw("far.step", [x] { gmsh::model::occ::addBox(x, 0., 0., 1e3, 1e3, 1e3); }), 0.5));
  };
  EXPECT_EQ(reported(1e7), ""); // 10 km
  EXPECT_THAT(reported(1e12), HasSubstr("is 1.7321 m across and is 1e+09 m from the origin"));
}

TEST(StepFile, OfASizeFewFramesHaveIsTakenWithANote)
{
  const auto notes = [](double side)
  {
    const std::string box = draw("box of " + std::to_string(side) + " mm.step",
                                 [side] { gmsh::model::occ::addBox(0., 0., 0., side, side, side); });
    return make_mesh(specification(box, 0.5e-3 * side)).notes;
  };
  EXPECT_THAT(notes(10.), ElementsAre(AllOf(HasSubstr("is 0.017321 m across"), HasSubstr("metres, read as milli"),
                                            HasSubstr("unit = 1 m would make it 17.321 m"))));
  EXPECT_THAT(notes(20.), IsEmpty());
  EXPECT_THAT(notes(25e3), IsEmpty());
  EXPECT_THAT(notes(60e3), ElementsAre(AllOf(HasSubstr("is 103.92 m across"), HasSubstr("millimetres, read as m"),
                                             HasSubstr("would make it 0.10392 m"))));
}

TEST(BrepFile, ThatWasCutOffIsRefusedThoughOpenCascadeWouldReadItForEver)
{
  const std::string whole = read_text(draw("box.brep", [] { gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.); }));
  EXPECT_EQ(refusal(specification(write_text("whole.brep", whole), 0.5)), "");
  EXPECT_THAT(refusal(specification(write_text("cut.brep", whole.substr(0, whole.size() / 2)), 0.5)),
              HasSubstr("is truncated"));
  EXPECT_THAT(refusal(specification(write_text("text.brep", "hello"), 0.5)), HasSubstr("not a BREP file"));
}

TEST(BrepFile, ThatAnnouncesMoreThanItHoldsIsRefusedWhereOpenCascadeWouldNotEnd)
{
  const std::string whole  = read_text(draw("box.brep", [] { gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.); }));
  const auto        edited = [&](const std::string &old, const std::string &text)
  {
    std::string edited = whole;
    edited.replace(edited.find(old), old.size(), text);
    return refusal(specification(write_text("edited.brep", edited), 0.5));
  };
  EXPECT_THAT(edited("Curves 12", "Curves 4000000000"), HasSubstr("edited.brep is damaged"));
  EXPECT_THAT(edited("Locations 0", "Locations 18446744073709551615"), HasSubstr("is damaged at line 4:"));
  EXPECT_THAT(edited("Curve2ds 24", "Curve2ds 25"), HasSubstr("is damaged at line 30:"));
}

TEST(BrepFile, WithAFaceTurnedInsideOutIsRefused)
{
  EXPECT_THAT(refusal(specification(GESTELL_SOURCE_DIR "/tests/fuzz/mesh/found/negative_area.brep", 0.5)),
              HasSubstr("the face 4 from (0 0.5 0) to (1 0.5 0.4) has an area of -0.6 m^2"));
}

TEST(GeoFile, WithAnErrorInItIsRefusedWithGmshsWords)
{
  const std::string cad = write_text("bad.geo", "SetFactory(\"OpenCASCADE\");\nBax(1) = {0, 0, 0, 1, 1, 1};\n");
  const auto        run = [&]
  {
    std::cerr << refusal(specification(cad, 0.1));
    std::exit(0);
  };
  EXPECT_EXIT(run(), ::testing::ExitedWithCode(0), "scene.toml:3: frame.*line 2"); // gmsh's parser does not recover
}

TEST(Bodies, ThatLieApartAreRefusedByName)
{
  EXPECT_THAT(refusal(specification(two_boxes(200.), 0.05)),
              AllOf(StartsWith(frame), HasSubstr("2 bodies without common faces"), HasSubstr("body 2"),
                    HasSubstr("mesh.bodies = 2")));
}

TEST(Bodies, OfAMeshWithoutCommonNodesAreRefused)
{
  const std::string cad = draw("two.msh",
                               []
                               {
                                 gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
                                 gmsh::model::occ::addBox(1., 0., 0., 1., 1., 1.);
                                 gmsh::model::occ::synchronize();
                                 gmsh::model::mesh::generate(3);
                               });
  EXPECT_THAT(refusal(specification(cad, 0.)), AllOf(StartsWith(frame), HasSubstr("2 bodies"), HasSubstr("cells of")));
}

TEST(MeshFile, WithoutAVolumeMeshIsRefused)
{
  const auto cad = [](const std::string &name, const std::function<void()> &shape)
  {
    return draw(name,
                [&]
                {
                  shape();
                  gmsh::model::occ::synchronize();
                  gmsh::model::mesh::generate(2);
                });
  };
  const auto surface = cad("surface.msh", [] { gmsh::model::occ::addRectangle(0., 0., 0., 1., 1.); }),
             hollow  = cad("hollow.msh", [] { gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.); });
  EXPECT_THAT(refusal(specification(surface, 0.)), AllOf(StartsWith(frame), HasSubstr("no tetrahedra")));
  EXPECT_THAT(refusal(specification(hollow, 0.)),
              AllOf(StartsWith(frame), HasSubstr("solid 1"), HasSubstr("no volume mesh")));
}

TEST(MeshFile, OfHexahedraIsTaken)
{
  const std::string cad = draw("hexahedra.msh",
                               []
                               {
                                 namespace occ = gmsh::model::occ;
                                 gmsh::vectorpair swept;
                                 occ::addRectangle(0., 0., 0., 1., 1.);
                                 occ::extrude({{2, 1}}, 0., 0., 1., swept, {2}, {}, true);
                                 occ::synchronize();
                                 gmsh::model::mesh::setTransfiniteSurface(1);
                                 gmsh::model::mesh::setRecombine(2, 1);
                                 gmsh::model::mesh::generate(3);
                               });
  EXPECT_EQ(refusal(specification(cad, 0.)), "");
}

TEST(MeshFile, OfTetrahedraBesideHexahedraIsRefusedWithTheirNumbers)
{
  const std::string cad = draw("mixed.msh",
                               []
                               {
                                 namespace occ = gmsh::model::occ;
                                 gmsh::vectorpair swept;
                                 occ::addRectangle(0., 0., 0., 1., 1.);
                                 occ::extrude({{2, 1}}, 0., 0., 1., swept, {2}, {}, true);
                                 occ::addBox(3., 0., 0., 1., 1., 1.);
                                 occ::synchronize();
                                 for (int curve = 1; curve <= 4; ++curve)
                                   gmsh::model::mesh::setTransfiniteCurve(curve, 3);
                                 gmsh::model::mesh::setTransfiniteSurface(1);
                                 gmsh::model::mesh::setRecombine(2, 1);
                                 gmsh::model::mesh::generate(3);
                               });
  EXPECT_THAT(refusal(specification(cad, 0.)),
              AllOf(StartsWith(frame), ContainsRegex("mixed.msh holds [0-9]+ tetrahedra and 8 hexahedra, but a mesh"),
                    HasSubstr("gmsh: without Recombine")));
}

TEST(Script, ThatMeshesPrismsIsTaken)
{
  const std::string cad = write_text(
      "prisms.geo", "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 1, 1};\nTransfinite Surface{1};\n"
                    "Transfinite Curve{1:4} = 2;\nExtrude {0, 0, 1} { Surface{1}; Layers{3}; Recombine; }\n"
                    "Mesh 3;\n");
  const GeometryReport report = report_geometry(specification(cad, 1.));
  EXPECT_EQ(report.n_of_kind, (std::array<std::size_t, 3>{0, 0, 6}));
  EXPECT_NEAR(report.volume, 1., 1e-14);
  EXPECT_NEAR(report.worst_quality, std::sqrt(0.5 / 0.75), 1e-12) << "an angle of 45 degrees in place of 60";
}

TEST(ElementSize, ThatIsNotPositiveIsRefusedWithASizeThatWouldDo)
{
  for (const double size : {0., -0.1})
    EXPECT_THAT(refusal(specification(box(), size)),
                AllOf(StartsWith(mesh), HasSubstr("must be > 0"), HasSubstr("size = 0.074 m would give")));
}

TEST(ElementSize, LargerThanTheModelIsRefused)
{
  EXPECT_THAT(refusal(specification(box(), 2.)), AllOf(StartsWith(mesh), HasSubstr("larger than the model (1 m)")));
}

TEST(ElementSize, ThatWouldGiveTooManyCellsIsRefusedBeforeMeshing)
{
  EXPECT_THAT(refusal(specification(box(), 0.001)), // 1e10 cells: meshing would not end
              AllOf(StartsWith(mesh), HasSubstr("max_cells"), HasSubstr("use size = 0.018 m")));
}

TEST(ElementSize, OnAnUnknownSurfaceIsRefused)
{
  FrameSpecification s = specification(box(), 0.2);
  s.surfaces["top"]    = plane({0., 0., 1.}, {0., 0., 1.});
  s.mesh.surface_size  = {{"topp", 0.1}};
  EXPECT_THAT(refusal(s), AllOf(StartsWith(mesh), HasSubstr("\"topp\""), HasSubstr("known are \"top\"")));
  s.mesh.surface_size = {{"top", 0.3}};
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("\"top\" = 0.3 m"), HasSubstr("at most size = 0.2 m")));
  s.mesh.surface_size = {{"top", 1e-4}};
  EXPECT_THAT(refusal(s), HasSubstr("sizes on surfaces"));
}

TEST(Selection, WithoutAFaceListsTheNearestOnes)
{
  FrameSpecification s = specification(press_frame(), 0.1);
  s.surfaces["bore"]   = cylinder({0., 1., 0.}, {0., 0.52, 2.58}, 0.12);
  EXPECT_THAT(refusal(s),
              AllOf(StartsWith("scene.toml:8: frame.surface: no face matches"), HasSubstr("cylinder of radius 0.12 m"),
                    HasSubstr("through (0 0.52 2.56), radius 0.12"), HasSubstr("off by 20 mm")));
}

TEST(Selection, OfOneFaceForTwoInterfacesIsRefusedBeforeMeshing)
{
  FrameSpecification s = specification(box(), 0.2);
  s.surfaces["top"]    = plane({0., 0., 1.}, {0., 0., 1.});
  s.surfaces["lid"]    = plane({0., 0., 1.}, {0.5, 0.5, 1.});
  s.interfaces         = {{"press", {"top"}, InterfaceCoupling::rigid, {}, "scene.toml:9: frame.interface.press"},
                          {"motor", {"lid"}, InterfaceCoupling::average, {}, "scene.toml:12: frame.interface.motor"}};
  EXPECT_THAT(refusal(s), AllOf(StartsWith("scene.toml:12: frame.interface.motor"), HasSubstr("\"lid\""),
                                HasSubstr("\"top\" of interface \"press\""), HasSubstr("the same face"),
                                HasSubstr("normal (0 0 1)")));
}

TEST(Selection, OfAnotherNumberOfFacesThanWantedListsThem)
{
  FrameSpecification s = specification(press_frame(), 0.1);
  s.surfaces["feet"]   = plane({0., 0., -1.}, {0., 0., 0.});
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("4 faces match"), HasSubstr("faces = 1"), HasSubstr("normal (0 0 -1)")));
}

TEST(Selection, OfAGroupThatDoesNotExistListsTheGroupsThatDo)
{
  const std::string  cad = write_text("named.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
                                                    "Physical Surface(\"foot\") = {5};\n");
  FrameSpecification s   = specification(cad, 0.5);
  s.surfaces["feet"]     = group("feet");
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("group \"feet\""), HasSubstr("The model names \"foot\"")));
}

} // namespace
