#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/mode_ratios.h"
#include "coupling/reduction/reduce_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/newmark/newmark.h"
#include "coupling/modes/modes.h"
#include "coupling/reduction/dense_frame.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "fem/values/two_pi.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell
{
namespace
{

using coupling::dense_frame;
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

/// Ratios of the roots of s^2 + s (B + diag(d)) + diag(omega^2).
VectorXd ratios_of_roots(const VectorXd &omega, const MatrixXd &damping)
{
  const Eigen::Index n = omega.size();
  MatrixXd           A = MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n)  = -MatrixXd(omega.cwiseAbs2().asDiagonal());
  A.bottomRightCorner(n, n) = -damping;
  const Eigen::VectorXcd s  = Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
  return (-s.real().array() / s.array().abs()).matrix();
}

/// Close modes that dampers couple: the roots have the ratios, or there is an error.
TEST(ModalDamping, OfNamedModesIsExactOrRefusedWhereDampersCoupleCloseModes)
{
  std::srand(6);
  int solved = 0, rounds = 300;
  for (int round = 0; round < rounds; ++round)
  {
    const int n     = 2 + round % 4;
    VectorXd  omega = 100. + 4. * VectorXd::Random(n).array();
    std::sort(omega.begin(), omega.end());
    const MatrixXd   g = 1.5 * MatrixXd::Random(n, 1 + round % 2), B = g * g.transpose();
    fem::ModalRatios ratios = 0.02;
    for (int j = 0; j < n; j += 1 + round % 3 / 2)
      ratios.named.push_back({0.03 + 0.004 * (round % 5 ? j : 0), j});
    try
    {
      const VectorXd d     = coupling::modal_dampers(ratios, omega, B);
      const VectorXd roots = ratios_of_roots(omega, B + MatrixXd(d.asDiagonal()));
      for (const fem::NamedRatio &one : ratios.named)
      {
        const auto asked = std::count_if(ratios.named.begin(), ratios.named.end(),
                                         [&](const fem::NamedRatio &other) { return other.ratio == one.ratio; });
        EXPECT_GE(((roots.array() - one.ratio).abs() < 1e-9).count(), 2 * asked) // roots come in pairs
            << "round " << round << ", mode " << one.mode;
      }
      ++solved;
    }
    catch (const std::invalid_argument &)
    {
    }
  }
  EXPECT_GT(solved, rounds / 2);
}

TEST(ModalDamping, GivesEachModeOfTheFullFrameItsRatioAndNoneAboveAny)
{
  auto             frame = without_dampers(Lattice());
  const auto       modes = dense_modes(frame.C, frame.M);
  fem::ModalRatios one   = 0.03, list, table;
  list                   = 0.02;
  list.named             = {{0.01, 0}, {0.03, 1}};
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
                                : ratios == &list ? list.at(j, 0.)
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
  ratios.constant  = 0.2;
  ratios.named     = {{0.1, 0}};
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

/// As `gestell modes` prints them.
std::vector<coupling::Mode> modes_of(const coupling::ReducedFrame &frame, int n)
{
  coupling::MachineModel model;
  model.set_frame(frame);
  return coupling::frame_modes(coupling::Machine(std::move(model)), n);
}

/// Ratios by number, by interval, of a measured mode and of the rest, of a frame with these frequencies.
fem::ModalRatios ratios_of_all_kinds(const VectorXd &omega)
{
  const auto       hz     = [&](int j) { return omega[j] / (2. * M_PI); };
  fem::ModalRatios ratios = 0.03;
  ratios.named.push_back({0.012, 1});
  ratios.named.push_back({0.02, -1, 0.5 * (hz(2) + hz(3)), 0.5 * (hz(5) + hz(6))});
  ratios.named.push_back({0.007, 4});
  ratios.named.push_back({0.001, -1, 1.001 * hz(8), 1.001 * hz(8)});
  return ratios;
}

TEST(ModalDamping, IsGivenBackByTheModesOfTheReducedAndOfTheSmallFrameInAnyCoordinates)
{
  constexpr double expected[] = {0.03, 0.012, 0.03, 0.02, 0.007, 0.02, 0.03, 0.03, 0.001, 0.03};
  const auto       check      = [&](const coupling::ReducedFrame &frame, const std::string &what)
  {
    const auto modes = modes_of(frame, 10);
    for (int j = 0; j < 10; ++j)
      EXPECT_NEAR(modes[j].damping_ratio, expected[j], 1e-9 * expected[j]) << what << ", mode " << j + 1;
  };
  auto frame                = without_dampers(Lattice());
  frame.modal_damping_ratio = ratios_of_all_kinds(dense_modes(frame.C, frame.M).omega);
  check(reduce_frame(frame, with_modes(20)), "reduced");

  Lattice small;
  small.nx = 4, small.nz = 3;
  frame                     = without_dampers(small);
  frame.modal_damping_ratio = ratios_of_all_kinds(dense_modes(frame.C, frame.M).omega);
  check(dense_frame(frame), "dense");
  // In millimetres, and turned about an axis of no symmetry: x = T y.
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., 3.).normalized()));
  const auto            n = frame.M.rows();
  MatrixXd              T = MatrixXd::Zero(n, n);
  for (Eigen::Index p = 0; p < n; p += 3)
    T.block<3, 3>(p, p) = 1e-3 * turn;
  for (fem::SparseMatrix *A : {&frame.M, &frame.C})
    *A = MatrixXd(T.transpose() * MatrixXd(*A) * T).sparseView();
  frame.picture.displacement = MatrixXd(frame.picture.displacement * T).sparseView();
  check(dense_frame(frame), "in other coordinates");
}

