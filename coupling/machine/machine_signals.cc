#include "coupling/integration/system/convergence_failure.h"
#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{
constexpr const char *motions[]      = {"ux", "uy", "uz", "rx", "ry", "rz"};
constexpr const char *motion_units[] = {"m", "m", "m", "rad", "rad", "rad"};

Measure measure_of_row(const Eigen::VectorXd &row)
{
  Measure result;
  for (int i = 0; i < row.size(); ++i)
    if (row[i] != 0.)
      result.emplace_back(i, row[i]);
  return result;
}

/// Unit of the same quantity on an angle.
std::string torsional(const std::string &unit)
{
  return unit == "N" ? "N m" : unit == "m" ? "rad" : unit == "m/s" ? "rad/s" : unit;
}

} // namespace

double MachineParts::Load::at(double t) const
{
  double f = constant;
  for (const Oscillation &part : oscillations)
    f += part.amplitude * std::sin(part.omega * t + part.phase);
  return f;
}

namespace
{

/// Collects all signals of a machine, by path.
class SignalList
{
public:
  explicit SignalList(const MachineParts &parts) : parts_(parts) {}

  std::map<std::string, Signal> all()
  {
    add_interfaces();
    for (const Body &body : parts_.bodies)
      add_body(body);
    add_frame_outputs();
    for (const MachineParts::LinearElement &element : parts_.linear)
      add_linear(element);
    for (std::size_t i = 0; i < parts_.loads.size(); ++i)
      add_load(i);
    add_measures();
    for (std::size_t e = 0; e < parts_.elements.size(); ++e)
      add_element(e);
    signals_["t"]      = {"t", "s", {}, {}};
    signals_["t"].on_t = 1.;
    return std::move(signals_);
  }

private:
  void add_motion(const std::string &path, const std::string &rate_path, const std::string &unit, const Measure &u)
  {
    signals_[path]      = {path, unit, u, {}, -1, -1, 1., 0.};
    signals_[rate_path] = {rate_path, unit + "/s", {}, u, -1, -1, 1., 0.};
  }

  void add_acceleration(const std::string &path, const std::string &unit, const Measure &u)
  {
    Signal &signal = signals_[path];
    signal.name    = path;
    signal.unit    = unit + "/s^2";
    signal.on_a    = u;
  }

  void add_interfaces()
  {
    for (const auto &[name, marker] : parts_.markers)
      if (name.rfind("frame.", 0) == 0)
        for (int i = 0; i < 6; ++i)
        {
          const Measure    &u    = i < 3 ? marker.translation[i] : marker.rotation[i - 3];
          const std::string path = name + "." + motions[i];
          add_motion(path, path + "_rate", motion_units[i], u);
          add_acceleration(path + "_acceleration", motion_units[i], u);
        }
  }

  void add_body(const Body &body)
  {
    if (body.kind == BodyKind::rotor)
      add_angle(body.name, body.coordinate);
    else if (body.kind == BodyKind::slider)
    {
      add_motion(body.name + ".displacement", body.name + ".velocity", "m", {{body.coordinate, 1.}});
      add_acceleration(body.name + ".acceleration", "m", {{body.coordinate, 1.}});
    }
    else
    {
      add_translations(body);
      if (body.kind == BodyKind::planar)
        add_angle(body.name, body.coordinate + 2);
    }
  }

  void add_angle(const std::string &body, int coordinate)
  {
    add_motion(body + ".angle", body + ".speed", "rad", {{coordinate, 1.}});
    add_acceleration(body + ".acceleration", "rad", {{coordinate, 1.}});
  }

  void add_translations(const Body &body)
  {
    for (int d = 0; d < 3; ++d)
      if (const Measure &u = body.marker.translation[d]; !u.empty())
      {
        const std::string axis(1, "xyz"[d]), position = body.name + "." + axis;
        add_motion(body.name + ".u" + axis, body.name + ".v" + axis, "m", u);
        add_acceleration(body.name + ".a" + axis, "m", u);
        signals_[position]        = signals_[body.name + ".u" + axis];
        signals_[position].name   = position;
        signals_[position].offset = body.centre[d];
      }
  }

  void add_frame_outputs()
  {
    if (!parts_.reduced && !parts_.full)
      return;
    const Eigen::Map<const Eigen::Vector3d> g(parts_.gravity.data());
    for (const fem::FrameOutput &output : parts_.reduced ? parts_.reduced->outputs : parts_.full->outputs)
    {
      const std::string path = "frame." + output.name;
      signals_[path]         = {path,
                                output.unit,
                                measure_of_row(output.on_q),
                                measure_of_row(output.on_v),
                                -1,
                                -1,
                                1.,
                                output.under_acceleration.dot(g) + output.constant};
      signals_[path].on_a    = measure_of_row(output.on_a);
    }
  }

