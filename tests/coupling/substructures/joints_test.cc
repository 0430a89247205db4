#include "tests/coupling/substructures/pieces.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using coupling::FrameJoint;
using coupling::FrameOfParts;
using coupling::JointKind;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr auto held_rigid = fem::InterfaceCoupling::rigid;
constexpr auto averaged   = fem::InterfaceCoupling::average;

/// A clamped base, a column on it and a head on that, one behind the other along x; no Poisson contraction, so that the
/// column between rigid faces is a bar.
std::vector<Piece> column_between()
{
  std::vector<Piece> pieces{bar("base", averaged, held_rigid), bar("column", held_rigid, held_rigid, part_length),
                            bar("head", held_rigid, averaged, 2. * part_length)};
  pieces[0].geometry.interfaces.erase(pieces[0].geometry.interfaces.begin());
  pieces[0].geometry.supports = {clamped("ground", {"x0"})};
  for (Piece &piece : pieces)
    piece.geometry.material.nu = 0.;
  return pieces;
}

FrameJoint contact(const std::string &name, const coupling::JointEnd &first, const coupling::JointEnd &second)
{
  FrameJoint joint = weld(name, first, second);
  joint.kind       = JointKind::contact;
  joint.normal     = Vector3d::UnitX();
  return joint;
}

FrameJoint tie_rod(double prestress)
{
  FrameJoint joint    = weld("rod", {"base", "front"}, {"head", "rear"});
  joint.kind          = JointKind::tie_rod;
  joint.rod.diameter  = 0.03;
  joint.rod.E         = 210e9;
  joint.rod.prestress = prestress;
  return joint;
}

FrameOfParts tightened(const std::vector<Piece> &pieces, double prestress)
{
  FrameOfParts frame   = described(pieces, {contact("lower", {"base", "front"}, {"column", "rear"}),
                                            contact("upper", {"column", "front"}, {"head", "rear"}), tie_rod(prestress)});
  frame.joints[1].keep = true;
  return frame;
}

double force(const fem::FrameMatrices &frame, const std::string &name, const VectorXd &q,
             const Vector3d &g = Vector3d::Zero())
{
  const fem::FrameOutput &row = output(frame, name);
  return row.on_q.dot(q) + row.under_acceleration.dot(g) + row.constant;
}

const fem::Interface &kept(const fem::FrameMatrices &frame, const std::string &name)
{
  for (const fem::Interface &interface : frame.interfaces)
    if (interface.name == name)
      return interface;
  throw std::invalid_argument(name);
}

TEST(TieRod, SharesAPullWithTheColumnByTheirStiffnesses)
{
  const auto   pieces  = column_between();
  const double preload = 80e3, pull = 50e3;
  const auto   both  = joined(pieces, tightened(pieces, preload), 4);
  const double rod   = 210e9 * M_PI / 4. * 0.03 * 0.03 / part_length;
  const double steel = free_steel().material.E * part_width * part_height / part_length;

  VectorXd f = VectorXd::Zero(both.matrices.M.rows());
  EXPECT_NEAR(force(both.matrices, "joint.rod.force", f), preload, 1e-6); // at rest
  EXPECT_NEAR(force(both.matrices, "joint.upper.normal_force", f), preload, 1e-6 * preload);
  EXPECT_NEAR(both.preloads[0].pressed, preload, 1e-6 * preload);

  f[kept(both.matrices, "column.front").coordinate[fem::ux]] = pull;
  const VectorXd q                                           = statics(both.matrices, f);
  const double   more                                        = pull * rod / (rod + steel);
  EXPECT_NEAR(force(both.matrices, "joint.rod.force", q), preload + more, 1e-8 * pull);
  // The head keeps what the rod pulls; the pull itself acts on the first part of the joint, the column.
  EXPECT_NEAR(force(both.matrices, "joint.upper.normal_force", q), preload + more, 1e-8 * pull);
  EXPECT_NEAR(force(both.matrices, "joint.lower.normal_force", q), preload + more - pull, 1e-8 * pull);
}

TEST(TieRod, MovesWithHalfOfItsMassAtEachEnd)
{
  const auto pieces       = column_between();
  auto       frame        = tightened(pieces, 0.);
  const auto light        = joined(pieces, frame, 2);
  frame.joints[2].rod.rho = 7850.;
  const auto   heavy      = joined(pieces, frame, 2);
  const double mass       = 7850. * M_PI / 4. * 0.03 * 0.03 * part_length;
  EXPECT_NEAR(heavy.facts.mass - light.facts.mass, mass, 1e-12);
  const VectorXd x = heavy.matrices.translations.col(0);
  EXPECT_NEAR(x.dot((heavy.matrices.M - light.matrices.M) * x), mass, 1e-9);
  EXPECT_NEAR(x.dot((heavy.matrices.acceleration_load - light.matrices.acceleration_load).col(0)), mass, 1e-9);
}

