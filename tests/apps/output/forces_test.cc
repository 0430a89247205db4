// Forces in ParaView's files keep every body in equilibrium with its weight and its inertia (d'Alembert).

#include "apps/output/paraview/force_files.h"
#include "apps/session/session.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <Eigen/Geometry>

#include <filesystem>

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;
using apps::Result;
using apps::Session;
using Eigen::Vector3d;

struct Given
{
  std::string              scene;
  std::vector<std::string> overrides;
  double                   exact; ///< of the largest force on the body
};

/// Force and torque about the origin.
struct Sum
{
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  double   largest = 0.;
};

class ForcesOnBodies : public ::testing::TestWithParam<Given>
{
protected:
  void SetUp() override
  {
    folder = fs::path(GESTELL_BINARY_DIR) / "test-output" / ("forces-" + GetParam().scene);
    fs::remove_all(folder);
    fs::create_directories(folder / "forces");
  }
  void TearDown() override { fs::remove_all(folder); }

  Vector3d vector(const char *name, vtkIdType i) const
  {
    double x[3];
    reader->GetOutput()->GetPointData()->GetArray(name)->GetTuple(i, x);
    return {x[0], x[1], x[2]};
  }

  /// What the file of picture k says about a body.
  Sum sum_on(const std::string &body, const std::string &file)
  {
    reader->SetFileName((folder / file).c_str());
    reader->Update();
    vtkPolyData *data   = reader->GetOutput();
    auto        *bodies = vtkStringArray::SafeDownCast(data->GetPointData()->GetAbstractArray("body"));
    Sum          sum;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
      if (bodies->GetValue(i) == body)
      {
        const double  *at    = data->GetPoint(i);
        const Vector3d place = Vector3d(at[0], at[1], at[2]) + vector("displacement [m]", i);
        const Vector3d force = vector("force [N]", i);
        sum.force += force;
        sum.torque += vector("torque [N m]", i) + place.cross(force);
        sum.largest = std::max(sum.largest, force.norm());
      }
    return sum;
  }

  fs::path                     folder;
  vtkNew<vtkXMLPolyDataReader> reader;
};

/// Rate of coordinate i by central differences of the velocities of neighbouring pictures.
double acceleration(const Result &result, std::size_t k, int i)
{
  const auto &t = result.run->picture_times;
  const auto &v = result.run->picture_velocities;
  return (v[k + 1][i] - v[k - 1][i]) / (t[k + 1] - t[k - 1]);
}

Vector3d acceleration(const Result &result, std::size_t k, const std::array<coupling::Measure, 3> &translation)
{
  Vector3d a = Vector3d::Zero();
  for (int d = 0; d < 3; ++d)
    for (const auto &[i, weight] : translation[d])
      a[d] += weight * acceleration(result, k, i);
  return a;
}

/// Directions in which a body moves by coordinates of its own.
Eigen::Matrix3d free_directions(const coupling::Body &body)
{
  const Eigen::Map<const Vector3d> axis(body.axis.data());
  const Eigen::Matrix3d            along = axis * axis.transpose();
  return body.kind == coupling::BodyKind::slider   ? along
         : body.kind == coupling::BodyKind::planar ? Eigen::Matrix3d(Eigen::Matrix3d::Identity() - along)
                                                   : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

TEST_P(ForcesOnBodies, WithWeightAreMassTimesAcceleration)
{
  const Given             &given = GetParam();
  Session                  session(shipped(given.scene + ".toml"), given.overrides);
  const Result             result = session.run();
  std::vector<std::string> files;
  write_force_files(folder, result, files);
  ASSERT_GT(files.size(), 10u);
  ASSERT_EQ(files.size(), result.run->picture_times.size() + 1); // and forces.pvd
  const auto &scene = session.scene();
  const auto &model = session.machine().machine.model();
  int         seen  = 0;
  for (const apps::BodyRequest &request : scene.bodies)
  {
    const coupling::Body &body = model.body(request.name);
    if (body.kind == coupling::BodyKind::rotor)
      continue;
    const Eigen::Map<const Vector3d> g(scene.gravity.data());
    double                           largest = request.mass * g.norm(), worst = 0., worst_torque = 0.;
    for (std::size_t k = 1; k + 1 < result.run->picture_times.size(); ++k)
    {
      const Sum      sum  = sum_on(request.name, files[k]);
      const Vector3d a    = acceleration(result, k, body.marker.translation);
      const Vector3d left = free_directions(body) * (sum.force + request.mass * (g - a));
      largest             = std::max(largest, sum.largest);
      worst               = std::max(worst, left.norm());
      if (body.kind != coupling::BodyKind::planar)
        continue;
      Vector3d c = Eigen::Map<const Vector3d>(body.centre.data());
      for (int d = 0; d < 3; ++d)
        c[d] += apps::value(body.marker.translation[d], result.run->picture_states[k]);
      const Vector3d about = sum.torque - c.cross(sum.force);
      worst_torque         = std::max(worst_torque, std::abs(about.dot(Eigen::Map<const Vector3d>(body.axis.data())) -
                                                             request.inertia * acceleration(result, k, body.coordinate + 2)));
    }
    EXPECT_LT(worst, given.exact * largest) << request.name;
    EXPECT_LT(worst_torque, given.exact * largest * result.scenery.size()) << request.name;
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

// Accelerations are quotients over two pictures, exact to (omega h)^2/6; files hold single precision, 6e-8 of a force.
INSTANTIATE_TEST_SUITE_P(
    Scenes, ForcesOnBodies,
    ::testing::Values(Given{"crank_press_joints", {"run.end=0.19", "output.picture_step=1e-3"}, 1e-4},
                      Given{"double_four_bar", {"run.end=0.1", "output.picture_step=5e-4"}, 1e-4},
                      Given{
                          "spatial_crank_rocker", {"run.end=0.03", "run.step=5e-5", "output.picture_step=1e-4"}, 1e-3},
                      Given{"crane_minimal", {"run.end=1.0", "output.picture_step=1e-2"}, 1e-3}),
    [](const auto &info) { return info.param.scene; });

} // namespace
} // namespace gestell::tests
