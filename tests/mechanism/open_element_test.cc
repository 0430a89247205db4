// An element that is open keeps what acts in every branch of its law.

#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/point_contact.h"
#include "mechanism/elements/rope.h"
#include "mechanism/elements/wheel.h"
#include "mechanism/switched_element.h"
#include "tests/support/branch_samples.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

struct Open
{
  std::string               name;
  std::shared_ptr<ForceLaw> element;
  Probe                     probe; ///< in the open branch
};

std::vector<Open> open_elements()
{
  const Formula         u = Formula::variable(1), v = Formula::variable(2);
  const Eigen::Vector3d apart(-1e-3, 0., 0.), centred(1e-5, 0., 0.), still = Eigen::Vector3d::Zero();
  Clearance::Parameters above = play;
  above.stops                 = Clearance::Stops::above;
  std::vector<Open> all       = {
            {"rod", std::make_shared<ConnectingRod>(rod), rod_probe(-1e-4, 0.1)},
            {"play", std::make_shared<Clearance>(play), probe1(1e-5, 0.1)},
            {"rope", std::make_shared<Rope>(Rope::Parameters{1e5, 200., 0.}), probe1(-1e-3, 0.1)},
            {"wheel", std::make_shared<Wheel>(Wheel::Parameters{1e5, 200.}), probe1(1e-3, 0.1)},
            {"contact", std::make_shared<PointContact>(PointContact::Parameters{above, rubbing}), {0., apart, still, still}},
            {"bearing", std::make_shared<JournalBearing>(bearing), {0., centred, still, still}},
            {"formula", std::make_shared<FormulaForce>(FormulaForce::Parameters{-2e4 * max(u - 0.1, 0.) - 7. * v}),
             probe1(0., 0.1)}};
  all.push_back(
      {"switched", std::make_shared<SwitchedElement>(all[0].element, SwitchedElement::Begin::on), all[0].probe});
  return all;
}

TEST(OpenElement, IsWhatItsLawIsInItsOpenBranch)
{
  for (const auto &[name, element, probe] : open_elements())
  {
    const int             k       = element->n_measures();
    const Eigen::VectorXd history = started(*element, probe);
    Eigen::VectorXd       p(k);
    Eigen::MatrixXd       du(k, k), dv(k, k), K(k, k), D(k, k), K_engaged(k, k), D_engaged(k, k);
    element->derivatives(probe.motion(), history.data(), p.data(), du.data(), dv.data());
    mechanism::open_branch(*element, probe.u.data(), K.data(), D.data());
    mechanism::engaged(*element, probe.u.data(), K_engaged.data(), D_engaged.data());
    // Geometric stiffness of the oil film's force is no part of K.
    EXPECT_TRUE(K.isZero(0.)) << name;
    EXPECT_LE((D + dv).norm(), 1e-12 * dv.norm()) << name;
    const bool as_it_is = name == "formula"; // its wall is not touched
    EXPECT_EQ((K_engaged - K).norm() > 0., !as_it_is) << name;
  }
}

TEST(OpenElement, IsAllOfALawThatIsNeverOpen)
{
  const Wheel  bilateral({1e5, 200., true});
  const double u = 0.;
  double       K, D;
  bilateral.open_branch(&u, &K, &D);
  EXPECT_EQ(K, 1e5);
  EXPECT_EQ(D, 200.);
}

} // namespace
} // namespace gestell::tests
