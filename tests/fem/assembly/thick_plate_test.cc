#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

/// 10 x 10 x 1 m, hard support: on each side face the vertical displacement and the horizontal one along the face are
/// zero, the one normal to the face is free.  Exact solutions are products of sines with a smooth course over z.
fem::FrameMatrices plate(int n, int n_z)
{
  fem::FrameSpecification specification;
  specification.material = {200e9, 0.3, 8000., "plate"};
  specification.supports = {clamped("x sides", {"x0", "x1"}, {{false, true, true}}),
                            clamped("y sides", {"y0", "y1"}, {{true, false, true}})};
  return fem::discretise(box_mesh({{n, n, n_z}}, {{10., 10., 1.}}), specification);
}

/// Share of the vertical motion in the picture of a mode: 0 in its plane, about 1 in bending.
double vertical_share(const fem::FrameMatrices &frame, const Eigen::VectorXd &mode)
{
  const Eigen::VectorXd u        = frame.picture.displacement * mode;
  double                vertical = 0.;
  for (int i = 2; i < u.size(); i += 3)
    vertical += u[i] * u[i];
  return vertical / u.squaredNorm();
}

struct PlateModes
{
  std::vector<double> bending, in_plane; // [Hz]
};

PlateModes plate_modes(int n, int n_z, int n_modes = 8)
{
  const auto  frame = plate(n, n_z);
  const Modes modes = lowest_modes(frame, n_modes);
  PlateModes  result;
  for (int j = 0; j < n_modes; ++j)
  {
    const double share = vertical_share(frame, modes.shape.col(j));
    if (share < 1e-3)
      result.in_plane.push_back(modes.frequency_hz[j]);
    else if (share > 0.5)
      result.bending.push_back(modes.frequency_hz[j]);
  }
  return result;
}

TEST(ThickPlate, HasTheFrequenciesOfThreeDimensionalElasticity)
{
  const PlateModes modes = plate_modes(16, 2);
  ASSERT_GE(modes.bending.size(), 4u);
  ASSERT_GE(modes.in_plane.size(), 2u);
  const double exact[4] = {45.897, 109.44, 109.44, 167.89};
  for (int j = 0; j < 4; ++j)
    EXPECT_NEAR(modes.bending[j], exact[j], 0.01 * exact[j]) << "bending " << j + 1;
  for (int j = 0; j < 2; ++j)
    EXPECT_NEAR(modes.in_plane[j], 155.043, 1e-4 * 155.043) << "in-plane shear " << j + 1;
}

TEST(ThickPlate, FrequenciesFallToTheExactOnesWithTheFourthPowerOfTheCellSize)
{
  // Quadratic elements, smooth mode: relative error of omega^2 ~ (h / wave length)^4 from above (Strang & Fix).
  // In-plane shear u_x = sin(pi y / L):  f = sqrt(mu / rho) / (2 L).
  const double     exact  = std::sqrt(200e9 / 2.6 / 8000.) / 20.;
  const PlateModes coarse = plate_modes(4, 1), fine = plate_modes(8, 1);
  ASSERT_GE(coarse.in_plane.size(), 2u);
  ASSERT_GE(fine.in_plane.size(), 2u);
  for (int j = 0; j < 2; ++j)
  {
    EXPECT_GT(fine.in_plane[j], exact);
    EXPECT_NEAR(std::log2((coarse.in_plane[j] - exact) / (fine.in_plane[j] - exact)), 4., 0.35);
  }
  // Bending against its own limit by Richardson's rule: e(4)/e(8) from three meshes.
  const double f4 = plate_modes(4, 2, 1).bending[0], f8 = plate_modes(8, 4, 1).bending[0];
  const double f2 = plate_modes(2, 1, 1).bending[0];
  EXPECT_GT(f2, f4);
  EXPECT_GT(f4, f8);
  EXPECT_GT(std::log2((f2 - f4) / (f4 - f8)), 3.);
}

} // namespace
} // namespace gestell::test