  void add_linear(const MachineParts::LinearElement &element)
  {
    const bool        turns = element.unit == "N m";
    const std::string force = element.name + ".force";
    add_motion(element.name + ".displacement", element.name + ".rate", turns ? "rad" : "m", element.u);
    signals_[force] = {force, element.unit,  element.stiffness * element.u, element.damping * element.u, -1, -1,
                       1.,    element.offset};
    if (turns)
      signals_[element.name + ".torque"] = signals_[force];
  }

  void add_load(std::size_t i)
  {
    const MachineParts::Load &load  = parts_.loads[i];
    Signal                   &force = signals_[load.name + ".force"];
    force.name                      = load.name + ".force";
    force.unit                      = load.unit;
    force.load                      = static_cast<int>(i);
    if (load.unit == "N m")
      signals_[load.name + ".torque"] = force;
  }

  void add_measures()
  {
    std::vector<char> of_place(parts_.measures.size(), 0);
    for (const MachineParts::NamedPlace &place : parts_.places)
      for (int d = 0; d < 3; ++d)
      {
        const std::string axis(1, "xyz"[d]);
        const int         i = place.first_measure + d;
        of_place[i]         = 1;
        add_measure(i, 0, place.name + "." + axis);
        add_measure(i, 0, place.name + ".u" + axis).offset = -place.start[d];
        add_measure(i, 1, place.name + ".v" + axis);
        add_measure(i, 2, place.name + ".a" + axis);
      }
    for (std::size_t i = 0; i < parts_.measures.size(); ++i)
      if (!of_place[i])
      {
        add_measure(int(i), 0, parts_.measures[i].name + ".value");
        add_measure(int(i), 1, parts_.measures[i].name + ".rate");
        add_measure(int(i), 2, parts_.measures[i].name + ".acceleration");
      }
  }

  Signal &add_measure(int i, int derivative, const std::string &path)
  {
    const NamedMeasure &measure = parts_.measures[i];
    Signal              signal;
    signal.name     = path;
    signal.unit     = measure.unit + (derivative == 0 ? "" : derivative == 1 ? "/s" : "/s^2");
    signal.measure  = i;
    signal.quantity = derivative;
    for (const Measure &u : measure.measures) // so that the reader provides their motion
      for (const auto &[coordinate, weight] : u)
        signal.on_q.emplace_back(coordinate, 0.);
    return signals_[path] = signal;
  }

  void add_element(std::size_t e)
  {
    const ElementPlacement &placement  = parts_.elements[e];
    const auto              quantities = placement.element->quantities();
    const bool              turns      = placement.kind == MeasureKind::angle;
    for (std::size_t i = 0; i < quantities.size(); ++i)
    {
      const std::string path = placement.name + "." + quantities[i].name;
      const std::string unit = turns ? torsional(quantities[i].unit) : quantities[i].unit;
      signals_[path]         = {path, unit, {}, {}, static_cast<int>(e), static_cast<int>(i), 1., 0.};
    }
    if (turns)
      for (const auto &[name, alias] : {std::pair{".force", ".torque"}, std::pair{".displacement", ".angle"}})
        if (const auto found = signals_.find(placement.name + name); found != signals_.end())
          signals_[placement.name + alias] = found->second;
  }

  const MachineParts           &parts_;
  std::map<std::string, Signal> signals_;
};

} // namespace

std::map<std::string, Signal> MachineParts::signals() const
{
  return known_signals.empty() ? SignalList(*this).all() : known_signals;
}

std::vector<std::string> MachineModel::signal_paths() const
{
  std::vector<std::string> paths;
  for (const auto &entry : parts_->signals())
    paths.push_back(entry.first);
  return paths;
}

bool MachineParts::has_motion(const std::string &name) const
{
  const auto is_it = [&](const auto &part) { return part.name == name; };
  return std::any_of(bodies.begin(), bodies.end(), is_it) || std::any_of(measures.begin(), measures.end(), is_it);
}

