// Frames with very soft and very stiff parts, near what rounding leaves of them.

#include "coupling/algebra/dense_modes.h"
#include "coupling/eigensolvers/sturm_check.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/reduce_frame.h"
#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Blocks of 3 x 3 x nz points one above the other, a gap between them.
fem::FrameMatrices two_blocks(const Lattice &whole, Eigen::SparseMatrix<double> &between, double soft)
{
  Lattice lower                             = whole;
  lower.nz                                  = whole.nz / 2;
  const auto                          half  = frame_of(lower);
  auto                                frame = frame_of(whole); // masses, motions
  const int                           n     = int(half.C.rows());
  std::vector<Eigen::Triplet<double>> rods, weak;
  for (int j = 0; j < n; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator c(half.C, j); c; ++c)
      for (const int at : {0, n})
        rods.emplace_back(at + int(c.row()), at + j, c.value());
  Lattice weaker   = whole;
  weaker.stiffness = soft;
  for (int p = 0; p < whole.nx * whole.ny; ++p)
    for (int r = 0; r < whole.nx * whole.ny; ++r)
      add_rod(weak, weaker, n / 3 - whole.nx * whole.ny + p, n / 3 + r);
  between.resize(2 * n, 2 * n);
  between.setFromTriplets(weak.begin(), weak.end());
  frame.C.setFromTriplets(rods.begin(), rods.end());
  frame.C += between;
  frame.C.makeCompressed();
  frame.interfaces.clear();
  for (const int k : {0, whole.nz - 1}) // each block is held by four points
    for (const int i : {0, 2})
      frame.interfaces.push_back(
          interface_at("i" + std::to_string(k) + std::to_string(i), whole.point(i, 0, k), whole.point(i, 2, k)));
  return frame;
}

TEST(FloatingFrame, CountsItsOwnMotionsWhereSoftOnesAreHardlyMoreThanRounding)
{
  Lattice lattice;
  lattice.nx = 3, lattice.ny = 3, lattice.nz = 8;
  lattice.foundation = lattice.damper = 0.;
  for (const double soft : {1e-1, 1e-4}) // of 1e7; S scaled to unit diagonal has eigenvalues of 1e-9 and 1e-12
  {
    Eigen::SparseMatrix<double> between;
    const auto                  frame = two_blocks(lattice, between, soft);
    const int                   n     = int(frame.C.rows());
    MatrixXd                    R     = MatrixXd::Zero(n, 12); // blocks that move as rigid bodies: 1e-8 too stiff
    R.topLeftCorner(n / 2, 6)         = frame.rigid_motions.topRows(n / 2);
    R.bottomRightCorner(n / 2, 6)     = frame.rigid_motions.bottomRows(n / 2);
    const VectorXd bodies =
        coupling::dense_modes(R.transpose() * (between * R), R.transpose() * (frame.M * R), 1e-12, 6).omega;
    coupling::ReductionOptions options;
    options.n_modes    = 10;
    const auto reduced = coupling::reduce_frame(frame, options);
    EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 6) << soft;
    EXPECT_EQ(reduced.facts.free_motions.size(), 6u);
    for (int j = 6; j < 12; ++j) // rounding of C*, 1e-16 of 1e9, beside 1e-4
    {
      EXPECT_NEAR(reduced.frequencies_hz[j] * 2. * M_PI, bodies[j], 1e-2 * bodies[j]) << soft << " " << j;
      EXPECT_LT(reduced.frequency_error[j], 1e-2);
    }
    EXPECT_EQ(reduced.n_rigid(), 6);

    auto damped                = frame; // every elastic mode is damped, soft ones too
    damped.modal_damping_ratio = 0.02;
    options.inertia_relief     = true;
    const auto   relieved      = coupling::reduce_frame(damped, options);
    const auto   modes         = coupling::dense_modes(relieved.C, relieved.M, 1e-10, 6);
    const double omega         = modes.omega[6];
    EXPECT_NEAR(modes.V.col(6).dot(relieved.B * modes.V.col(6)), 2. * 0.02 * omega, 1e-2 * omega) << soft;
  }
}

