// Guyan's static condensation: the static shapes of the interface alone.

#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/values/two_pi.h"
#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using coupling::dense_modes;
using coupling::ReductionOptions;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ReductionOptions by_guyan(double frequency = 0.)
{
  ReductionOptions options;
  options.method    = "guyan";
  options.frequency = frequency;
  return options;
}

std::vector<int> inside_of(const fem::FrameMatrices &frame)
{
  const auto       q1 = frame.interface_coordinates();
  std::vector<int> q2;
  for (int i = 0; i < int(frame.M.rows()); ++i)
    if (!std::binary_search(q1.begin(), q1.end(), i))
      q2.push_back(i);
  return q2;
}

bool tells(const std::vector<std::string> &texts, const std::string &part)
{
  return std::any_of(texts.begin(), texts.end(), [&](const std::string &t) { return t.find(part) != t.npos; });
}

// So statics are exact, frequencies come from above, and inertia and dampers follow the shapes: see CraigBampton.
TEST(Guyan, IsCraigBamptonWithoutModes)
{
  for (const double foundation : {3e6, 0.}) // held, and afloat
  {
    Lattice lattice;
    lattice.foundation        = foundation;
    lattice.damper            = foundation > 0. ? lattice.damper : 0.;
    fem::FrameMatrices frame  = frame_of(lattice);
    frame.modal_damping_ratio = 0.02;
    for (const bool relief : {false, true})
    {
      ReductionOptions alone = by_guyan(), without_modes;
      without_modes.n_modes  = 0;
      alone.inertia_relief = without_modes.inertia_relief = relief;
      const auto a = coupling::reduce_frame(frame, alone), b = coupling::reduce_frame(frame, without_modes);
      EXPECT_EQ(a.M, b.M);
      EXPECT_EQ(a.B, b.B);
      EXPECT_EQ(a.C, b.C);
      EXPECT_EQ(a.frequencies_hz, b.frequencies_hz);
      EXPECT_EQ(a.translations_load, b.translations_load);
      EXPECT_EQ(a.static_residual, b.static_residual);
      EXPECT_EQ(a.omega0.size() > 0, relief);
    }
  }
}

TEST(Guyan, TellsModesOfTheInsideThatItLeavesOut)
{
  const auto     frame = frame_of(Lattice());
  const auto     q2    = inside_of(frame);
  const MatrixXd C = frame.C, M = frame.M;
  const VectorXd held    = dense_modes(C(q2, q2), M(q2, q2)).omega / two_pi;
  const auto     between = coupling::reduce_frame(frame, by_guyan(0.5 * (held(2) + held(3))));
  EXPECT_TRUE(tells(between.notes, "the frame has 3 fixed-interface modes below")) << between.notes.size();
  EXPECT_TRUE(tells(between.notes, "craig-bampton"));
  EXPECT_NEAR(between.frequency_limit_hz, 0.5 * (held(2) + held(3)), 1e-12 * held(3));
}

TEST(Guyan, ReportsHowFarItsFrequenciesHold)
{
  Lattice lattice;
  lattice.foundation       = 3e5; // so soft that the lowest modes are those of a rigid block on it
  const auto     frame     = frame_of(lattice);
  const VectorXd exact     = dense_modes(frame.C, frame.M).omega / two_pi;
  const auto     automatic = coupling::reduce_frame(frame, by_guyan());
  const double   limit     = automatic.frequency_limit_hz;
  ASSERT_GT(limit, 0.);
  EXPECT_TRUE(tells(automatic.statements, "are at most 1 % above those of the frame"));
  for (int j = 0; j < automatic.frequencies_hz.size() && exact(j) <= limit; ++j)
    EXPECT_LE(automatic.frequencies_hz(j), 1.011 * exact(j)); // 1 %, and a tenth of it for the estimate
  const auto beyond = coupling::reduce_frame(frame, by_guyan(3. * limit));
  EXPECT_TRUE(tells(beyond.notes, "too high"));
  EXPECT_FALSE(tells(beyond.statements, "are at most"));
}

TEST(Guyan, OfAFrameWithoutInterfacesIsRefused)
{
  auto frame = frame_of(Lattice());
  frame.interfaces.clear();
  tests::expect_refusal([&] { coupling::reduce_frame(frame, by_guyan()); }, "frame.interface");
}

} // namespace
} // namespace gestell::test
