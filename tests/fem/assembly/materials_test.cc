#include "fem/recovery/discretisation.h"
#include "fem/values/nearest_name.h"
#include "tests/support/box_mesh.h"
#include "tests/support/statics.h"

#include <gtest/gtest.h>

namespace gestell::test
{

namespace
{

constexpr double bar_length = 1.6, bar_width = 0.2, bar_height = 0.3, bar_area = bar_width * bar_height;

/// A bar along x whose first quarter is the solid "foot", the rest "column".
fem::Mesh bar_of_two_solids()
{
  fem::Mesh mesh = box_mesh({{8, 2, 2}}, {{bar_length, bar_width, bar_height}});
  mesh.solids    = {"foot", "column"};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    double x = 0.;
    for (const int point : mesh.cells[c])
      x += 0.25 * mesh.points[point][0];
    mesh.cell_solid[c] = x > 0.25 * bar_length;
  }
  return mesh;
}

fem::FrameSpecification clamped_bar()
{
  auto specification        = free_steel();
  specification.material.nu = 0.;
  specification.supports    = {clamped("wall", {"x0"})};
  specification.interfaces  = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  return specification;
}

TEST(Materials, OfTwoSolidsAddTheirCompliancesAndWeights)
{
  // nu = 0: the field is linear in each part and meets the clamped end, so P2 holds it exactly.
  auto specification          = clamped_bar();
  specification.materials     = {{"column", {70e9, 0., 2700., "", "aluminium"}}};
  const auto            frame = fem::discretise(bar_of_two_solids(), specification);
  const int             tip   = frame.interfaces[0].coordinate[fem::ux];
  const Eigen::VectorXd q     = statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), tip));
  const double          exact = (0.25 / 210e9 + 0.75 / 70e9) * bar_length / bar_area;
  EXPECT_NEAR(q[tip], exact, 1e-9 * exact);

  const double foot = 7850. * 0.25 * bar_length * bar_area, column = 2700. * 0.75 * bar_length * bar_area;
  EXPECT_NEAR(frame.mass, foot + column, 1e-12 * frame.mass);
  EXPECT_NEAR(frame.centre[0], bar_length * (0.125 * foot + 0.625 * column) / frame.mass, 1e-12);
}

TEST(Materials, FitByPatternTheLastCounts)
{
  auto specification      = clamped_bar();
  specification.materials = {{"*", {70e9, 0., 2700., ""}}, {"f??t", {110e9, 0., 7200., ""}}};
  EXPECT_NEAR(fem::discretise(bar_of_two_solids(), specification).mass,
              bar_length * bar_area * (0.25 * 7200. + 0.75 * 2700.), 1e-9);
}

TEST(Materials, OfUnknownSolidsOrImpossibleNumbersAreRefusedWithThePlace)
{
  auto specification      = clamped_bar();
  specification.materials = {{"colum", {70e9, 0., 2700., "press.toml:8: frame.materials.colum"}}};
  const auto refuse       = [&] { return refusal([&] { fem::discretise(bar_of_two_solids(), specification); }); };
  EXPECT_NE(refuse().find("press.toml:8: frame.materials.colum: no solid is called \"colum\"; the nearest names are "
                          "\"column\""),
            std::string::npos)
      << refuse();
  EXPECT_EQ(nearest_names("colum", {"all", "column", "all"}, "solid"), "the nearest names are \"column\", \"all\"");
  specification.materials = {{"column", {70e9, 0., -1., "press.toml:8"}}};
  EXPECT_NE(refuse().find("press.toml:8: density rho = -1"), std::string::npos);
}

} // namespace

} // namespace gestell::test
