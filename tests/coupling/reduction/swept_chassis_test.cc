// A frame of thin walls at right angles, swept: what it needs for one per cent.

#include "coupling/modes/modes.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/cad_samples.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

TEST(SweptChassis, NeedsNoMoreThan150000CoordinatesForOnePerCent)
{
  // The script of hexahedra in meshes/ with two layers and cells of 60 mm, 650 925 coordinates
  // (docs/develop/benchmarks.md).
  const double reference[] = {10.584, 41.902, 52.890, 74.630};
  auto         frame       = fem::test::specification(GESTELL_SOURCE_DIR "/meshes/ladder_chassis.geo", 0.16);
  frame.unit               = 1e-3;
  frame.mesh.plates        = fem::Plates::swept;
  frame.material           = {210e9, 0.3, 7850., "scene.toml:3"};
  frame.surfaces["pads"]   = fem::test::plane({0., 0., 1.}, {0., 0., 0.196}, 2);
  frame.interfaces         = {{"engine", {"pads"}, fem::InterfaceCoupling::average, {}, "scene.toml:9"}};
  const auto matrices      = fem::discretise(fem::make_mesh(frame), frame);
  EXPECT_LE(matrices.M.rows(), 150000);
  coupling::ReductionOptions options;
  options.n_modes    = 30;
  const auto reduced = coupling::reduce_frame(matrices, options);
  for (int j = 0; j < 4; ++j)
  {
    const double f = coupling::refined_hz(reduced, 6 + j);
    EXPECT_NEAR(f, reference[j], 0.01 * reference[j]);
    EXPECT_GT(f, 0.99 * reference[j]);
  }
}

} // namespace
} // namespace gestell
