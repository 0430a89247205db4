#include "coupling/modes/swept_coordinate.h"

#include "fem/values/nearest_name.h"
#include "mechanism/joints/constraint_element.h"

#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using mechanism::ConstraintElement;

const ConstraintElement *driven_joint(const ElementPlacement &placement)
{
  const auto *joint = dynamic_cast<const ConstraintElement *>(placement.element.get());
  return joint && joint->work() == mechanism::Work::input ? joint : nullptr;
}

std::vector<SweptCoordinate> of_bodies(const Machine &machine)
{
  std::vector<SweptCoordinate> all;
  const auto                   add = [&](const std::string &name, const std::string &unit, int coordinate)
  {
    SweptCoordinate own{name, unit};
    own.full_turn  = unit == "rad";
    own.coordinate = coordinate;
    all.push_back(own);
  };
  for (const Body &body : machine.model().bodies())
    switch (body.kind)
    {
    case BodyKind::rotor:
      add(body.name + ".angle", "rad", body.coordinate);
      break;
    case BodyKind::slider:
      add(body.name + ".displacement", "m", body.coordinate);
      break;
    case BodyKind::point:
    case BodyKind::planar:
    case BodyKind::rigid: // of its centre of mass; its rotation is not a single coordinate
      for (int i = 0; i < 3; ++i)
        add(machine.coordinate_name(body.coordinate + i), body.kind == BodyKind::planar && i == 2 ? "rad" : "m",
            body.coordinate + i);
    }
  return all;
}

std::vector<SweptCoordinate> all_swept(const Machine &machine)
{
  std::vector<SweptCoordinate> all = of_bodies(machine);
  int                          row = 0;
  for (std::size_t e = 0; e < machine.model().elements().size(); ++e)
  {
    const ElementPlacement &placement = machine.model().elements()[e];
    if (const ConstraintElement *joint = driven_joint(placement))
    {
      const bool      turns = joint->quantities().front().unit == "N m";
      SweptCoordinate own{placement.name, turns ? "rad" : "m"};
      own.full_turn = turns;
      own.joint     = int(e);
      own.row       = row;
      all.push_back(own);
    }
    row += n_constraints(*placement.element);
  }
  for (const std::string &path : machine.model().signal_paths())
    if (const Signal signal = machine.signal(path, path); signal.measure >= 0 && signal.quantity == 0)
    {
      SweptCoordinate own{path, signal.unit};
      own.measure = path.substr(0, path.rfind('.'));
      all.push_back(own);
    }
  return all;
}

Eigen::VectorXd measures_of(const Machine &machine, int element, const Eigen::VectorXd &q)
{
  int first = 0;
  for (int e = 0; e < element; ++e)
    first += machine.model().elements()[std::size_t(e)].element->n_measures();
  return (machine.forces().directions().transpose() * q)
      .segment(first, machine.model().elements()[std::size_t(element)].element->n_measures());
}

} // namespace

SweptCoordinate swept_coordinate(const Machine &machine, const std::string &name)
{
  const std::vector<SweptCoordinate> all = all_swept(machine);
  std::vector<std::string>           names;
  for (const SweptCoordinate &one : all)
  {
    if (one.name == name)
      return one;
    names.push_back(one.name);
  }
  // A body of one coordinate, the angle of a planar body, or a measure, by its own name.
  for (const SweptCoordinate &one : all)
    for (const char *end : {".angle", ".displacement", ".value"})
      if (one.name == name + end)
        return one;
  for (const Body &body : machine.model().bodies())
    if (body.kind != BodyKind::point && body.kind != BodyKind::rigid)
      names.push_back(body.name);
  for (const SweptCoordinate &one : all)
    if (!one.measure.empty())
      names.push_back(one.measure);
  if (names.empty())
    throw std::invalid_argument("there is no coordinate \"" + name +
                                "\": the machine has no body, measure or driven joint to vary");
  throw std::invalid_argument("there is no coordinate \"" + name + "\"" + suggestion(name, names));
}

double swept_value(const Machine &machine, const SweptCoordinate &coordinate, const Eigen::VectorXd &q)
{
  if (coordinate.coordinate >= 0)
    return q[coordinate.coordinate];
  if (coordinate.joint < 0)
    return machine.model().measure(coordinate.measure).evaluate(q, Eigen::VectorXd::Zero(q.size())).s;
  const Eigen::VectorXd u = measures_of(machine, coordinate.joint, q);
  return driven_joint(machine.model().elements()[std::size_t(coordinate.joint)])->driven_value(u.data());
}

KnownStart position_at(Machine &machine, const SweptCoordinate &coordinate, const InitialState &state, double x)
{
  KnownStart known;
  known.state   = state;
  known.state.v = Eigen::VectorXd::Zero(machine.size());
  known.q_given.assign(std::size_t(machine.size()), 0);
  known.v_given = known.q_given;
  if (coordinate.coordinate >= 0)
  {
    known.state.q[coordinate.coordinate]              = x;
    known.q_given[std::size_t(coordinate.coordinate)] = 1;
  }
  else if (coordinate.joint < 0)
    known.measures.emplace_back(coordinate.measure, x);
  else
  {
    // s - f(t) at the start of the law, and its distance from x.
    LocalState local;
    local.resize(machine);
    machine.gather(state.t, state.q, known.state.v, known.state.v, local);
    machine.events().start(local);
    Eigen::VectorXd    g(machine.joints().n_rows());
    ConstraintJacobian G(machine.joints().blocks());
    machine.joints().constraints(local, g, G);
    known.shifts.emplace_back(coordinate.row, g[coordinate.row] + x - swept_value(machine, coordinate, state.q));
  }
  return known;
}

} // namespace gestell::coupling
