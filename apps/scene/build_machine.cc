#include "apps/scene/build_machine.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr Eigen::Index largest_dense_frame = 500; // coordinates; above, sparse solves win

/// Heads what the machine says against a name with the place in the scene.
template <typename Make>
auto placed(const std::string &place, Make make)
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument &e)
  {
    throw std::invalid_argument(place + ": " + e.what());
  }
}

coupling::Measure measure_of(const MotionMeasure &motion, const coupling::Machine &machine)
{
  using coupling::operator+, coupling::operator*; // a Measure is a plain vector, so the namespace does not tell
  coupling::Measure u;
  for (const auto &term : motion)
  {
    const auto &marker = machine.marker(term.marker);
    u                  = u + term.weight * (term.rotation ? marker.about(term.axis) : marker.along(term.axis));
  }
  return u;
}

void add_body(coupling::Machine &machine, const BodyRequest &body)
{
  if (body.kind == coupling::BodyKind::rotor)
    machine.add_rotor(body.name, body.axis, body.inertia, body.mass, body.carrier);
  else
    machine.add_slider(body.name, body.axis, body.mass, body.carrier);
  machine.draw(body.name, body.position, body.radius, body.size);
}

void fill(coupling::Machine &machine, const Scene &scene)
{
  for (const auto &body : scene.bodies)
    placed(body.place, [&] { add_body(machine, body); });
  const auto place = [&](const std::string &element) { return scene.element_places.at(element); };
  for (const auto &point : scene.point_masses)
    placed(place(point.name),
           [&] { machine.add_point_mass(point.name, point.marker, point.mass, point.inertia, point.offset); });
  for (const auto &spring : scene.linear)
    placed(place(spring.name),
           [&]
           {
             machine.add_linear(spring.name, measure_of(spring.u, machine), spring.stiffness, spring.damping,
                                spring.preload, spring.rest, spring.force_unit);
           });
  for (const auto &element : scene.elements)
    placed(place(element.name),
           [&]
           {
             std::vector<coupling::Measure> measures;
             for (const auto &motion : element.measures)
               measures.push_back(measure_of(motion, machine));
             machine.attach(element.name, element.element, measures);
           });
  for (const auto &rod : scene.rods)
    machine.draw_rod(rod);
  machine.finish();
}

template <typename Frame>
coupling::Machine machine_on(const Scene &scene, Frame frame)
{
  coupling::Machine machine;
  machine.set_gravity(scene.gravity);
  machine.set_frame(std::move(frame));
  fill(machine, scene);
  return machine;
}

/// Coordinates of the frame: those of interfaces, ascending, then the others.
std::vector<int> interface_first(const fem::FrameMatrices &frame)
{
  std::vector<int>  order = frame.interface_coordinates();
  std::vector<bool> taken(frame.M.rows(), false);
  for (const int i : order)
    taken[i] = true;
  for (int i = 0; i < frame.M.rows(); ++i)
    if (!taken[i])
      order.push_back(i);
  return order;
}

} // namespace

FramePath frame_path(const Scene &scene)
{
  const bool reduce = scene.reduction.method == ReductionMethod::craig_bampton;
  switch (scene.frame.source)
  {
  case FrameSource::none:
    return FramePath::none;
  case FrameSource::geometry:
    return reduce ? FramePath::reduce : FramePath::sparse;
  case FrameSource::reduced_file:
    return FramePath::from_file;
  case FrameSource::matrices:
    break;
  }
  return reduce                                                 ? FramePath::reduce
         : scene.frame.matrices.M.rows() <= largest_dense_frame ? FramePath::dense
                                                                : FramePath::sparse;
}

coupling::Machine build_machine(const Scene &scene)
{
  if (scene.frame.source == FrameSource::matrices)
    return machine_on(scene, placed(scene.frame.place, [&] { return dense_frame(scene.frame.matrices); }));
  coupling::Machine machine;
  machine.set_gravity(scene.gravity);
  fill(machine, scene);
  return machine;
}

coupling::Machine build_machine(const Scene &scene, coupling::ReducedFrame frame)
{
  return machine_on(scene, std::move(frame));
}

coupling::Machine build_machine(const Scene &scene, fem::FrameMatrices frame)
{
  return machine_on(scene, std::move(frame));
}

coupling::ReducedFrame dense_frame(const fem::FrameMatrices &frame)
{
  const auto             order = interface_first(frame);
  const Eigen::MatrixXd  M = frame.M, B = frame.B, C = frame.C;
  coupling::ReducedFrame dense;
  dense.M           = M(order, order);
  dense.B           = B(order, order);
  dense.C           = C(order, order);
  dense.n_interface = frame.interface_coordinates().size();
  dense.modal       = false;
  dense.n_full      = M.rows();
  dense.mass        = frame.mass;

  std::vector<int> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    new_index[order[i]] = i;
  dense.interfaces = frame.interfaces;
  for (auto &interface : dense.interfaces)
    for (int &coordinate : interface.coordinate)
      coordinate = coordinate < 0 ? -1 : new_index[coordinate];
  for (const auto &output : frame.outputs)
    dense.outputs.push_back({output.name, output.unit, output.on_q(order), output.on_v(order)});
  dense.translations_load = (M * frame.translations)(order, Eigen::all);
  dense.total_mass        = frame.translations.transpose() * M * frame.translations;

  // C phi = omega^2 M phi, phi^T M phi = 1; modal damping is M Phi diag(2 zeta omega) Phi^T M.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(dense.C, dense.M);
  if (modes.eigenvalues().minCoeff() < -1e-9 * std::abs(modes.eigenvalues().maxCoeff()))
    throw std::invalid_argument("stiffness: has a negative eigenvalue; a frame at rest cannot push itself away");
  const Eigen::VectorXd omega = modes.eigenvalues().cwiseMax(0.).cwiseSqrt();
  const Eigen::MatrixXd Z     = dense.M * modes.eigenvectors();
  dense.B += Z * (2. * frame.modal_damping_ratio * omega).asDiagonal() * Z.transpose();
  dense.frequencies_hz  = omega / (2. * M_PI);
  dense.frequency_error = Eigen::VectorXd::Zero(omega.size());
  return dense;
}

std::vector<coupling::Signal> scene_signals(const Scene &scene, const coupling::Machine &machine)
{
  std::vector<coupling::Signal> signals;
  for (const auto &request : scene.signals)
    signals.push_back(placed(request.place, [&] { return machine.signal(request.name, request.path); }));
  return signals;
}

} // namespace gestell::apps
