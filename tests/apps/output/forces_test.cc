// Forces in ParaView's files keep every body in equilibrium with its weight and its inertia (d'Alembert).

#include "apps/output/paraview/force_files.h"
#include "apps/output/pictures/chosen_pictures.h"
#include "apps/session/forces/acting_forces.h"
#include "apps/session/session.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <Eigen/Geometry>

namespace gestell::tests
{
namespace
{

namespace fs = std::filesystem;
using apps::OwnFolder;
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

/// Rate of coordinate i by the parabola through the velocities of neighbouring pictures.
double acceleration(const Result &result, std::size_t k, int i)
{
  const auto  &t      = result.run->picture_times;
  const auto  &v      = result.run->picture_velocities;
  const double before = t[k] - t[k - 1], after = t[k + 1] - t[k];
  return ((v[k][i] - v[k - 1][i]) / before * after + (v[k + 1][i] - v[k][i]) / after * before) / (before + after);
}

/// Pictures between which quotients tell accelerations: no event among them, which makes them jump, and alike far
/// apart, for quotients over a small part of a step tell the error of its dense output.
std::vector<std::size_t> smooth_pictures(const Result &result)
{
  const auto              &t = result.run->picture_times;
  std::vector<std::size_t> smooth;
  for (std::size_t k = 1; k + 1 < t.size(); ++k)
  {
    const double before = t[k] - t[k - 1], after = t[k + 1] - t[k];
    const auto  &events = result.run->events;
    if (before < 1.05 * after && after < 1.05 * before &&
        std::none_of(events.begin(), events.end(),
                     [&](const coupling::Event &event) { return event.t >= t[k - 1] && event.t <= t[k + 1]; }))
      smooth.push_back(k);
  }
  return smooth;
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
  OwnFolder                own(folder);
  write_force_files(own, result, chosen_pictures(result, result.run->picture_times.size()), files);
  ASSERT_GT(files.size(), 10u);
  ASSERT_EQ(files.size(), result.run->picture_times.size() + 1); // and forces.pvd
  const auto  smooth = smooth_pictures(result);
  const auto &scene  = session.scene();
  const auto &model  = session.machine().machine.model();
  int         seen   = 0;
  ASSERT_GT(smooth.size(), 10u);
  for (const apps::BodyRequest &request : scene.bodies)
  {
    const coupling::Body &body = model.body(request.name);
    if (body.kind == coupling::BodyKind::rotor)
      continue;
    const Eigen::Map<const Vector3d> g(scene.gravity.data());
    double                           largest = request.mass * g.norm(), worst = 0., worst_torque = 0.;
    for (const std::size_t k : smooth)
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

/// Of the files of a run that holds the whole press on its frame of two masses, up to the break of its sheet.
class ForcesOnTheFrame : public ForcesOnBodies
{
};

/// What the frame's own masses, springs and dampers ask for at coordinate i beside its weight.
double asked_of_frame(const apps::Scene &scene, const Result &result, std::size_t k, int i)
{
  const fem::FrameMatrices        &frame = scene.frame.matrices;
  const Eigen::Map<const Vector3d> g(scene.gravity.data());
  double                           sum = -frame.M.row(i).dot((frame.translations * g).eval());
  for (int j = 0; j < int(frame.M.rows()); ++j)
    sum += frame.M.coeff(i, j) * acceleration(result, k, j) +
           frame.B.coeff(i, j) * result.run->picture_velocities[k][j] +
           frame.C.coeff(i, j) * result.run->picture_states[k][j];
  return sum;
}

// The rod pushes the crown that bears the crank, not the crank; only then do all forces on an interface make what the
// frame answers with.
TEST_P(ForcesOnTheFrame, AreWhatItsMassesSpringsAndDampersAnswer)
{
  const Given             &given = GetParam();
  Session                  session(shipped(given.scene + ".toml"), given.overrides);
  const Result             result = session.run();
  std::vector<std::string> files;
  OwnFolder                own(folder);
  write_force_files(own, result, chosen_pictures(result, result.run->picture_times.size()), files);
  const auto  smooth = smooth_pictures(result);
  const auto &scene  = session.scene();
  for (const char *name : {"frame.crown", "frame.table"})
  {
    double largest = 0., worst = 0.;
    for (const std::size_t k : smooth)
    {
      const Sum sum = sum_on(name, files[k]);
      const int i   = std::string(name) == "frame.crown" ? 0 : 1; // downwards
      largest       = std::max(largest, sum.largest);
      worst         = std::max(worst, std::abs(-sum.force.z() - asked_of_frame(scene, result, k, i)));
    }
    EXPECT_GT(largest, 5e5) << name;
    EXPECT_LT(worst, given.exact * largest) << name;
  }
  EXPECT_EQ(sum_on("crank", files.back() == "forces.pvd" ? files[files.size() - 2] : files.back()).force.norm(), 0.);
}

TEST(ForcesOnTheGround, StandThereWhereItIsThePartner)
{
  const apps::Scene scene =
      apps::read_scene(shipped("press_minimal.toml"), {"element.guide.to=ground", "element.sheet.to=ground"});
  coupling::Machine machine = apps::build_machine(scene);
  const auto        forces  = apps::forces_in_space(scene, machine);
  Eigen::VectorXd   q = Eigen::VectorXd::Zero(machine.size()), v = q,
                  p = Eigen::VectorXd::Ones(machine.forces().directions().cols());
  for (Eigen::Index i = 0; i < p.size(); ++i)
    p[i] = double(i + 1);
  std::map<std::string, Vector3d> rest;
  std::map<std::string, int>      on_ground;
  for (const apps::ActingForce &force : forces(0., q, v, p))
  {
    rest.try_emplace(force.name, Vector3d::Zero()).first->second += force.force;
    on_ground[force.name] += force.body == "ground";
  }
  for (const auto &[element, sum] : rest)
    EXPECT_LT(sum.norm(), 1e-12 * p.norm()) << element;
  EXPECT_EQ(on_ground["sheet"], 1);
  EXPECT_EQ(on_ground["guide"], 1);
  EXPECT_EQ(on_ground["motor"], 1); // its torque
  EXPECT_EQ(on_ground["rod"], 0);
}

// A place on a crank that a frame bears: its bearing passes the force on.
TEST(ForcesOnARotor, ComeToTheFrameThroughItsBearing)
{
  const apps::Scene scene =
      apps::read_scene(shipped("press_minimal.toml"),
                       {"element.tie={ type = \"spring-damper\", from = \"crank\", to = \"ground\", at_from = [0, 0, "
                        "\"2.7 m\"], at_to = [1, 0, 2], direction = [1, 0, 0], stiffness = \"1 N/mm\" }"});
  coupling::Machine machine = apps::build_machine(scene);
  const auto        forces  = apps::forces_in_space(scene, machine);
  Eigen::VectorXd   q = Eigen::VectorXd::Zero(machine.size()), v = q,
                  p = Eigen::VectorXd::Ones(machine.forces().directions().cols());
  Vector3d on_crank = Vector3d::Zero(), on_crown = Vector3d::Zero(), on_ground = Vector3d::Zero();
  for (const apps::ActingForce &force : forces(0., q, v, p))
    if (force.name == "tie")
      (force.body == "crank" ? on_crank : force.body == "frame.crown" ? on_crown : on_ground) += force.force;
  EXPECT_EQ(on_crank.norm(), 0.);
  EXPECT_GT(on_ground.norm(), 0.);
  EXPECT_LT((on_crown + on_ground).norm(), 1e-12 * on_ground.norm());
}

// Sampled every 0.1 ms: the press's highest mode, 206 Hz, makes (omega h)^2/6 = 3e-3 of what it carries, less than a
// half.
INSTANTIATE_TEST_SUITE_P(Scenes, ForcesOnTheFrame,
                         ::testing::Values(Given{"press_minimal", {"run.end=0.228", "output.picture_step=1e-4"}, 2e-3}),
                         [](const auto &info) { return info.param.scene; });

} // namespace
} // namespace gestell::tests