TEST(ModalDamping, OfSingleModesContainsWhatDampersOfTheFrameDo)
{
  Lattice small;
  small.nx = 4, small.nz = 3;
  for (const Lattice &lattice : {Lattice(), small})
  {
    auto       frame   = frame_of(lattice);
    const auto reduced = [&]
    { return lattice.nx == small.nx ? dense_frame(frame) : reduce_frame(frame, with_modes(20)); };
    const auto alone = modes_of(reduced(), 10);
    const auto hz    = [&](int j) { return alone[std::size_t(j)].frequency_hz; };
    const auto more  = [&](int j) { return alone[std::size_t(j)].damping_ratio + 0.01 * (1 + j % 3); };
    ASSERT_GT(alone[2].damping_ratio, 0.002) << "or there is nothing to contain";
    fem::ModalRatios ratios   = 0.03;
    ratios.named              = {{more(1), 1},
                                 {more(2), 2},
                                 {more(4), -1, 0.5 * (hz(3) + hz(4)), 0.5 * (hz(4) + hz(5))},
                                 {more(8), -1, 1.001 * hz(8), 1.001 * hz(8)}};
    frame.modal_damping_ratio = ratios;
    const auto modes          = modes_of(reduced(), 10);
    for (const int j : {1, 2, 4, 8})
      EXPECT_NEAR(modes[std::size_t(j)].damping_ratio, more(j), 1e-9 * more(j)) << "mode " << j + 1;
    for (const int j : {0, 3, 5})
      EXPECT_NEAR(modes[std::size_t(j)].damping_ratio, alone[std::size_t(j)].damping_ratio + 0.03, 3e-3)
          << "beside them, but for the coupling of modes: " << j + 1;

    frame.modal_damping_ratio.named          = {{0.5 * alone[2].damping_ratio, 2}};
    frame.modal_damping_ratio.named[0].place = "there";
    tests::expect_refusal(reduced, "there: mode 3 of the frame, ");
    tests::expect_refusal(reduced, ", but the dampers of the frame alone give it ");
  }
}

TEST(ModalDamping, OfEveryModeByItsNumberIsThatOfOneRatio)
{
  auto frame                = without_dampers(Lattice());
  frame.modal_damping_ratio = 0.02;
  const auto       one      = reduce_frame(frame, with_modes(20));
  fem::ModalRatios each     = 0.5;
  for (int j = 0; j < one.M.rows(); ++j)
    each.named.push_back({0.02, j});
  frame.modal_damping_ratio = each;
  EXPECT_LT((reduce_frame(frame, with_modes(20)).B - one.B).norm(), 1e-14 * one.B.norm());
}

/// A mode as measured at every third point, in x and z, with some phase.
fem::NamedRatio measured(const fem::FrameMatrices &frame, const VectorXd &shape, double hz, double ratio)
{
  fem::NamedRatio mode{ratio, -1, hz, hz};
  mode.shape = Eigen::VectorXcd::Zero(3 * Eigen::Index((frame.picture.points.size() + 2) / 3));
  for (std::size_t p = 0; p < frame.picture.points.size(); p += 3)
  {
    const Eigen::Index to = 3 * Eigen::Index(mode.points.size()), from = 3 * Eigen::Index(p);
    mode.points.push_back(frame.picture.points[p]);
    for (const int d : {0, 2})
      mode.shape[to + d] = std::polar(1., 0.4) * shape[from + d];
  }
  return mode;
}

