#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/reduce_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/machine/dense_base.h"
#include "coupling/modes/modes.h"
#include "coupling/reduction/estimates/refined_modes.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::dense_modes;
using coupling::reduce_frame;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::frame_of;
using test::Lattice;
using test::with_modes;

fem::FrameMatrices without_dampers(Lattice lattice)
{
  lattice.damper = 0.;
  return frame_of(lattice);
}

TEST(ModalDamping, GivesEachModeOfTheFullFrameItsRatioAndNoneAboveAny)
{
  auto             frame = without_dampers(Lattice());
  const auto       modes = dense_modes(frame.C, frame.M);
  fem::ModalRatios one   = 0.03, list, table;
  list.by_mode           = {0.01, 0.03, 0.02};
  const double low = modes.omega(2) / (2. * M_PI), high = modes.omega(8) / (2. * M_PI);
  table.by_frequency = {{low, 0.01}, {high, 0.04}};
  for (const fem::ModalRatios *ratios : {&one, &list, &table})
  {
    frame.modal_damping_ratio = *ratios;
    coupling::add_modal_damping(frame, 15);
    for (int j = 0; j < 16; ++j)
    {
      const VectorXd z        = frame.modal_damping.Z.transpose() * modes.V.col(j);
      const double   hz       = modes.omega(j) / (2. * M_PI);
      const double   share    = std::clamp((hz - low) / (high - low), 0., 1.);
      const double   expected = j == 15           ? 0. // orthogonality
                                : ratios == &one  ? 0.03
                                : ratios == &list ? list.by_mode[std::min(j, 2)]
                                                  : 0.01 + 0.03 * share;
      EXPECT_NEAR(z.dot(frame.modal_damping.d.asDiagonal() * z) / (2. * modes.omega(j)), expected, 1e-10)
          << "mode " << j;
    }
  }
}

TEST(ModalDamping, ReachesModesThatAreRepeatedMoreOftenThanTheSearchHasColumns)
{
  // Twenty chains of forty masses, fastened at both ends and to nothing else: every frequency comes twenty times,
  // omega_1 = 2 sin(pi / 82).
  constexpr int                       chains = 20, masses = 40, n = chains * masses;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, 2.);
    if (i % masses > 0)
    {
      entries.emplace_back(i, i - 1, -1.);
      entries.emplace_back(i - 1, i, -1.);
    }
  }
  fem::FrameMatrices frame;
  frame.M.resize(n, n);
  frame.M.setIdentity();
  frame.B.resize(n, n);
  frame.C.resize(n, n);
  frame.C.setFromTriplets(entries.begin(), entries.end());
  frame.modal_damping_ratio = 0.02;
  coupling::add_modal_damping(frame, chains);
  ASSERT_EQ(frame.modal_damping.d.size(), chains);
  for (int j = 0; j < chains; ++j)
    EXPECT_NEAR(frame.modal_damping.d(j), 0.04 * 2. * std::sin(M_PI / 82.), 1e-12) << j;
}

TEST(ModalDamping, CountsTheModesOfAFloatingFrameFromTheFirstElasticOne)
{
  fem::ModalRatios ratios;
  ratios.by_mode   = {0.1, 0.2};
  const VectorXd d = ratios.modal_dampers((VectorXd(5) << 0., 0., 3., 5., 7.).finished());
  EXPECT_LT((d - (VectorXd(5) << 0., 0., 0.6, 2., 2.8).finished()).norm(), 1e-15);
  EXPECT_EQ(fem::ModalRatios(0.02).text(), "2 % of critical in every mode of the frame");
  EXPECT_FALSE(fem::ModalRatios().any());
}

TEST(ModalDamping, ForTheSameModesIsTheSameOperatorInTheFullAndInTheReducedModel)
{
  auto      frame           = without_dampers(Lattice());
  const int n2              = int(frame.M.rows() - frame.interface_coordinates().size());
  frame.modal_damping_ratio = 0.02;
  const auto reduced        = reduce_frame(frame, with_modes(n2)); // all modes: T is a change of coordinates
  const auto basis          = test::basis_with_modes(frame, n2);
  coupling::add_modal_damping(frame, int(frame.M.rows()));
  const auto    &damping = frame.modal_damping;
  const MatrixXd TZ      = basis.T.transpose() * damping.Z;
  const MatrixXd B       = TZ * damping.d.asDiagonal() * TZ.transpose();
  EXPECT_LT((B - reduced.B).norm(), 1e-9 * B.norm());
}

