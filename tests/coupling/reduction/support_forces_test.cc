// Forces of supports and through cuts of a reduced frame: Newton's law holds for every load, however few modes are
// kept.

#include "coupling/reduction/reduce_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/box_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell::test
{
namespace
{

using coupling::ReducedFrame;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A bar on its feet, with a node on its top and a plane through its middle.
fem::FrameMatrices bar_on(const fem::Support &feet)
{
  auto specification          = free_steel();
  specification.supports      = {feet};
  specification.interfaces    = {interface("top", {"z1"}, fem::InterfaceCoupling::average)};
  specification.cuts          = {{"middle", {{0., 0., 0.8}}, {{0., 0., 1.}}, "press.toml:50: frame.cut.middle"}};
  specification.stress_points = {{"side", {0.4, 0.1, 0.7}, {}, "press.toml:60: frame.stress_point.side"}};
  return fem::discretise(box_mesh({{2, 2, 6}}, {{0.4, 0.3, 1.5}}, 0.25), specification);
}

std::vector<fem::FrameMatrices> bars()
{
  return {bar_on(clamped("feet", {"z0"})), bar_on(foundation("feet", {"z0"}, {{2e8, 3e8, 4e8}}))};
}

const fem::FrameOutput &output_of(const ReducedFrame &frame, const std::string &name)
{
  return *std::find_if(frame.outputs.begin(), frame.outputs.end(),
                       [&](const fem::FrameOutput &output) { return output.name == name; });
}

/// Of the feet on the frame, where p is its motion and g the acceleration field.
Vector3d reaction(const ReducedFrame &frame, const VectorXd &p, const Vector3d &g)
{
  Vector3d sum;
  for (int d = 0; d < 3; ++d)
  {
    const fem::FrameOutput &force = output_of(frame, std::string("support.feet.") + "xyz"[d]);
    sum[d]                        = force.on_q.dot(p) + force.under_acceleration.dot(g);
  }
  return sum;
}

/// What is left is rounding of statics, some digits of 1e-16 times a condition of 1e6.
constexpr double rounding = 1e-8;

TEST(SupportForces, AtRestCarryTheWeightWhateverModesAreOmitted)
{
  const Vector3d g(1., -2., -9.81);
  for (const auto &frame : bars())
    for (const int modes : {0, 1, 6})
    {
      const ReducedFrame reduced = coupling::reduce_frame(frame, with_modes(modes));
      ASSERT_GT(reduced.static_residual, 0.01) << "or the modes carry the weight by themselves";
      const VectorXd p = reduced.C.lu().solve(reduced.translations_load * g);
      EXPECT_LT((reaction(reduced, p, g) + frame.mass * g).norm(), rounding * frame.mass * g.norm())
          << modes << " modes";
    }
}

TEST(SupportForces, AnswerTheForcesAtAnInterfaceWhateverModesAreOmitted)
{
  for (const auto &frame : bars())
    for (const int modes : {0, 6})
    {
      const ReducedFrame reduced = coupling::reduce_frame(frame, with_modes(modes));
      for (int d = 0; d < 3; ++d)
      {
        VectorXd force                             = VectorXd::Zero(reduced.C.rows());
        force[reduced.interfaces[0].coordinate[d]] = 1e4;
        const Vector3d answer                      = reaction(reduced, reduced.C.lu().solve(force), Vector3d::Zero());
        EXPECT_LT((answer + 1e4 * Vector3d::Unit(d)).norm(), rounding * 1e4) << modes << " modes, along " << d;
      }
    }
}

TEST(SupportForces, CutsAndStressesAtRestAreThoseOfTheFullFrame)
{
  const Vector3d g(1., -2., -9.81);
  for (const auto &frame : bars())
  {
    const ReducedFrame reduced = coupling::reduce_frame(frame, with_modes(2));
    const VectorXd     q       = statics(frame, frame.acceleration_load * g);
    const VectorXd     p       = reduced.C.lu().solve(reduced.translations_load * g);
    ASSERT_EQ(frame.outputs.size(), 6u + 3u + 6u);
    for (const fem::FrameOutput &full : frame.outputs)
    {
      const double scale =
          full.unit == "Pa" ? 1e3 : 1.; // of a stress to forces in N, with sections of 0.1 m^2 and more
      const fem::FrameOutput &few = output_of(reduced, full.name);
      EXPECT_NEAR(few.on_q.dot(p) + few.under_acceleration.dot(g), full.on_q.dot(q) + full.under_acceleration.dot(g),
                  rounding * scale * frame.mass * g.norm())
          << full.name;
    }
  }
}

} // namespace
} // namespace gestell::test
