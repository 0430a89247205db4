// Ten frames of thin walls, tubes and bosses, each in three sizes, the largest seven times the thickness of a wall.

#include "fem/mesh/curved_sides.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesher.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"
#include "tests/support/thin_frames.h"

#include <iomanip>
#include <iostream>

using namespace gestell::fem;
using namespace gestell::fem::test;

namespace
{

class ThinFrames : public ::testing::TestWithParam<std::size_t>
{
};

/// A polygon of 12 sides, the fewest of a circle, has 4.5 % less area than it; a side that skips a corner of another
/// circle of the same solid adds to that.
TEST_P(ThinFrames, AreMeshedInEverySizeWithTheirMass)
{
  const ThinFrame   frame = thin_frames()[GetParam()];
  const std::string cad   = draw(frame.name + ".step", frame.draw);
  for (const double size : {0.1, 0.06, 0.03})
  {
    const GeometryReport report = report_geometry(specification(cad, size));
    const Mesh          &mesh   = report.extracted.mesh;
    std::vector<double>  volumes(report.solids.size(), 0.);
    const auto           of_cell = curved_volumes(mesh);
    double               all = 0., of_geometry = 0.;
    for (std::size_t i = 0; i < of_cell.size(); ++i)
    {
      ASSERT_GT(six_volumes(mesh, mesh.cells[i]), 0.) << frame.name;
      volumes[mesh.cell_solid[i]] += of_cell[i];
      all += of_cell[i];
    }
    for (std::size_t i = 0; i < volumes.size(); ++i)
    {
      of_geometry += report.solids[i].volume;
      EXPECT_NEAR(volumes[i] / report.solids[i].volume, 1., 0.05) << frame.name << ", solid " << i << ", " << size;
    }
    EXPECT_NEAR(all / of_geometry, 1., 0.0451) << frame.name << ", " << size;
    EXPECT_EQ(report.size, size) << "no smaller size is needed";
    constexpr double steel = 7850.;
    std::cout << std::left << std::setw(20) << frame.name << std::right << std::setw(5) << 1e3 * size << " mm "
              << std::setw(6) << report.n_cells << " cells, " << steel * all << " kg, of the geometry "
              << steel * of_geometry << " kg\n";
  }
}

INSTANTIATE_TEST_SUITE_P(Ten, ThinFrames, ::testing::Range<std::size_t>(0, 10),
                         [](const auto &number) { return thin_frames()[number.param].name; });

} // namespace
