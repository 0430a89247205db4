#include "tests/random_machines/draft.h"

#include <array>
#include <cstdio>
#include <vector>

namespace gestell::tests
{
namespace
{

using Point = std::array<double, 3>;

std::string text_of(const Point &p)
{
  return vector_text(p[0], p[1], p[2]);
}

/// With all digits: a point on an axis whose ends are rounded.
std::string exact_text(const Point &p)
{
  char text[96];
  std::snprintf(text, sizeof text, "[%.17g, %.17g, %.17g]", p[0], p[1], p[2]);
  return text;
}

/// Rigid bodies in space that hang on each other by joints of several kinds.
class SpatialTree
{
public:
  explicit SpatialTree(Draft &draft) : draft_(draft), dice_(draft.dice)
  {
    size_                 = dice_.log_between(0.05, 3.);
    mass_                 = dice_.log_between(0.1, 500.);
    omega_                = std::sqrt(9.81 / size_);
    draft.machine.jointed = true;
    draft.machine.linear = draft.machine.loadless = false;
    draft.machine.kind                            = "bodies in space";
    draft.line("gravity = [0, 0, -9.81]");
    set_times(draft, {mass_ * size_ * size_, omega_, 1.}, 0.5, 2.);
  }

  void write()
  {
    std::vector<Point> tips;
    for (int i = 0, n = 1 + dice_.whole(3); i < n; ++i)
    {
      const int   on  = dice_.whole(i + 1) - 1; // -1: the ground
      const Point pin = on < 0 ? Point{2. * size_ * i, 0., 0.} : tips[on];
      const Point tip = {pin[0] + size_ * dice_.between(-1., 1.), pin[1] + size_ * dice_.between(-1., 1.),
                         pin[2] - size_ * dice_.between(0.3, 1.)};
      add_body(pin, tip);
      add_joint(on < 0 ? "ground" : bodies_[on], bodies_.back(), pin);
      tips.push_back(tip);
    }
    for (int i = 0, n = dice_.whole(3); i < n; ++i)
      add_law(tips);
    draft_.table("start");
    if (turns_freely_ && dice_.chance(0.7))
      draft_.line("v = { \"body1.wx\" = " + digits(omega_ * dice_.between(-1., 1.)) +
                  ", \"body1.wy\" = " + digits(omega_ * dice_.between(-1., 1.)) +
                  ", \"body1.wz\" = " + digits(omega_ * dice_.between(-3., 3.)) + " }");
  }

private:
  void add_body(const Point &pin, const Point &tip)
  {
    const double mass = mass_ * dice_.log_between(0.2, 1.), along = dice_.between(0.4, 0.7), J = mass * size_ * size_;
    // No moment reaches the sum of the others.
    const double a = J * dice_.between(0.05, 0.2), b = J * dice_.between(0.05, 0.2), c = J * dice_.between(0.05, 0.2);
    bodies_.push_back("body" + std::to_string(bodies_.size() + 1));
    draft_.table("body." + bodies_.back());
    draft_.text("type", "rigid");
    draft_.number("mass", mass);
    draft_.line("inertia = " + vector_text(b + c, c + a, a + b));
    Point centre;
    for (int i = 0; i < 3; ++i)
      centre[i] = pin[i] + along * (tip[i] - pin[i]);
    draft_.line("position = " + text_of(centre));
    for (const char *signal : {".x", ".y", ".z", ".wx", ".wy", ".wz"})
      draft_.watch(bodies_.back() + signal);
  }

  std::string add_place(const std::string &body, const Point &at)
  {
    const std::string name = draft_.new_name("at");
    draft_.table("place." + name);
    draft_.text("on", body);
    draft_.line("at = " + exact_text(at));
    for (const char *axis : {".x", ".y", ".z"})
      draft_.watch(name + axis, size_);
    return name;
  }

  /// The point of both bodies stays together.
  void add_fact(const std::string &joint, const std::string &from, const std::string &to, const Point &at)
  {
    PinFact fact;
    fact.joint = joint;
    fact.b     = add_place(to, at);
    if (from != "ground")
      fact.a = add_place(from, at);
    fact.axes = {'x', 'y', 'z'};
    fact.size = size_;
    for (int i = 0; i < 3; ++i)
      fact.x[i] = at[i];
    draft_.machine.pins.push_back(fact);
  }

  void add_joint(const std::string &from, const std::string &to, const Point &at)
  {
    static const char *const kinds[] = {"spherical", "spherical", "revolute", "universal", "rigid"};
    const std::string        kind = kinds[dice_.whole(bodies_.size() == 1 ? 4 : 5)], name = draft_.new_name("joint");
    draft_.table("joint." + name);
    draft_.text("type", kind);
    draft_.text("from", from);
    draft_.text("to", to);
    draft_.line("at = " + text_of(at));
    const Point axis = {dice_.between(0.3, 1.), dice_.between(-1., 1.), dice_.between(-0.3, 0.3)};
    if (kind == "revolute")
      draft_.line("axis = " + text_of(axis));
    if (kind == "universal")
    {
      draft_.line("axis_from = [0, 0, 1]");
      draft_.line("axis_to = " + vector_text(axis[0], axis[1], 0.));
    }
    if (draft_.machine.wide && dice_.chance(0.3))
    {
      yields(kind);
      return;
    }
    if (bodies_.size() == 1)
      turns_freely_ = kind == "spherical";
    Point centre, nearby;
    for (int i = 0; i < 3; ++i)
    {
      centre[i] = rounded(at[i]);
      nearby[i] = centre[i] + rounded(size_) * rounded(axis[i]);
    }
    add_fact(name, from, to, centre);
    if (kind == "revolute" || kind == "rigid")
      add_fact(name, from, to, nearby);
  }

  void yields(const std::string &kind)
  {
    const double k    = mass_ * omega_ * omega_ * dice_.log_between(100., 1e4),
                 b    = mass_ * omega_ * dice_.log_between(0.1, 30.);
    const bool damped = dice_.chance(0.7), holds_rotations = kind != "spherical";
    draft_.number("stiffness", k);
    if (holds_rotations)
      draft_.number("rotational_stiffness", k * size_ * size_);
    if (!damped)
      return;
    draft_.machine.conservative = false;
    draft_.number("damping", b);
    if (holds_rotations)
      draft_.number("rotational_damping", b * size_ * size_);
  }

  void add_law(const std::vector<Point> &tips)
  {
    const int         i = dice_.whole(int(bodies_.size())), axis = dice_.whole(3);
    const std::string from = add_place(bodies_[i], {rounded(tips[i][0]), rounded(tips[i][1]), rounded(tips[i][2])});
    Link              link;
    link.entries    = "from = \"" + from + "\"\ndirection = " + vector_text(axis == 0, axis == 1, axis == 2) + "\n";
    link.scale      = {mass_, omega_, 0.3 * size_};
    link.on_measure = true;
    if (dice_.chance(0.4))
      add_spring(draft_, link, link.scale.stiffness() * dice_.log_between(0.1, 10.),
                 dice_.chance(0.3) ? 0. : dice_.log_between(0.01, 0.3));
    else
      add_random_law(draft_, link);
  }

  Draft                   &draft_;
  Dice                    &dice_;
  double                   size_ = 1., mass_ = 1., omega_ = 1.;
  bool                     turns_freely_ = false; ///< the first body
  std::vector<std::string> bodies_;
};

} // namespace

void write_spatial(Draft &draft)
{
  SpatialTree(draft).write();
}

} // namespace gestell::tests