TEST(Weld, CarriesTheWeightOfWhatStandsOnIt)
{
  const auto     pieces = column_between();
  const auto     both   = joined(pieces, tightened(pieces, 0.), 30);
  const Vector3d g(-9.81, 0., 0.);
  const VectorXd q      = statics(both.matrices, both.matrices.acceleration_load * g);
  const double   rod    = force(both.matrices, "joint.rod.force", q);
  const double   weight = 9.81 * 7850. * part_length * part_width * part_height;
  // what stands on the lower face: column and head, less what the rod pushes up as it is pressed
  EXPECT_LT(rod, 0.);
  EXPECT_NEAR(force(both.matrices, "joint.upper.normal_force", q, g), weight + rod, 1e-7 * weight);
  EXPECT_NEAR(force(both.matrices, "joint.lower.normal_force", q, g), 2. * weight + rod, 1e-7 * weight);
}

TEST(Weld, TellsTheInertiaOfWhatItAccelerates)
{
  std::vector<Piece> bars{bar("first", averaged, held_rigid), bar("second", held_rigid, averaged, part_length)};
  const auto         both = joined(bars, described(bars, {weld("middle", {"first", "front"}, {"second", "rear"})}), 3);
  const double       mass = 7850. * part_length * part_width * part_height;
  const auto        &row  = output(both.matrices, "joint.middle.fy");
  // q = 0 and a unit acceleration of the whole: all that the second bar needs at its rear end, or at its front as load
  VectorXd     a       = both.matrices.translations.col(1);
  const double at_rear = row.on_a.dot(a);
  VectorXd     load    = both.matrices.M * a; // of all coordinates, by which it moves so without deforming
  const auto  &front   = kept(both.matrices, "second.front");
  EXPECT_NEAR(at_rear + load[front.coordinate[fem::uy]], mass, 1e-9 * mass);
}

TEST(Bolts, YieldByTheirStiffnessAndByTheirPlaces)
{
  std::vector<Piece> bars{bar("base", averaged, held_rigid), bar("arm", held_rigid, averaged, part_length)};
  bars[0].geometry.interfaces.erase(bars[0].geometry.interfaces.begin());
  bars[0].geometry.supports = {clamped("ground", {"x0"})};
  FrameJoint stiff          = weld("flange", {"base", "front"}, {"arm", "rear"});
  FrameJoint bolted         = stiff;
  bolted.kind               = JointKind::bolts;
  bolted.bolts.stiffness    = {3e8, 1e8, 1e8};
  const double y = 0.04, z = 0.03;
  for (const double j : {-1., 1.})
    for (const double k : {-1., 1.})
      bolted.bolts.positions.push_back({part_length, part_width / 2. + j * y, part_height / 2. + k * z});

  const auto at_end = [&](const FrameJoint &joint, int motion)
  {
    const auto both = joined(bars, described(bars, {joint}), 2);
    VectorXd   f    = VectorXd::Zero(both.matrices.M.rows());
    const int  i    = kept(both.matrices, "arm.front").coordinate[motion];
    f[i]            = 1.;
    return statics(both.matrices, f)[i];
  };
  EXPECT_NEAR(at_end(bolted, fem::ux) - at_end(stiff, fem::ux), 1. / (4. * 3e8), 1e-8 / (4. * 3e8));
  EXPECT_NEAR(at_end(bolted, fem::rx) - at_end(stiff, fem::rx), 1. / (4. * 1e8 * (y * y + z * z)), 1e-13);
  EXPECT_NEAR(at_end(bolted, fem::ry) - at_end(stiff, fem::ry), 1. / (4. * 3e8 * z * z), 1e-13);
  EXPECT_NEAR(at_end(bolted, fem::rz) - at_end(stiff, fem::rz), 1. / (4. * 3e8 * y * y), 1e-13);
}

TEST(Bolts, TellTheForceThatBendsThem)
{
  std::vector<Piece> bars{bar("base", averaged, held_rigid), bar("arm", held_rigid, averaged, part_length)};
  bars[0].geometry.interfaces.erase(bars[0].geometry.interfaces.begin());
  bars[0].geometry.supports                               = {clamped("ground", {"x0"})};
  FrameJoint joint                                        = weld("flange", {"base", "front"}, {"arm", "rear"});
  joint.kind                                              = JointKind::bolts;
  joint.bolts.stiffness                                   = {3e8, 1e8, 1e8};
  joint.bolts.rotational                                  = {1e6, 1e6, 1e6};
  const auto both                                         = joined(bars, described(bars, {joint}), 2);
  VectorXd   f                                            = VectorXd::Zero(both.matrices.M.rows());
  f[kept(both.matrices, "arm.front").coordinate[fem::uz]] = 100.;
  const VectorXd q                                        = statics(both.matrices, f);
  // the arm is held against a force at its end
  EXPECT_NEAR(force(both.matrices, "joint.flange.fz", q), -100., 1e-6);
  EXPECT_NEAR(force(both.matrices, "joint.flange.my", q), 100. * part_length, 1e-6);
}

