// Stiffness, damping and mass of single elements: what their magnitudes are judged by.

#include "coupling/simulation/checks/element_scales.h"
#include "mechanism/elements/clearance.h"
#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/spring_damper.h"
#include "tests/support/test.h"

namespace gestell::coupling
{
namespace
{

using mechanism::SpringDamper;

/// Two sliders on the ground, a spring with a damper between them.
MachineModel two_masses(double m_1, double m_2)
{
  MachineModel model;
  const int    a = model.add_slider("a", {1, 0, 0}, m_1, "ground"), b = model.add_slider("b", {1, 0, 0}, m_2, "ground");
  model.attach("spring", std::make_shared<SpringDamper>(SpringDamper::Parameters{8e3, 40., 5., 0.}),
               {Measure{{a, 1.}, {b, -1.}}});
  return model;
}

TEST(ElementScales, OfASpringBetweenTwoMassesAreThoseOfTheirOscillation)
{
  const Machine machine(two_masses(3., 6.));
  const auto    scales = element_scales(machine, Eigen::VectorXd::Zero(machine.size()));
  ASSERT_EQ(scales.size(), 1u);
  EXPECT_EQ(scales[0].name, "spring");
  EXPECT_NEAR(scales[0].mass, 2., 1e-14); // m_1 m_2/(m_1 + m_2)
  EXPECT_NEAR(scales[0].frequency_hz(), std::sqrt(8e3 / 2.) / (2. * M_PI), 1e-12);
  EXPECT_NEAR(scales[0].ratio(), 40. / (2. * std::sqrt(8e3 * 2.)), 1e-14);
}

TEST(ElementScales, OfARodAreThoseAlongTheSlide)
{
  MachineModel model;
  const int    crank = model.add_rotor("crank", {0, 1, 0}, 0.5, 0., "ground"),
            slide    = model.add_slider("slide", {0, 0, -1}, 4., "ground");
  mechanism::ConnectingRod::Parameters rod;
  rod.crank_radius = 0.1;
  rod.length       = 0.5;
  rod.stiffness    = 9e6;
  model.attach("rod", std::make_shared<mechanism::ConnectingRod>(rod),
               {Measure{{crank, 1.}}, Measure{{slide, -1.}}, Measure{}});
  const Machine machine(std::move(model));
  const auto    at_dead_centre = element_scales(machine, Eigen::VectorXd::Zero(2));
  ASSERT_EQ(at_dead_centre.size(), 1u);
  EXPECT_NEAR(at_dead_centre[0].stiffness, 9e6, 1e-6); // the crank does not move the pin along the slide there
  EXPECT_NEAR(at_dead_centre[0].mass, 4., 1e-12);
}

TEST(ElementScales, WithoutMassThereIsNoFrequency)
{
  const ElementScale scale{"massless", 1e6, 10., 0.};
  EXPECT_EQ(scale.frequency_hz(), 0.);
  EXPECT_EQ(scale.ratio(), 0.);
}

} // namespace
} // namespace gestell::coupling
