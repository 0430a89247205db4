// Bars under loads, and vibrations of swept plates, against formulas of beams and of thin walls.

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/cad_samples.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

constexpr double length = 2., beam_width = 0.2, beam_height = 0.25;

/// Bar along x, clamped at x = 0, the free end averaged to a node.
fem::FrameMatrices cantilever(const std::array<int, 3> &n, double nu)
{
  auto specification        = free_steel();
  specification.material.nu = nu;
  specification.supports    = {clamped("wall", {"x0"})};
  specification.interfaces  = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  return fem::discretise(box_mesh(n, {{length, beam_width, beam_height}}), specification);
}

TEST(Cantilever, UnderAnEndForceApproachesTimoshenkosBeamFromBelow)
{
  // w = F l^3 / (3 E I) + F l / (kappa mu A), kappa = 5/6 for nu = 0; the clamped end hinders warping, an effect of
  // the order (height / length)^2 of the small shear part: together less than 0.1 %.
  const double EI    = 210e9 * beam_width * std::pow(beam_height, 3) / 12.,
               shear = 5. / 6. * 105e9 * beam_width * beam_height;
  const double exact = std::pow(length, 3) / (3. * EI) + length / shear;
  double       last  = 0.;
  for (const int n : {1, 2, 4})
  {
    const auto   frame = cantilever({{4 * n, n, n}}, 0.);
    const auto   tip   = frame.interfaces[0].coordinate[fem::uz];
    const double w     = statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), tip))[tip];
    EXPECT_GT(w, last) << "a finer nested mesh is softer";
    last = w;
  }
  EXPECT_NEAR(last, exact, 1e-3 * exact);
}

TEST(Cantilever, LengthwiseFrequencyConvergesWithTheFourthPower)
{
  // nu = 0: u_x = sin(pi x / (2 l)) is exact and smooth, f = sqrt(E / rho) / (4 l); bending modes lie below it, so
  // it is picked out by its shape.
  const double exact = std::sqrt(210e9 / 7850.) / (4. * length);
  const auto   error = [&](int n)
  {
    auto specification        = free_steel();
    specification.material.nu = 0.;
    specification.supports    = {clamped("wall", {"x0"}),
                                 clamped("guide", {"y0", "y1", "z0", "z1"}, {{false, true, true}})};
    const auto frame = fem::discretise(box_mesh({{n, 1, 1}}, {{length, beam_width, beam_height}}), specification);
    return lowest_modes(frame, 1).frequency_hz[0] / exact - 1.;
  };
  const double coarse = error(2), fine = error(4);
  EXPECT_GT(fine, 0.);
  EXPECT_NEAR(std::log2(coarse / fine), 4., 0.3);
}

TEST(Cantilever, HasTheFirstBendingFrequencyOfABeam)
{
  // Euler's 1.8751^2 sqrt(E I / (rho A l^4)) / (2 pi); shear and rotary inertia of l / h = 8 lower it by about
  // 0.5 (1.8751)^2 (h / l)^2 / 12 (1 + E / (kappa mu)) ~ 1 %.
  const double euler = 1.8751 * 1.8751 / (2. * EIGEN_PI) *
                       std::sqrt(210e9 * beam_width * beam_width / 12. / (7850. * std::pow(length, 4)));
  const double f = lowest_modes(cantilever({{16, 2, 2}}, 0.3), 1).frequency_hz[0];
  EXPECT_LT(f, euler * 1.002);
  EXPECT_GT(f, euler * 0.985);
}

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