TEST(JointDampers, ActAsTheSpringsBesideThemDoAtTheRateInPlaceOfTheWay)
{
  // Dampers of a time constant times the stiffness: the force of rates v is that of the deflection times it.
  constexpr double   tau = 2e-4;
  std::vector<Piece> bars{bar("base", averaged, held_rigid), bar("arm", held_rigid, averaged, part_length)};
  FrameJoint         flange       = weld("flange", {"base", "front"}, {"arm", "rear"});
  flange.kind                     = JointKind::bolts;
  flange.bolts.stiffness          = {3e8, 1e8, 2e8};
  flange.bolts.rotational         = {1e6, 2e6, 3e6};
  flange.bolts.damping            = tau * flange.bolts.stiffness;
  flange.bolts.rotational_damping = tau * flange.bolts.rotational;
  const auto   bolted             = joined(bars, described(bars, {flange}), 2).matrices;
  const auto   column             = column_between();
  FrameOfParts tied               = tightened(column, 0.);
  tied.joints[2].rod.damping      = tau * 210e9 * M_PI / 4. * 0.03 * 0.03 / part_length;
  const auto     rod              = joined(column, tied, 2).matrices;
  const VectorXd rod_on_q         = output(rod, "joint.rod.force").on_q;
  EXPECT_LT((output(rod, "joint.rod.force").on_v - tau * rod_on_q).norm(), 1e-12 * tau * rod_on_q.norm());
  for (const std::string name : {"fx", "fy", "fz", "mx", "my", "mz"})
  {
    const fem::FrameOutput &row = output(bolted, "joint.flange." + name);
    ASSERT_GT(row.on_q.norm(), 0.) << name;
    EXPECT_LT((row.on_v - tau * row.on_q).norm(), 1e-9 * tau * row.on_q.norm()) << name;
  }
}

std::string joint_refusal(const std::vector<Piece> &pieces, const FrameOfParts &frame)
{
  return refusal([&] { joined(pieces, frame, 2); });
}

TEST(BadJoints, AreRefusedWithTheirPlaceAndAWayOut)
{
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  const std::vector<Piece> bars{bar("first", averaged, held_rigid), bar("second", held_rigid, averaged, part_length)};
  const auto               good = weld("middle", {"first", "front"}, {"second", "rear"});
  EXPECT_EQ(joint_refusal(bars, described(bars, {good})), "");

  auto apart            = bars;
  apart[1].placement.at = {part_length + 0.02, 0., 0.};
  EXPECT_THAT(joint_refusal(apart, described(apart, {good})),
              AllOf(HasSubstr("frame.joint.middle: the interfaces do not meet"), HasSubstr("20 mm apart"),
                    HasSubstr("(0.42, 0.05, 0.04) m"), HasSubstr("tolerance = \"22 mm\"")));
  auto wide      = good;
  wide.tolerance = 0.021;
  EXPECT_EQ(joint_refusal(apart, described(apart, {wide})), "");

  EXPECT_THAT(joint_refusal(bars, described(bars, {weld("middle", {"frist", "front"}, {"second", "rear"})})),
              HasSubstr("there is no part 'frist'; did you mean 'first'?"));
  EXPECT_THAT(joint_refusal(bars, described(bars, {weld("middle", {"first", "top"}, {"second", "rear"})})),
              HasSubstr("part 'first' has no interface 'top'"));
  EXPECT_THAT(joint_refusal(bars, described(bars, {weld("middle", {"first", "front"}, {"first", "rear"})})),
              HasSubstr("joins part 'first' with itself"));
  EXPECT_THAT(joint_refusal(bars, described(bars, {good, weld("again", {"first", "front"}, {"second", "rear"})})),
              HasSubstr("frame.joint.again: interface 'first.front' is joined by 'middle'; divide its surfaces"));
  EXPECT_THAT(joint_refusal(bars, described(bars, {})),
              HasSubstr("frame.part.second: no joint connects this part with 'first'"));
  auto loose            = good;
  loose.kind            = JointKind::bolts;
  loose.bolts.stiffness = {1e8, 1e8, 1e8}; // one bolt, about which the parts turn
  EXPECT_THAT(joint_refusal(bars, described(bars, {loose})), HasSubstr("free relative to the others"));
}

TEST(Contacts, AreReportedAsOpeningWhereNothingPressesThem)
{
  const auto pieces = column_between();
  EXPECT_THAT(joined(pieces, tightened(pieces, 0.), 2).facts.notes,
              ::testing::Contains(::testing::HasSubstr("this joint has no clamping force")));
  EXPECT_THAT(joined(pieces, tightened(pieces, 5e3), 2).facts.notes, ::testing::IsEmpty());
}

} // namespace
} // namespace gestell::test