Signal MachineParts::signal(const std::string &path) const
{
  const bool        minus    = !path.empty() && path[0] == '-';
  const auto        begin    = minus ? path.find_first_not_of("- ") : 0;
  const std::string positive = begin == std::string::npos ? path : path.substr(begin); // "-" without a name is invalid
  const auto        made     = known_signals.empty() ? signals() : std::map<std::string, Signal>();
  const auto       &known    = known_signals.empty() ? made : known_signals;
  auto              found    = known.find(positive);
  for (const char *ending : {".angle", ".displacement", ".value"}) // the one motion of a body or a measure
    if (found == known.end() && has_motion(positive))
      found = known.find(positive + ending);
  if (found == known.end())
  {
    std::vector<std::string> paths;
    for (const auto &entry : known)
      paths.push_back(entry.first);
    throw std::invalid_argument("there is no \"" + positive + "\"" + suggestion(positive, paths));
  }
  Signal signal = found->second;
  if (minus)
    signal.scale = -1.;
  return signal;
}

Signal MachineModel::signal(const std::string &name, const std::string &path) const
{
  try
  {
    Signal signal = parts_->signal(path);
    signal.name   = name;
    return signal;
  }
  catch (const std::invalid_argument &unknown)
  {
    throw std::invalid_argument("signal \"" + name + "\": " + unknown.what());
  }
}

int MachineModel::coordinate(const std::string &name) const
{
  std::vector<std::string> names;
  for (int i = 0; i < size(); ++i)
  {
    names.push_back(coordinate_name(i));
    if (names.back() == name)
      return i;
  }
  throw std::invalid_argument("there is no coordinate \"" + name + "\"" + suggestion(name, names));
}

bool Signal::reads_acceleration() const
{
  return !on_a.empty() || (measure >= 0 && quantity == 2) ||
         (computed && std::any_of(computed->of.begin(), computed->of.end(),
                                  [](const Signal &part) { return part.reads_acceleration(); }));
}

Signal computed_signal(const std::string &name, const std::string &unit, const mechanism::UserFunction &function,
                       const std::vector<Signal> &of)
{
  auto computed      = std::make_shared<ComputedSignal>();
  computed->function = function;
  computed->of       = of;
  Signal signal;
  signal.name = name;
  signal.unit = unit;
  for (const Signal &part : of) // so that the reader provides their motion
    for (const Measure *measure : {&part.on_q, &part.on_v})
      for (const auto &[coordinate, weight] : *measure)
        signal.on_q.emplace_back(coordinate, 0.);
  signal.computed = std::move(computed);
  return signal;
}

namespace
{
/// @throws ConvergenceFailure for the first value that is none
double computed_value(const Signal &signal, const std::vector<double> &arguments)
{
  double                value = std::numeric_limits<double>::quiet_NaN();
  const ComputedSignal &own   = *signal.computed;
  if (own.failed)
    return value;
  std::string failure = "returned a value that is not a finite number";
  try
  {
    own.function({arguments.data(), int(arguments.size())}, {}, &value, 1);
  }
  catch (const std::exception &raised)
  {
    failure = raised.what();
  }
  if (std::isfinite(value))
    return value;
  own.failed = true;
  throw ConvergenceFailure("the function of the signal \"" + signal.name + "\" " + failure, "signal-without-value",
                           signal.name);
}
} // namespace

double Machine::evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                         const Eigen::VectorXd &a, const LocalState &local) const
{
  if (signal.computed)
  {
    std::vector<double> arguments;
    for (const Signal &part : signal.computed->of)
      arguments.push_back(evaluate(part, q, v, a, local));
    return signal.scale * computed_value(signal, arguments);
  }
  double value = signal.offset + signal.on_t * local.t;
  for (const auto &[i, weight] : signal.on_q)
    value += weight * q[i];
  for (const auto &[i, weight] : signal.on_v)
    value += weight * v[i];
  for (const auto &[i, weight] : signal.on_a)
    value += weight * a[i];
  if (signal.reads_acceleration() && signal.measure >= 0)
    value += parts_->measures[signal.measure].acceleration(q, v, a);
  else if (signal.measure >= 0)
  {
    const auto measured = parts_->measures[signal.measure].evaluate(q, v);
    value += signal.quantity == 0 ? measured.s : measured.rate;
  }
  if (signal.load >= 0)
    value += parts_->loads[signal.load].at(local.t);
  if (signal.element >= 0)
  {
    const auto &part = parts_->placed[signal.element];
    value += part.element->quantity(signal.quantity, part.motion(local, parts_->by_history), parts_->history_of(part));
  }
  return signal.scale * value;
}

} // namespace gestell::coupling
