#include "coupling/reduction/reduce_frame.h"

#include "tests/support/lattice.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::reduce_frame;
using test::frame_of;
using test::Lattice;

std::string message_of(const fem::FrameMatrices &frame, const coupling::ReductionOptions &options = {})
{
  return tests::refusal([&] { reduce_frame(frame, options); });
}

bool holds(const std::string &text, const std::string &words)
{
  return text.find(words) != std::string::npos;
}

fem::FrameMatrices floating(std::vector<fem::Interface> interfaces)
{
  Lattice lattice;
  lattice.foundation = 0.;
  auto frame         = frame_of(lattice);
  frame.interfaces   = std::move(interfaces);
  return frame;
}

TEST(FreeMotion, OfAFrameThatIsUnconstrainedIsNamedAsText)
{
  const std::string message = message_of(floating({}));
  for (const char *words : {"translation along x", "translation along y", "translation along z", "rotation about x",
                            "rotation about y", "rotation about z"})
    EXPECT_TRUE(holds(message, words)) << message;
}

TEST(FreeMotion, AroundTheLineThroughTwoHeldPointsIsARotation)
{
  const Lattice     lattice;
  const std::string message =
      message_of(floating({test::interface_at("hinge", lattice.point(0, 1, 2), lattice.point(4, 1, 2))}));
  EXPECT_TRUE(holds(message, "rotation about x through (")) << message; // both points lie on a line along x
  EXPECT_FALSE(holds(message, "translation along")) << message;
}

TEST(FreeMotion, IsFoundWithoutKnowingTheRigidMotions)
{
  auto frame          = floating({});
  frame.rigid_motions = {};
  frame.picture       = {};
  EXPECT_TRUE(holds(message_of(frame), "6 ways")) << message_of(frame);
}

TEST(FreeMotion, OfALoosePointIsNamedByItsPlace)
{
  auto      frame = frame_of(Lattice());
  const int loose = Lattice().point(2, 1, 4);
  for (auto *A : {&frame.C, &frame.M})
    A->prune([&](int i, int j, double) { return A == &frame.M || (i / 3 != loose && j / 3 != loose); });
  EXPECT_TRUE(holds(message_of(frame), "part 2 of ")) << message_of(frame);
  EXPECT_TRUE(holds(message_of(frame), "near (")) << message_of(frame);
}

TEST(FreeMotion, OfAPartOnTwoNodesThatTouchNothingElseIsNamedByItsPlace)
{
  auto                                frame = frame_of(Lattice());
  const int                           n     = int(frame.C.rows());
  std::vector<Eigen::Triplet<double>> C, M;
  for (int j = 0; j < n; ++j)
  {
    for (Eigen::SparseMatrix<double>::InnerIterator c(frame.C, j); c; ++c)
      C.emplace_back(c.row(), j, c.value());
    for (Eigen::SparseMatrix<double>::InnerIterator m(frame.M, j); m; ++m)
      M.emplace_back(m.row(), j, m.value());
  }
  for (const int i : {n, n + 1})
  {
    C.emplace_back(i, i, 1e7);
    M.emplace_back(i, i, 1.);
    C.emplace_back(i, 2 * n + 1 - i, -1e7); // joined with each other alone
  }
  fem::FrameMatrices loose;
  loose.interfaces = frame.interfaces;
  for (auto [A, entries] : {std::pair(&loose.C, &C), std::pair(&loose.M, &M)})
  {
    A->resize(n + 2, n + 2);
    A->setFromTriplets(entries->begin(), entries->end());
  }
  loose.B.resize(n + 2, n + 2);
  const std::string message = message_of(loose);
  EXPECT_TRUE(holds(message, "1 way")) << message;
  EXPECT_TRUE(holds(message, "DOF " + std::to_string(n)) || holds(message, "DOF " + std::to_string(n + 1)))
      << message; // both move alike
}

TEST(FreeMotion, ASoftSupportIsNone)
{
  Lattice lattice;
  lattice.foundation = 1e-2; // 1e-9 of the stiffness of a rod
  auto frame         = frame_of(lattice);
  frame.interfaces.clear();
  EXPECT_EQ(message_of(frame), "");
}

TEST(BadReduction, IsRefusedWithTheNumberNeeded)
{
  const auto                 frame = frame_of(Lattice());
  coupling::ReductionOptions options;
  options.place   = "press.toml:60: reduction";
  options.n_modes = 259;
  EXPECT_TRUE(holds(message_of(frame, options), "press.toml:60: reduction: 259 modes requested, but only 258"));
  options.n_modes   = -1;
  options.tolerance = 0.;
  EXPECT_TRUE(holds(message_of(frame, options), "tolerance"));
  options.tolerance = 0.01;
  options.frequency = -1.;
  EXPECT_TRUE(holds(message_of(frame, options), "frequency"));

  auto twice = frame;
  twice.interfaces.push_back(twice.interfaces[0]);
  EXPECT_TRUE(holds(message_of(twice), "share a DOF"));
  auto outside                        = frame;
  outside.interfaces[0].coordinate[0] = 1000;
  EXPECT_TRUE(holds(message_of(outside), "not in the frame"));
  auto sizes = frame;
  sizes.B.resize(3, 3);
  EXPECT_TRUE(holds(message_of(sizes), "3 x 3"));
}

} // namespace
} // namespace gestell
