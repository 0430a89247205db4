#include "tests/support/output_example.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double height = 2.;

/// Box 1 x 1 x 2 m with two coordinates: sway of the top in x, lift of the whole in z.
void add_box(Scenery &scenery)
{
  for (const double z : {0., height})
    for (const auto &[x, y] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}})
      scenery.points.push_back({x, y, z});
  for (int i = 0; i < 4; ++i)
  {
    const int k = (i + 1) % 4;
    scenery.triangles.push_back({i, k, k + 4});
    scenery.triangles.push_back({i, k + 4, i + 4});
  }
  scenery.triangles.insert(scenery.triangles.end(), {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}});
  scenery.n_frame      = 2;
  scenery.displacement = [points = scenery.points](const Eigen::VectorXd &p) -> Eigen::VectorXd
  {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * static_cast<long>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      u(3 * static_cast<long>(i))     = p(0) * points[i][2] / height;
      u(3 * static_cast<long>(i) + 2) = p(1);
    }
    return u;
  };
}

/// Crank at the top of the box about y, its pin up at angle 0; the slide moves down.
void add_mechanism(Scenery &scenery)
{
  coupling::Marker top{"frame.crown", {{{{0, 1.}}, {}, {{1, 1.}}}}, {}};
  scenery.interfaces = {top};
  scenery.interface_positions.emplace_back("crown", std::array<double, 3>{0.5, 0.5, height});

  coupling::Body crank;
  crank.name               = "crank";
  crank.kind               = coupling::BodyKind::rotor;
  crank.coordinate         = 2;
  crank.axis               = {0., 1., 0.};
  crank.position           = {0.5, 0.5, height};
  crank.radius             = 0.3;
  crank.marker             = top;
  crank.marker.rotation[1] = {{2, 1.}};

  coupling::Body slide;
  slide.name                  = "slide";
  slide.kind                  = coupling::BodyKind::slider;
  slide.coordinate            = 3;
  slide.axis                  = {0., 0., -1.};
  slide.position              = {0.5, 0.5, 1.2};
  slide.size                  = {0.5, 0.4, 0.3};
  slide.marker.translation[2] = {{3, -1.}};

  scenery.bodies = {crank, slide};
  scenery.rods   = {{"rod", "crank", "slide", 0.1, 0.8}};
}

coupling::RunResult shock(int n_rows)
{
  coupling::RunResult run;
  run.columns = {"t", "F_P", "F_u", "x1", "x3", "energy_input", "energy_stored", "energy_dissipated"};
  run.units   = {"s", "N", "N", "m", "m", "J", "J", "J"};
  for (int i = 0; i < n_rows; ++i)
  {
    const double t = 0.45 * i / (n_rows - 1.), after = t - 0.24;
    const double ring = after > 0. ? std::exp(-25. * after) * std::cos(2. * M_PI * 85. * after) : 0.;
    const double push = t > 0.19 && after < 0. ? 1e6 * std::sin(M_PI / 2. * (t - 0.19) / 0.05) : 0.;
    const double work = 1900. * std::min(1., std::max(0., (t - 0.19) / 0.05));
    run.rows.insert(run.rows.end(), {t, push + 6e5 * ring, push, 6e-4 + 2e-4 * ring, 0.117 + 0.045 * std::sin(6. * t),
                                     1.05 * work, -0.1 * work, 1.15 * work - 0.5});
  }
  run.signals = {{"F_P", "N", -6.01e5, 0.2449, 1.0566e6, 0.2341, 1. / 3.}, {"x3", "m", 0.117, 0., 0.162, 0.26, 0.13}};
  run.events  = {{0.1949225964204286, "tool", "tool_contact"}, {0.2396, "tool", "through"}, {0.2415, "rod", "open"}};
  run.work    = {{45000, 2, 61000, 3, 61003, 180000}, 1};
  run.energy  = {1995., -190., 2184.5, 0.5, 2200.};
  run.warn("divided-steps", "run.step", "The step was halved once at t = 0.2415 s.");
  run.picture_times = {0., 0.2, 0.24};
  for (const double angle : {2.1, 2.6, 2.8})
    run.picture_states.push_back((Eigen::VectorXd(4) << 1e-4, 2e-4, angle, 0.12).finished());
  return run;
}