TEST(ModalDamping, OfTheReducedModelIsTheRatioWithinTheErrorOfItsModes)
{
  auto frame                = without_dampers(Lattice());
  frame.modal_damping_ratio = 0.02;
  const auto reduced        = reduce_frame(frame, with_modes(40));
  const auto lines          = coupling::DenseBase(reduced.M, reduced.B, reduced.C, {}).spectrum();
  ASSERT_EQ(reduced.frequency_error.size(), Eigen::Index(lines.size()));
  // a mode with frequency error e meets its refined self up to an angle of the order of sqrt(2 e)
  for (int j = 0; j < 12; ++j)
    EXPECT_NEAR(lines[j].zeta, 0.02, 0.02 * (1e-9 + 4. * reduced.frequency_error(j))) << "mode " << j;
}

TEST(ModalDamping, LeavesRigidMotionsOfAFloatingFrameAlone)
{
  Lattice lattice;
  lattice.foundation        = 0.;
  auto frame                = without_dampers(lattice);
  frame.modal_damping_ratio = 0.05;
  const auto reduced        = reduce_frame(frame, with_modes(20));
  const auto R              = test::basis_with_modes(frame, 20).T.householderQr().solve(frame.rigid_motions).eval();
  EXPECT_LT((R.transpose() * reduced.B * R).norm(), 1e-12 * reduced.B.norm() * R.squaredNorm());
  EXPECT_LT((R.transpose() * reduced.C * R).norm(), 1e-12 * reduced.C.norm() * R.squaredNorm());
  EXPECT_EQ(reduced.frequencies_hz.head(6).norm(), 0.);
  EXPECT_GT(reduced.frequencies_hz(6), 1.);
}

TEST(ErrorEstimate, GivesRefinedFrequenciesBetweenThoseOfTheFullFrameAndTheReducedOnes)
{
  const auto             frame   = frame_of(Lattice());
  const VectorXd         exact   = dense_modes(frame.C, frame.M).omega / (2. * M_PI);
  const auto             reduced = reduce_frame(frame, with_modes(12));
  coupling::MachineModel model;
  model.set_frame(reduced);
  coupling::Machine machine(std::move(model));
  const auto        modes = coupling::frame_modes(machine, 100);
  for (int j = 0; j < 10; ++j)
  {
    EXPECT_GE(modes[j].refined_hz, exact(j) * (1. - 1e-10));
    EXPECT_LE(modes[j].refined_hz - exact(j), 0.5 * (modes[j].frequency_hz - exact(j)) + 1e-10 * exact(j));
  }
}

TEST(AutomaticNumber, KeepsTheFirstTwelveFrequenciesWithinTheToleranceWithTheFewestModes)
{
  const auto                 frame = frame_of(Lattice());
  const VectorXd             exact = dense_modes(frame.C, frame.M).omega / (2. * M_PI);
  coupling::ReductionOptions options;
  int                        previous = 0;
  for (const double tolerance : {0.05, 0.005, 0.0005})
  {
    options.tolerance  = tolerance;
    const auto reduced = reduce_frame(frame, options);
    const int  m       = int(reduced.omega0.size());
    const auto worst   = [&](const VectorXd &found)
    { return (found.head(12) - exact.head(12)).cwiseQuotient(exact.head(12)).maxCoeff(); };
    EXPECT_LE(worst(reduced.frequencies_hz), 1.1 * tolerance); // the estimate is no bound, but close
    EXPECT_GE(worst(reduce_frame(frame, with_modes(m - 1)).frequencies_hz), 0.9 * tolerance) << m;
    EXPECT_GE(m, previous);
    EXPECT_TRUE(reduced.notes.empty());
    previous = m;
  }
}

TEST(AutomaticNumber, ReportsWhereItStopsShort)
{
  coupling::ReductionOptions options;
  options.frequency = 400.; // more than 200 modes lie below 1.5 times as much
  Lattice lattice;
  lattice.nx = 9, lattice.ny = 5, lattice.nz = 9;
  const auto reduced = reduce_frame(frame_of(lattice), options);
  ASSERT_EQ(reduced.notes.size(), 1u);
  EXPECT_NE(reduced.notes[0].find("above the tolerance"), std::string::npos) << reduced.notes[0];
  ASSERT_EQ(reduced.statements.size(), 1u) << "that no mode is missing is no warning";
  EXPECT_NE(reduced.statements[0].find("all of them are found"), std::string::npos) << reduced.statements[0];
}

} // namespace
} // namespace gestell
