// Solids with the tip of a cone or the pole of a sphere: an edge that is a point, with a length of rounding.

#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

namespace
{

namespace occ = gmsh::model::occ;

const double pi = std::acos(-1.);

struct RoundEnd
{
  std::string           name;
  std::function<void()> draw;   ///< in mm
  double                volume; ///< [mm^3]
  double                curved; ///< [mm^2] of faces that are not plane
};

void PrintTo(const RoundEnd &solid, std::ostream *out)
{
  *out << solid.name;
}

/// A cube of 100 mm without what the tool (solids 2, 3) takes of it.
void cut_from_cube(const gmsh::vectorpair &tool)
{
  gmsh::vectorpair              left;
  std::vector<gmsh::vectorpair> map;
  occ::addBox(-50., -50., 0., 100., 100., 100., 1);
  occ::cut({{3, 1}}, tool, left, map);
}

std::vector<RoundEnd> solids()
{
  const double r = 20., tip = r / std::tan(59. * pi / 180.), cube = 1e6, ball = 4. / 3. * pi * r * r * r;
  const auto   drilled = [=]
  {
    occ::addCylinder(0., 0., 100., 0., 0., -40., r, 2);
    occ::addCone(0., 0., 60., 0., 0., -tip, r, 0., 3);
    cut_from_cube({{3, 2}, {3, 3}});
  };
  const auto milled = [=]
  {
    occ::addCylinder(0., 0., 100., 0., 0., -40., r, 2);
    occ::addSphere(0., 0., 60., r, 3);
    cut_from_cube({{3, 2}, {3, 3}});
  };
  const auto domed = [=]
  {
    gmsh::vectorpair              whole;
    std::vector<gmsh::vectorpair> map;
    occ::addBox(-50., -50., 0., 100., 100., 100., 1);
    occ::addSphere(0., 0., 100., r, 2);
    occ::fuse({{3, 1}}, {{3, 2}}, whole, map);
  };
  const auto hollow = [=]
  {
    occ::addSphere(0., 0., 50., r, 2);
    cut_from_cube({{3, 2}});
  };
  const double bore = pi * r * r * 40., wall = 2. * pi * r * 40., whole = 4. * pi * r * r;
  return {
      {"blind_hole_of_118_degrees", drilled, cube - bore - pi * r * r * tip / 3., wall + pi * r * std::hypot(r, tip)},
      {"hole_with_ball_end", milled, cube - bore - ball / 2., wall + whole / 2.},
      {"dome", domed, cube + ball / 2., whole / 2.},
      {"cavity", hollow, cube - ball, whole},
      {"sphere", [=] { occ::addSphere(0., 0., 0., r); }, ball, whole},
      {"cone_with_apex", [=] { occ::addCone(0., 0., 0., 0., 0., 60., r, 0.); }, pi * r * r * 20.,
       pi * r * std::hypot(r, 60.)}};
}

using RoundEnds = ::testing::TestWithParam<RoundEnd>;

/// A side of length l stays within l^2 / (8 r) of the curved face; gmsh makes sides up to some sqrt(2) h.
TEST_P(RoundEnds, OfAStepFileAreMeshedToTheVolumeOfTheSolid)
{
  const double         h = 8., r = 20.;
  const GeometryReport report   = report_geometry(specification(draw("solid.step", GetParam().draw), 1e-3 * h));
  const double         straight = GetParam().curved * h * h / (4. * r);
  EXPECT_NEAR(1e9 * report.volume, GetParam().volume, straight);
  EXPECT_NEAR(1e9 * report.solids.at(0).volume, GetParam().volume, 1e-6 * GetParam().volume);
  EXPECT_THAT(report.notes, Each(Not(HasSubstr("much smaller"))));
}

TEST_P(RoundEnds, OfACoarseMeshAreClosed)
{
  EXPECT_EQ(refusal(specification(draw("solid.step", GetParam().draw), 0.03)), "");
}

INSTANTIATE_TEST_SUITE_P(Solids, RoundEnds, ::testing::ValuesIn(solids()),
                         [](const auto &solid) { return solid.param.name; });

TEST(OpenShells, WithATipAreRefusedForTheEdgeThatIsOpen)
{
  // A cone without its base: the circle is open, the tip is not.
  const std::string  cad = draw("cone.brep",
                                []
                                {
                                 occ::addCone(0., 0., 0., 0., 0., 60., 20., 0.);
                                 occ::remove({{3, 1}});
                                 occ::remove({{2, 2}});
                               });
  FrameSpecification s   = specification(cad, 0.01);
  s.unit                 = 1e-3;
  EXPECT_THAT(refusal(s), HasSubstr("open at 1 edge, "));
}

} // namespace