TEST(LumpedMasses, HaveAsManyModesAsThereAreAndNoMoreAreSearchedFor)
{
  auto frame = frame_of(Lattice());
  for (int i = 0; i < frame.M.rows(); ++i)
    if (i / 3 % 10 != 4) // nine points keep theirs
      frame.M.coeffRef(i, i) = 0.;
  const VectorXd full    = coupling::dense_modes(frame.C, frame.M).omega;
  const auto     reduced = coupling::reduce_frame(frame, coupling::ReductionOptions());
  EXPECT_LE(reduced.omega0.size(), 27);
  for (int j = 0; j < 12; ++j)
    EXPECT_NEAR(reduced.frequencies_hz[j] * 2. * M_PI, full[j], 0.01 * full[j]) << j;

  coupling::ReductionOptions options;
  options.n_modes = 40;
  tests::expect_refusal<coupling::ConvergenceFailure>([&] { coupling::reduce_frame(frame, options); },
                                                      "mass matrix has no higher rank");
}

/// Rigid motions are left alone, elastic modes have the ratio.
TEST(ModalDamping, OfAFloatingFrameDampsItsElasticModes)
{
  Lattice lattice;
  lattice.foundation        = 0.;
  auto frame                = frame_of(lattice);
  frame.modal_damping_ratio = 0.02;
  coupling::add_modal_damping(frame, 10);
  const auto modes = coupling::dense_modes(frame.C, frame.M);
  ASSERT_EQ(frame.modal_damping.d.size(), 10);
  for (int j = 0; j < 16; ++j)
  {
    const Eigen::VectorXd z       = frame.modal_damping.Z.transpose() * modes.V.col(j);
    const double          damping = z.dot(frame.modal_damping.d.cwiseProduct(z));
    EXPECT_NEAR(damping, j < 6 ? 0. : 0.04 * modes.omega[j], 1e-6 * modes.omega[15]) << j;
  }
}

/// One mode at 100 rad/s that moves a coordinate of 1e20 N/m by 1e-4, the next at 101; a factor of a given growth.
class OneStiffCoordinate : public coupling::SturmCheckedModes
{
public:
  explicit OneStiffCoordinate(double growth) : SturmCheckedModes("modes", false, {}, stiffness()), growth_(growth) {}

private:
  struct Search : coupling::ModeSearch
  {
    void                  find(int) override {}
    coupling::LowestModes modes(int) const override
    {
      return {VectorXd::Constant(1, 100.), Eigen::Vector2d(1., 1e-4), VectorXd::Zero(1)};
    }
    Gap gap_above(int) const override { return {100., 101., 1}; }
  };
  static Eigen::SparseMatrix<double> stiffness()
  {
    return MatrixXd(Eigen::Vector2d(1e4, 1e20).asDiagonal()).sparseView();
  }
  int                                   n() const override { return 2; }
  coupling::LowestModes                 all() const override { return {}; }
  void                                  restore() override {}
  void                                  release() override {}
  coupling::Inertia                     below(double) override { return {1, growth_}; }
  std::unique_ptr<coupling::ModeSearch> search(const coupling::BlockLanczos::Options &,
                                               const coupling::LowestModes &) const override
  {
    return std::make_unique<Search>();
  }
  double growth_;
};

TEST(Completeness, IsNotReportedWhereRoundingMayMoveAFrequencyAcrossTheGap)
{
  // In the middle of the gap, 100.5^2 - 100^2 = 100.25, rounding moves omega^2 by growth 2.2e-16 (1e12 + 1e4).
  const double largest = 100.25 / (std::numeric_limits<double>::epsilon() * (1e12 + 1e4));
  EXPECT_EQ(OneStiffCoordinate(0.99 * largest).find_all(1).omega.size(), 1);
  tests::expect_refusal<coupling::ConvergenceFailure>([&] { OneStiffCoordinate(1.01 * largest).find_all(1); },
                                                      "cannot be counted");
}

} // namespace
} // namespace gestell::test
