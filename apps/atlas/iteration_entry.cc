// Pseudo forces by fixed-point iteration, where Newton needs one tangent.

#include "apps/atlas/atlas.h"
#include "apps/output/charts/chart.h"
#include "coupling/integration/bdf/bdf_formula.h"
#include "coupling/integration/step/implicit_step.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/cubic_spring.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double omega_base = 50., step = 1e-3; ///< rad/s, s: omega h = 0.05, so that the steps' own error is small

/// 1 kg on a spring of the base system and on an element of stiffness c.
coupling::Machine held_mass(double c)
{
  coupling::MachineModel  model;
  const coupling::Measure u = {{model.add_slider("x0", {1., 0., 0.}, 1., "ground"), 1.}};
  model.add_linear("spring", u, {omega_base * omega_base, 0., 0., 0.}, "N");

  mechanism::CubicSpring::Parameters spring;
  spring.stiffness = c;
  model.attach("element", std::make_shared<mechanism::CubicSpring>(spring), {u});
  coupling::Machine machine(std::move(model));
  return machine;
}

/// Ratio of successive corrections of u = u_free + S p(u) in one step of BDF 2.
double measured_contraction(const coupling::Machine &machine)
{
  const double              h_b = coupling::bdf_formulas[1].beta0 * step;
  coupling::ImplicitStep    implicit(machine, {});
  coupling::IntegrationWork work;
  const coupling::StepForm  form{1., h_b, h_b * h_b, h_b * h_b, 1., 1. / h_b, 1. / (h_b * h_b), step};
  const auto               &condensed = implicit.condensed(form, work);
  coupling::LocalState      local;
  local.resize(machine);
  const double u_free = 1e-3;
  double       before = 0., ratio = 0.;
  for (int k = 0; k < 3; ++k) // later corrections of a good contraction are rounding
  {
    machine.forces().force(local, local.p);
    const double next = u_free + condensed.S.own(0) * local.p[0], correction = next - local.u[0];
    ratio      = k > 0 ? std::abs(correction / before) : 0.;
    before     = correction;
    local.u[0] = next;
  }
  return ratio;
}

} // namespace

AtlasEntry fixed_point_of_forces()
{
  AtlasEntry entry{
      "fixed-point",
      "Pseudo forces by fixed-point iteration",
      "Some programs put the element forces on the right-hand side and iterate, u ← u_free + S p(u). This needs no "
      "tangent, but converges only if |S dp/du| < 1, with the compliance S = h_b² Wᵀ A⁻¹ W of the base system over a "
      "step. A contact of 10⁸ N/m on 1 kg with a step of 1 ms has 44. Newton's method converges here in one iteration, "
      "and a second one confirms it. BDF 2, h = 1 ms, 1 kg at 50 rad/s:",
      {},
      {{"stiffness of the element", "S dp/du, predicted", "measured ratio of corrections", "Newton iterations a step"}},
      {}};
  Chart chart{entry.title,
              "",
              {"stiffness of the element in N/m", 1e3, 1e9, Scale::logarithmic},
              {"ratio of corrections", 1e-4, 1e3, Scale::logarithmic}};
  chart.shades = {{1., 1e3, 1}};
  Curve        line{"|S dp/du|"}, seen = rings("measured", 0);
  const double h_b        = coupling::bdf_formulas[1].beta0 * step;
  const double compliance = h_b * h_b / (1. + h_b * h_b * omega_base * omega_base);
  for (const double c : {1e4, 1e5, 1e6, 3e6, 1e7, 1e8})
  {
    auto                    machine   = held_mass(c);
    const double            predicted = compliance * c, measured = measured_contraction(machine);
    coupling::MethodOptions options;
    options.step                = step;
    const auto           newton = coupling::make_integrator(machine, options);
    coupling::LocalState local;
    machine.gather(0., Eigen::VectorXd::Constant(1, 1e-3), Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), local);
    machine.events().start(local);
    newton->begin(0., Eigen::VectorXd::Constant(1, 1e-3), Eigen::VectorXd::Zero(1));
    for (int k = 0; k < 100; ++k)
      newton->advance();
    const double iterations = double(newton->work().newton) / double(newton->work().steps);
    // Linear: the ratio is exact up to the rounding of u + correction.
    entry.comparisons.push_back(
        {"contraction at c = " + short_text(c) + " N/m", predicted, measured, 1e-6 * predicted});
    entry.table.push_back(
        {short_text(c) + " N/m", short_text(predicted, 5), short_text(measured, 5), short_text(iterations, 3)});
    seen.add(c, measured);
  }
  for (const double c : {1e3, 1e9})
  {
    line.add(c, compliance * c);
  }
  chart.panels[0].curves = {line, seen};
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

} // namespace gestell::apps
