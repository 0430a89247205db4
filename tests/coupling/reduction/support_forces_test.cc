// Forces of supports and through cuts of a reduced frame: Newton's law holds for every load, however few modes are
// kept.

#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/parts/parted_frame.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/box_mesh.h"
#include "tests/support/frame_folder.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseLU>

namespace gestell::test
{
namespace
{

using coupling::ReducedFrame;
using Eigen::MatrixXd;
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

class ForcesInParts : public FrameFolder
{
};

/// A^-1 b
VectorXd statics_of(const fem::SparseMatrix &A, const VectorXd &b)
{
  return Eigen::SparseLU<Eigen::SparseMatrix<double>>(A).solve(b);
}

struct Bar
{
  fem::Mesh               mesh;
  fem::FrameSpecification specification;
};

const std::array<double, 3> heights = {{0.25, 0.75, 1.25}}; // between cells

std::string plane_at(double height)
{
  return "at " + std::to_string(height);
}

/// Both bars with damping of every kind, and planes between cells.
std::vector<Bar> damped_bars()
{
  std::vector<Bar> bars;
  for (const fem::Support &feet :
       {clamped("feet", {"z0"}), foundation("feet", {"z0"}, {{2e8, 3e8, 4e8}}, {{3e5, 1e5, 2e5}})})
  {
    auto specification       = free_steel();
    specification.supports   = {feet};
    specification.interfaces = {interface("top", {"z1"}, fem::InterfaceCoupling::average)};
    for (const double z : heights)
      specification.cuts.push_back(
          {plane_at(z), {{0., 0., z}}, {{0., 0., 1.}}, "", {{1., 0., 0.}}, {{0.1, 0.05, 0.7}}});
    specification.rayleigh_mass       = 4.;
    specification.rayleigh_stiffness  = 1e-5;
    specification.modal_damping_ratio = 0.03;
    bars.push_back({box_mesh({{2, 2, 6}}, {{0.4, 0.3, 1.5}}), specification});
  }
  return bars;
}

coupling::ReducedModel model_of(const Bar &bar, const fem::FrameMatrices &frame, int modes, int n_parts)
{
  if (n_parts == 1)
    return coupling::reduce_with_basis(frame, with_modes(modes));
  const fem::Discretisation of = fem::discretise_for_parts(bar.mesh, bar.specification);
  return coupling::reduce_in_parts(of.matrices, of.mesh_error->parts(n_parts, ""), with_modes(modes),
                                   {bar.specification.rayleigh_mass, bar.specification.rayleigh_stiffness, ""});
}

/// A motion of a reduced frame that obeys its equations under forces at the interface.
struct Motion
{
  VectorXd p, v, a; // of (q1, modes)
  VectorXd braked;  ///< a, and the accelerations whose inertia is the damping from outside: alpha M v and ratios
  VectorXd force;   // [n1]
};

Motion random_motion(const ReducedFrame &frame, const MatrixXd &B_inside, const Vector3d &g)
{
  const auto n     = frame.M.rows();
  VectorXd   force = 1e4 * VectorXd::Random(n);
  force.tail(n - frame.n_interface).setZero();
  const auto M = frame.M.lu();
  Motion     motion{1e-4 * VectorXd::Random(n), 1e-1 * VectorXd::Random(n), {}, {}, force.head(frame.n_interface)};
  motion.a      = M.solve(force + frame.translations_load * g - frame.B * motion.v - frame.C * motion.p);
  motion.braked = motion.a + M.solve((frame.B - B_inside) * motion.v);
  return motion;
}

double force_of(const ReducedFrame &frame, const std::string &name, const Motion &motion, const Vector3d &g)
{
  const fem::FrameOutput &row = output_of(frame, name);
  return row.on_q.dot(motion.p) + row.on_v.dot(motion.v) + row.on_a.dot(motion.a) + row.under_acceleration.dot(g);
}

/// [n x 6] rigid motions N V1 V2 T M1 M2 of the coordinates above a plane, zero below.  The three coordinates of a
/// node follow each other.
MatrixXd motions_above(const fem::FrameMatrices &frame, double height)
{
  MatrixXd       R = frame.rigid_motions;
  const Vector3d centre(frame.centre.data()), about(0.1, 0.05, 0.7);
  const auto     top   = frame.interface_coordinates();
  bool           above = false;
  for (Eigen::Index i = 0; i < R.rows(); ++i)
  {
    if (R(i, 0) > 0.5)
      above = centre[2] + R(i, 4) > height + 1e-9; // u = t + theta x r
    if (!above && !std::binary_search(top.begin(), top.end(), int(i)))
      R.row(i).setZero();
  }
  MatrixXd W(R.rows(), 6);
  for (int k = 0; k < 3; ++k)
  {
    const Vector3d axis = Vector3d::Unit((k + 2) % 3);
    W.col(k)            = R.leftCols(3) * axis;
    W.col(3 + k)        = R.rightCols(3) * axis + R.leftCols(3) * axis.cross(centre - about);
  }
  return W;
}

/// Two parts meet near the second plane, three near the others.
TEST_F(ForcesInParts, AndSectionsBalanceTheInertiaOfEveryMotionWhateverModesAreOmitted)
{
  const Vector3d g(1., -2., -9.81);
  std::srand(1);
  for (const Bar &bar : damped_bars())
    for (const int n_parts : {1, 2, 3})
      for (const int modes : {0, 3, 10})
      {
        SCOPED_TRACE(std::to_string(modes) + " modes, parts: " + std::to_string(n_parts));
        const fem::FrameMatrices     frame  = fem::discretise(bar.mesh, bar.specification);
        const coupling::ReducedModel model  = model_of(bar, frame, modes, n_parts);
        const ReducedFrame          &few    = model.frame;
        const MatrixXd              &T      = model.basis.T;
        const MatrixXd               in     = T.transpose() * (frame.B - 4. * frame.M) * T;
        const Motion                 motion = random_motion(few, in, g);
        const VectorXd               braked = T * motion.braked;
        VectorXd                     load   = frame.acceleration_load * g - frame.M * braked;
        load(model.basis.q1) += motion.force;
        const double accuracy = n_parts == 1 ? 1e-8 : 1e-6; // of the mass of parts: substructures.md (9)
        for (const double z : heights)
        {
          const Eigen::Matrix<double, 6, 1> section = motions_above(frame, z).transpose() * load;
          for (int k = 0; k < 6; ++k)
          {
            const std::string name    = "cut." + plane_at(z) + fem::section_components[std::size_t(k)][0];
            const auto       &full    = output(frame, name);
            const double      between = full.under_acceleration.dot(g) + full.on_a.dot(braked);
            EXPECT_NEAR(force_of(few, name, motion, g), section[k] + between, accuracy * section.norm()) << name;
          }
        }
        const Vector3d whole = frame.mass * g - frame.acceleration_load.transpose() * braked +
                               frame.rigid_motions(model.basis.q1, Eigen::seqN(0, 3)).transpose() * motion.force;
        for (int d = 0; d < 3; ++d)
          EXPECT_NEAR(force_of(few, std::string("support.feet.") + "xyz"[d], motion, g), -whole[d],
                      accuracy * whole.norm())
              << "along " << d;
      }
}

/// Rows of a foundation depend on alpha, but no matrix of a part does.
TEST_F(ForcesInParts, FollowMassProportionalDampingThroughTheCache)
{
  Bar bar = damped_bars().back();
  bar.specification.cuts.clear();
  const auto row = [&](double alpha)
  {
    bar.specification.rayleigh_mass = alpha;
    return output_of(model_of(bar, {}, 3, 2).frame, "support.feet.x").on_v;
  };
  const VectorXd with = row(4.), without = row(0.);
  for (const auto &file : std::filesystem::directory_iterator(folder))
    std::filesystem::remove_all(file);
  EXPECT_EQ(without, row(0.));
  EXPECT_NE(with, without);
}

TEST(SupportForces, AndSectionsOfAnUnreducedFrameBalanceModalDamping)
{
  std::srand(2);
  for (const Bar &bar : damped_bars())
  {
    fem::FrameMatrices frame = fem::discretise(bar.mesh, bar.specification);
    coupling::add_modal_damping(frame, 10);
    const auto     n = frame.M.rows();
    const VectorXd a = VectorXd::Random(n), v = 1e-2 * VectorXd::Random(n),
                   from_modes = frame.modal_damping.Z *
                                frame.modal_damping.d.cwiseProduct(frame.modal_damping.Z.transpose() * v),
                   braked = a + 4. * v + statics_of(frame.M, from_modes),
                   q = statics(frame, -(frame.M * a + frame.B * v + from_modes)), load = -(frame.M * braked);
    const auto force = [&](const fem::FrameOutput &row)
    { return row.on_q.dot(q) + row.on_v.dot(v) + (row.on_a.size() > 0 ? row.on_a.dot(a) : 0.); };
    for (const double z : heights)
    {
      const Eigen::Matrix<double, 6, 1> section = motions_above(frame, z).transpose() * load;
      for (int k = 0; k < 6; ++k)
      {
        const auto &row = output(frame, "cut." + plane_at(z) + fem::section_components[std::size_t(k)][0]);
        EXPECT_NEAR(force(row), section[k] + row.on_a.dot(braked), 1e-8 * section.norm()) << row.name;
      }
    }
    const Vector3d whole = -frame.acceleration_load.transpose() * braked;
    for (int d = 0; d < 3; ++d)
      EXPECT_NEAR(force(output(frame, std::string("support.feet.") + "xyz"[d])), -whole[d], 1e-8 * whole.norm()) << d;
  }
}

} // namespace
} // namespace gestell::test
