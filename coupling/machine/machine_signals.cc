#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"
#include "fem/values/nearest_name.h"

#include <cmath>

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

std::map<std::string, Signal> MachineParts::signals() const
{
  std::map<std::string, Signal> signals;
  const auto                    add_motion =
      [&](const std::string &path, const std::string &rate_path, const std::string &unit, const Measure &u)
  {
    signals[path]      = {path, unit, u, {}, -1, -1, 1., 0.};
    signals[rate_path] = {rate_path, unit + "/s", {}, u, -1, -1, 1., 0.};
  };
  const auto add_acceleration = [&](const std::string &path, const std::string &unit, const Measure &u)
  {
    Signal &signal = signals[path];
    signal.name    = path;
    signal.unit    = unit + "/s^2";
    signal.on_a    = u;
  };

  for (const auto &[name, marker] : markers)
    if (name.rfind("frame.", 0) == 0)
      for (int i = 0; i < 6; ++i)
      {
        const Measure    &u    = i < 3 ? marker.translation[i] : marker.rotation[i - 3];
        const std::string path = name + "." + motions[i];
        add_motion(path, path + "_rate", motion_units[i], u);
        add_acceleration(path + "_acceleration", motion_units[i], u);
      }

  for (const Body &body : bodies)
    if (body.kind == BodyKind::rotor)
    {
      add_motion(body.name + ".angle", body.name + ".speed", "rad", {{body.coordinate, 1.}});
      add_acceleration(body.name + ".acceleration", "rad", {{body.coordinate, 1.}});
    }
    else if (body.kind != BodyKind::slider)
    {
      for (int d = 0; d < 3; ++d)
        if (const Measure &u = body.marker.translation[d]; !u.empty())
        {
          const std::string axis(1, "xyz"[d]), position = body.name + "." + axis;
          add_motion(body.name + ".u" + axis, body.name + ".v" + axis, "m", u);
          add_acceleration(body.name + ".a" + axis, "m", u);
          signals[position]        = signals[body.name + ".u" + axis];
          signals[position].name   = position;
          signals[position].offset = body.centre[d];
        }
      if (body.kind == BodyKind::planar)
      {
        add_motion(body.name + ".angle", body.name + ".speed", "rad", {{body.coordinate + 2, 1.}});
        add_acceleration(body.name + ".acceleration", "rad", {{body.coordinate + 2, 1.}});
      }
    }
    else
    {
      add_motion(body.name + ".displacement", body.name + ".velocity", "m", {{body.coordinate, 1.}});
      add_acceleration(body.name + ".acceleration", "m", {{body.coordinate, 1.}});
    }

  if (reduced || full)
  {
    const Eigen::Map<const Eigen::Vector3d> g(gravity.data());
    for (const fem::FrameOutput &output : reduced ? reduced->outputs : full->outputs)
    {
      const std::string path = "frame." + output.name;
      signals[path]          = {path, output.unit, measure_of_row(output.on_q),     measure_of_row(output.on_v), -1,
                                -1,   1.,          output.under_acceleration.dot(g)};
    }
  }

  for (const auto &element : linear)
  {
    add_motion(element.name + ".displacement", element.name + ".rate", element.unit == "N m" ? "rad" : "m", element.u);
    signals[element.name + ".force"] = {
        element.name + ".force", element.unit, element.stiffness * element.u, element.damping * element.u, -1, -1, 1.,
        element.offset};
    if (element.unit == "N m")
      signals[element.name + ".torque"] = signals[element.name + ".force"];
  }

  for (std::size_t i = 0; i < loads.size(); ++i)
  {
    const Load &load  = loads[i];
    Signal     &force = signals[load.name + ".force"];
    force.name        = load.name + ".force";
    force.unit        = load.unit;
    force.load        = static_cast<int>(i);
    if (load.unit == "N m")
      signals[load.name + ".torque"] = force;
  }

  const auto add_measure = [&](int i, int derivative, const std::string &path, double offset)
  {
    Signal signal;
    signal.name     = path;
    signal.unit     = measures[i].unit + (derivative == 0 ? "" : derivative == 1 ? "/s" : "/s^2");
    signal.measure  = i;
    signal.quantity = derivative;
    signal.offset   = offset;
    for (const Measure &u : measures[i].measures) // so that whoever reads the signal provides their motion
      for (const auto &[coordinate, weight] : u)
        signal.on_q.emplace_back(coordinate, 0.);
    signals[path] = signal;
  };
  std::vector<char> of_place(measures.size(), 0);
  for (const NamedPlace &place : places)
    for (int d = 0; d < 3; ++d)
    {
      const std::string axis(1, "xyz"[d]);
      const int         i = place.first_measure + d;
      of_place[i]         = 1;
      add_measure(i, 0, place.name + "." + axis, 0.);
      add_measure(i, 0, place.name + ".u" + axis, -place.start[d]);
      add_measure(i, 1, place.name + ".v" + axis, 0.);
      add_measure(i, 2, place.name + ".a" + axis, 0.);
    }
  for (std::size_t i = 0; i < measures.size(); ++i)
    if (!of_place[i])
    {
      add_measure(int(i), 0, measures[i].name + ".value", 0.);
      add_measure(int(i), 1, measures[i].name + ".rate", 0.);
      add_measure(int(i), 2, measures[i].name + ".acceleration", 0.);
    }

  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const auto quantities = elements[e].element->quantities();
    const bool turns      = elements[e].kind == MeasureKind::angle;
    for (std::size_t i = 0; i < quantities.size(); ++i)
    {
      const std::string path = elements[e].name + "." + quantities[i].name;
      const std::string unit = turns ? torsional(quantities[i].unit) : quantities[i].unit;
      signals[path]          = {path, unit, {}, {}, static_cast<int>(e), static_cast<int>(i), 1., 0.};
    }
    if (turns)
      for (const auto &[name, alias] : {std::pair{".force", ".torque"}, std::pair{".displacement", ".angle"}})
        if (const auto found = signals.find(elements[e].name + name); found != signals.end())
          signals[elements[e].name + alias] = found->second;
  }
  signals["t"]      = {"t", "s", {}, {}};
  signals["t"].on_t = 1.;
  return signals;
}

std::vector<std::string> Machine::signal_paths() const
{
  std::vector<std::string> paths;
  for (const auto &entry : parts_->signals())
    paths.push_back(entry.first);
  return paths;
}

Signal MachineParts::signal(const std::string &path) const
{
  const bool        minus    = !path.empty() && path[0] == '-';
  const auto        begin    = minus ? path.find_first_not_of("- ") : 0;
  const std::string positive = begin == std::string::npos ? path : path.substr(begin); // "-" alone names nothing
  const auto        known    = signals();
  const auto        found    = known.find(positive);
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

Signal Machine::signal(const std::string &name, const std::string &path) const
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

int Machine::coordinate(const std::string &name) const
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

double Machine::evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                         const Eigen::VectorXd &a, const LocalState &local) const
{
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
