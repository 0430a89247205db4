// Vibrations of swept plates against formulas of thin walls.

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/cad_samples.h"
#include "tests/support/lowest_modes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::test
{

namespace
{

constexpr double l = 0.4, b = 0.08, t = 0.008; // of a plate

fem::FrameSpecification plate(const std::string &more, double size)
{
  const std::string script = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.4, 0.08, 0.008};\n" + more;
  auto              frame  = fem::test::specification(fem::test::write_text("plate.geo", script), size);
  frame.material           = {210e9, 0., 7850., "scene.toml:3"};
  frame.mesh.plates        = fem::Plates::swept;
  frame.surfaces           = {{"root", fem::test::plane({-1., 0., 0.}, {0., 0., 0.})},
                              {"end", fem::test::plane({1., 0., 0.}, {l, 0., 0.})}};
  return frame;
}

double first_frequency(const fem::FrameSpecification &frame)
{
  return lowest_modes(fem::discretise(fem::make_mesh(frame), frame), 1).frequency_hz[0];
}

TEST(SweptPlate, BendsAsABeamWithFewCells)
{
  // Euler's f = 1.8751^2 / (2 pi l^2) sqrt(E I / (rho A)) less Timoshenko's part, of the order 2 (t / l)^2 = 0.08 %.
  auto frame     = plate("", 0.04);
  frame.supports = {clamped("wall", {"root"})};
  const double f = 1.8751 * 1.8751 / (2. * M_PI * l * l) * std::sqrt(210e9 * t * t / 12. / 7850.);
  EXPECT_LT(3 * fem::number_of_nodes(fem::make_mesh(frame)), 6000);
  EXPECT_NEAR(first_frequency(frame), f, 2e-3 * f);
}

TEST(SweptPlate, TwistsAsFreeAsItsEdgesLet)
{
  // Ends held but for warping: f = sqrt((G J + E Gamma k^2) / (rho I_p)) / (2 l), k = pi / l, with Saint-Venant's
  // J = b t^3 / 3 (1 - 0.630 t / b) and Gamma = b^3 t^3 / 144 (Timoshenko & Goodier; Vlasov).  Without the turn of the
  // shear at the edges (0.630 t / b = 6.3 %) f would be 3 % higher.
  auto frame     = plate("", 0.1);
  frame.supports = {clamped("ends", {"root", "end"}, {false, true, true}),
                    foundation("along", {"root"}, {1e3, 0., 0.})};
  const double E = 210e9, G = E / 2., J = b * t * t * t / 3. * (1. - 0.630 * t / b);
  const double Gamma = std::pow(b * t, 3) / 144., k = M_PI / l, I_p = b * t * (b * b + t * t) / 12.;
  const double f       = std::sqrt((G * J + E * Gamma * k * k) / (7850. * I_p)) / (2. * l);
  const auto   modes   = lowest_modes(fem::discretise(fem::make_mesh(frame), frame), 5);
  double       nearest = 0.;
  for (int j = 0; j < 5; ++j)
    if (std::abs(modes.frequency_hz[j] - f) < std::abs(nearest - f))
      nearest = modes.frequency_hz[j];
  EXPECT_NEAR(nearest, f, 5e-3 * f); // bending of 470 and 1060 Hz is far
}

} // namespace

} // namespace gestell::test