coupling::Mode mode(double f, double zeta, const Eigen::VectorXd &shape)
{
  return {f, f * std::sqrt(1. - zeta * zeta), zeta, {100., 0., 2. / 3.}, 0., shape};
}

void add_model(ModelFacts &model)
{
  model.dofs = 4, model.interface = 2, model.modes = 0, model.nonlinear = 3;
  model.frame_dofs = 150000, model.cells = 40000;
  model.frame_mass = 22500., model.frequency_error = 0.004, model.static_residual = 1e-5;
}

} // namespace

Result example_result(int n_rows)
{
  Result result;
  result.scene       = "press \"example\" <1>";
  result.description = "A press that was made up.";
  result.version     = "0.1.0";
  result.command     = "run";
  result.settings    = "BDF2, h = 10 µs";
  add_model(result.model);
  result.wall_s   = {{"mesh", 3.25}, {"run", 0.21}};
  result.run      = shock(n_rows);
  result.warnings = {"The mesh is coarse."};
  add_box(result.scenery);
  add_mechanism(result.scenery);
  result.frame_modes      = {mode(20., 0.02, Eigen::Vector2d(1e-2, 0.)), mode(85., 0.02, Eigen::Vector2d(0., 1e-2))};
  result.coupled_modes    = {mode(11.58486756566711, 0.0857, Eigen::Vector4d(0., 0., 0.06, 1e-3))};
  result.coordinate_names = {"frame.crown.ux", "frame.crown.uz", "crank.angle", "slide.displacement"};
  return result;
}

Result with_stress(Result result)
{
  const auto   n = static_cast<Eigen::Index>(result.scenery.points.size());
  StressResult stress;
  for (const auto &x : result.scenery.points)
    stress.points.emplace_back(x[0], x[1], x[2]);
  stress.triangles = result.scenery.triangles;
  stress.n_states  = 4500;
  stress.step      = 1e-4;

  StressAt at;
  at.label        = "largest F_P";
  at.t            = 0.2341;
  at.displacement = Eigen::Matrix3Xd::Zero(3, n);
  at.displacement.row(0).setConstant(1e-4);
  at.field.components.setZero(6, n);
  at.field.von_mises         = 10e6 * Eigen::VectorXd::LinSpaced(n, 1., double(n));
  at.field.components.row(2) = at.field.von_mises.transpose();
  const auto place           = [&](Eigen::Index i, double disagreement, const std::string &nearby)
  {
    return StressPlace{stress.points[i], at.field.von_mises[i],
                       coupling::principal_stresses(at.field.at(static_cast<int>(i))), disagreement, nearby};
  };
  at.peak         = place(n - 1, 0.2, "");
  at.beside_rigid = place(0, 0.5, "support feet");
  stress.instants = {at};
  result.stress   = stress;
  return result;
}

coupling::MeshReport chequered(int n, int m)
{
  coupling::MeshReport report;
  const int            k = n * m;
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i <= k; ++i)
      report.picture.points.push_back({double(i) / k, double(j) / k, 0.});
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i)
    {
      const int a = j * (k + 1) + i;
      report.picture.triangles.push_back({a, a + 1, a + k + 2});
      report.picture.triangles.push_back({a, a + k + 2, a + k + 1});
      report.picture.face.insert(report.picture.face.end(), 2, j / m * n + i / m);
    }
  for (int face = 0; face < n * n; ++face)
  {
    report.surfaces.push_back(
        {face + 1, face == 3 ? "</script>" : "", "plane", "box = {}\n", 1. / (n * n), {}, {1., 1., 0.}, {}});
    report.surfaces.back().kind = "plane";
  }
  report.unit = {1e-3, "mm"};
  return report;
}

} // namespace gestell::apps
