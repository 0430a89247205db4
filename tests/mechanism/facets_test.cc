// Which facets an element has, and what holds where it has none.

#include "mechanism/elements/follower_load.h"
#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/kloss_motor.h"
#include "mechanism/elements/profile_force.h"
#include "mechanism/elements/rope.h"
#include "mechanism/elements/spring_damper.h"
#include "mechanism/elements/wheel.h"
#include "mechanism/switched_element.h"
#include "mechanism/transmitted_element.h"
#include "tests/support/element_probe.h"
#include "tests/support/linear_joint.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

/// The facets of an element by their first letters: "BSC" has all, "" has none.
std::string facets(const mechanism::Element &element)
{
  return std::string(element.branches() ? "B" : "") + (element.structure() ? "S" : "") +
         (element.commands() ? "C" : "");
}

const auto spring  = std::make_shared<SpringDamper>(SpringDamper::Parameters{2e3, 30., 0., 0.});
const auto rope    = std::make_shared<Rope>(Rope::Parameters{1e5, 200., 0.});
const auto motor   = std::make_shared<KlossMotor>(KlossMotor::Parameters{240., 0.15, 157., 49.});
const auto profile = std::make_shared<ProfileForce>(CommandedProfile(5.));

const Placement point(Vector3d::Zero(), Vector3d::Zero(), {{Vector3d::UnitX(), Vector3d::Zero()}}, Vector3d::UnitY());

std::shared_ptr<FormulaForce> formula(const Formula &force)
{
  return std::make_shared<FormulaForce>(FormulaForce::Parameters{force});
}

const Formula variable = Formula::variable(1);

TEST(Facets, AreThoseTheLawNames)
{
  EXPECT_EQ(facets(*spring), "S");
  EXPECT_EQ(facets(*rope), "BS");
  EXPECT_EQ(facets(*motor), "");
  EXPECT_EQ(facets(*profile), "BC");
  EXPECT_EQ(facets(*formula(-3. * variable)), "S"); // without kinks it has one branch
  EXPECT_EQ(facets(*formula(-3. * max(variable, 0.))), "BS");
  EXPECT_EQ(facets(Wheel({1e5, 200., true})), "S"); // never leaves the ground
}

// A switch makes a history of its own and orders of its own; it makes no structure.
TEST(Facets, OfASwitchedElementAreItsOwnAndTheStructureOfItsLaw)
{
  EXPECT_EQ(facets(SwitchedElement(spring, SwitchedElement::Begin::on)), "BSC");
  EXPECT_EQ(facets(SwitchedElement(motor, SwitchedElement::Begin::on)), "BC");
}

// A scalar that turns with the motion gives every law a geometric stiffness.
TEST(Facets, OfATransmittedElementAreThoseOfItsLawAndStructure)
{
  const CombinedMeasure along(PlacedMeasure{point, point, RelativeMeasure{}});
  const auto            transmitted = [&](const std::shared_ptr<const ForceLaw> &law)
  { return facets(TransmittedElement(along, law)); };
  EXPECT_EQ(transmitted(spring), "S");
  EXPECT_EQ(transmitted(rope), "BS");
  EXPECT_EQ(transmitted(profile), "BSC");
}

TEST(Facets, OfAFollowerLoadAreThoseOfItsLawAndItsGeometricStiffness)
{
  EXPECT_EQ(facets(FollowerLoad(point, Vector3d::UnitX(), profile)), "BSC");
  EXPECT_EQ(facets(FollowerLoad(point, Vector3d::UnitX(), spring)), "S");
}

TEST(Facets, TellForceLawsFromIdealJoints)
{
  const LinearJoint joint({1., -2.});
  EXPECT_EQ(motor->force_law(), motor.get());
  EXPECT_EQ(motor->ideal_joint(), nullptr);
  EXPECT_EQ(joint.ideal_joint(), &joint);
  EXPECT_EQ(joint.force_law(), nullptr);
  EXPECT_EQ(n_constraints(joint), 1);
  EXPECT_EQ(n_constraints(*motor), 0);
}

TEST(Facets, ThatAreAbsentMeanNeitherHistoryNorOrdersNorStiffness)
{
  const Probe probe = probe1(0.1, 0.2);
  EXPECT_EQ(n_history(*motor), 0);
  EXPECT_EQ(mechanism::started(*motor, probe.motion()), std::vector<double>{0.});
  EXPECT_TRUE(command_names(*motor).empty());
  EXPECT_FALSE(stiffens(*motor));
  for (const auto matrices : {mechanism::engaged, mechanism::stiffest, mechanism::open_branch})
  {
    double K = 1., D = 1.; // whatever stood there
    matrices(*motor, probe.u.data(), &K, &D);
    EXPECT_EQ(K, 0.);
    EXPECT_EQ(D, 0.);
  }
  double K = 1.;
  mechanism::geometric(*motor, probe.motion(), nullptr, &K);
  EXPECT_EQ(K, 0.);
}

// What is no structure may still be what the step has to stand: zero in one, set in the other.
TEST(Facets, TellMatricesWhateverStoodThere)
{
  const Probe probe = probe1(0.1, 0.2);
  double      K = 1., D = 1.;
  mechanism::open_branch(*rope, probe.u.data(), &K, &D);
  EXPECT_EQ(K + D, 0.);
  mechanism::engaged(*rope, probe.u.data(), &K, &D);
  EXPECT_EQ(K, 1e5);
  EXPECT_EQ(D, 200.);
}

} // namespace
} // namespace gestell::tests