TEST(ModalDamping, MeasuredShapesGoToTheModesThatLookAlike)
{
  auto       frame          = without_dampers(Lattice());
  const auto exact          = dense_modes(frame.C, frame.M);
  const auto hz             = [&](int j) { return exact.omega[j] / (2. * M_PI); };
  frame.modal_damping_ratio = 0.05;
  // Frequencies exchanged, as of a frame that is not quite the model: shapes decide.
  frame.modal_damping_ratio.named = {measured(frame, exact.V.col(2), hz(3), 0.01),
                                     measured(frame, exact.V.col(3), hz(2), 0.02)};
  const auto reduced              = reduce_frame(frame, with_modes(20));
  const auto modes                = modes_of(reduced, 5);
  EXPECT_NEAR(modes[2].damping_ratio, 0.01, 1e-11);
  EXPECT_NEAR(modes[3].damping_ratio, 0.02, 1e-11);
  EXPECT_NEAR(modes[4].damping_ratio, 0.05, 1e-11);
  const auto &said = reduced.statements;
  EXPECT_TRUE(std::any_of(said.begin(), said.end(),
                          [](const std::string &line)
                          {
                            return line.find("is mode 3, ") != std::string::npos &&
                                   line.find(", MAC 1 of the frame, ratio 1 %") != std::string::npos;
                          }));
}

TEST(ModalDamping, RefusesRatiosOfModesThatTheFrameDoesNotHave)
{
  auto       frame   = without_dampers(Lattice());
  const auto exact   = dense_modes(frame.C, frame.M);
  const auto hz      = [&](int j) { return exact.omega[j] / (2. * M_PI); };
  const auto refused = [&](std::vector<fem::NamedRatio> named, const std::string &words)
  {
    named.back().place              = "there";
    frame.modal_damping_ratio.named = std::move(named);
    tests::expect_refusal([&] { reduce_frame(frame, with_modes(20)); }, words);
  };
  refused({{0.01, 32}}, "there: is of mode 33, but the model of the frame has 32 elastic modes");
  refused({{0.01, -1, 0.1, 0.2}}, "no elastic mode of the frame has a frequency from 0.1 to 0.2 Hz");
  refused({{0.01, -1, 0.1, 0.1}},
          "the measured mode of 0.1 Hz matches no mode of the frame: no elastic mode is within 30 % of it");
  refused({{0.01, 0}, {0.02, -1, hz(0), hz(0)}}, "mode 1 has two ratios, 1 % and 2 %");
  refused({measured(frame, VectorXd::Random(frame.M.rows()), hz(2), 0.01)}, "a MAC of 0.5 is needed; candidates: mode");
}

TEST(ModalDamping, MakesTheEnergyOfAFreeVibrationFallWithItsRatio)
{
  auto frame                = without_dampers(Lattice());
  frame.modal_damping_ratio = 0.05;
  frame.modal_damping_ratio.named.push_back({0.012, 2});
  const auto             reduced = reduce_frame(frame, with_modes(20));
  const coupling::Mode   mode    = modes_of(reduced, 3)[2];
  coupling::MachineModel model;
  model.set_frame(reduced);
  const coupling::Machine    machine(std::move(model));
  coupling::Newmark::Options options;
  options.step = 1. / (200. * mode.damped_frequency_hz);
  coupling::Newmark newmark(machine, options);
  newmark.begin(0., mode.shape, VectorXd::Zero(mode.shape.size()));
  for (int i = 0; i < 10 * 200; ++i)
    newmark.advance();
  const auto  &end    = newmark.instant();
  const double energy = end.v.dot(reduced.M * end.v) + end.q.dot(reduced.C * end.q);
  const double begin  = mode.shape.dot(reduced.C * mode.shape);
  // the average acceleration does not damp; its period is longer by (omega h)^2/12 = 8e-5, so that the energy, which
  // waves by the share zeta within a period, is that of a phase 5e-3 off
  EXPECT_NEAR(std::log(begin / energy) / (2. * two_pi * mode.frequency_hz * end.t), 0.012, 0.012 * 3e-4);
}

TEST(ModalDamping, LeavesRigidMotionsOfAFloatingFrameAlone)
{
  Lattice lattice;
  lattice.foundation        = 0.;
  auto frame                = without_dampers(lattice);
  frame.modal_damping_ratio = 0.05;
  frame.modal_damping_ratio.named.push_back({0.01, 1}); // the second elastic mode
  const auto reduced = reduce_frame(frame, with_modes(20));
  const auto R       = test::basis_with_modes(frame, 20).T.householderQr().solve(frame.rigid_motions).eval();
  EXPECT_LT((R.transpose() * reduced.B * R).norm(), 1e-12 * reduced.B.norm() * R.squaredNorm());
  EXPECT_LT((R.transpose() * reduced.C * R).norm(), 1e-12 * reduced.C.norm() * R.squaredNorm());
  EXPECT_EQ(reduced.frequencies_hz.head(6).norm(), 0.);
  EXPECT_GT(reduced.frequencies_hz(6), 1.);
  const auto modes = modes_of(reduced, 9);
  EXPECT_NEAR(modes[6].damping_ratio, 0.05, 1e-10);
  EXPECT_NEAR(modes[7].damping_ratio, 0.01, 1e-10);
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
