#include "fem/mesh/mesh_nodes.h"

#include "fem/values/vector3.h"
#include "tests/support/test.h"

#include <ctime>
#include <random>

using namespace gestell::fem;

namespace
{

/// Points of a plane at right angles to axis d, in rows and columns as meshers set them.
std::vector<Point3> plane_of(int d, int n)
{
  std::vector<Point3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      Point3 p{};
      p[(d + 1) % 3] = 0.01 * i;
      p[(d + 2) % 3] = 0.01 * j;
      points.push_back(p);
    }
  return points;
}

TEST(Coincident, FindsThePointsThatComparingAllFinds)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> place(-1., 1.), shift(-1., 1.);
  constexpr double                       gap = 1e-3;
  std::vector<Point3>                    points;
  for (int i = 0; i < 600; ++i)
  {
    points.push_back({i % 3 == 0 ? 0.5 : place(random), place(random), place(random)}); // a third in one plane
    const Vector3 towards = {shift(random), shift(random), shift(random)};
    if (i % 4 == 0) // some beside, closer than the gap or as close
      points.push_back(points.back() + (i % 8 == 0 ? 0.999 : 0.3) * gap / norm(towards) * towards);
    if (i % 50 == 0) // some upon each other
      points.push_back(points.back());
  }
  std::set<int> near; // points that have another within the gap
  for (int i = 0; i < int(points.size()); ++i)
    for (int j = 0; j < i; ++j)
      if (norm(points[i] - points[j]) <= gap)
        near.insert({i, j});
  std::set<int> found;
  for (const auto &[first, second] : coincident(points, gap))
  {
    EXPECT_LE(norm(points[first] - points[second]), gap);
    found.insert({first, second});
  }
  EXPECT_GT(near.size(), 300u);
  EXPECT_EQ(found, near);
}

/// 90 000 points in a plane: all pairs of them would be 4e9, half a minute; sorted they are passed in milliseconds.
TEST(Coincident, LooksAtPlanesOfPointsInNoMoreTimeThanAtOthers)
{
  for (int d = 0; d < 3; ++d)
  {
    auto points = plane_of(d, 300);
    points.push_back(points[4321]);
    const std::clock_t begin = std::clock();
    EXPECT_EQ(coincident(points, 1e-6).size(), 1u);
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 2.) << "plane at right angles to axis " << d;
  }
}

} // namespace
