#include "tests/random_machines/draft.h"

#include <array>
#include <vector>

namespace gestell::tests
{
namespace
{

struct Point
{
  double x = 0., z = 0.;
};

double distance(const Point &a, const Point &b)
{
  return std::hypot(a.x - b.x, a.z - b.z);
}

/// Bars in a plane, pinned to each other and to the ground.
class Linkage
{
public:
  explicit Linkage(Draft &draft) : draft_(draft), dice_(draft.dice)
  {
    size_                 = dice_.log_between(0.05, 3.);
    mass_                 = dice_.log_between(0.1, 500.);
    omega_                = std::sqrt(9.81 / size_);
    draft.machine.jointed = true;
    draft.machine.linear = draft.machine.loadless = false;
    draft.line("gravity = [0, 0, -9.81]");
    set_times(draft, {mass_ * size_ * size_, omega_, 1.}, 0.5, 4.);
  }

  void pendulums()
  {
    draft_.machine.kind = "pendulums";
    std::vector<Point> tips;
    for (int i = 0, n = 1 + dice_.whole(4); i < n; ++i)
    {
      const int   on  = dice_.whole(i + 1) - 1; // -1: the ground
      const Point pin = on < 0 ? Point{size_ * i, 0.} : tips[on];
      const Point tip = {pin.x + size_ * dice_.between(-1., 1.), pin.z - size_ * dice_.between(0.3, 1.)};
      add_bar(pin, tip);
      add_pin(on < 0 ? "ground" : bars_[on], bars_.back(), pin);
      tips.push_back(tip);
    }
  }

  /// A crank that turns all the way round, coupler and rocker: shortest and longest together are less than the others.
  void four_bar()
  {
    draft_.machine.kind = "four-bar linkage";
    const double r = 0.3 * size_, ground = size_, coupler = size_ * dice_.between(0.8, 1.),
                 rocker = size_ * dice_.between(0.8, 1.);
    const double phi    = dice_.between(0., 2. * M_PI);
    const Point  A0, B0 = {ground, 0.}, A = {r * std::cos(phi), r * std::sin(phi)};
    // the upper one of the two places where the circles meet
    const double d = distance(A, B0), along = (coupler * coupler - rocker * rocker + d * d) / (2. * d),
                 across = std::sqrt(coupler * coupler - along * along);
    const Point e       = {(B0.x - A.x) / d, (B0.z - A.z) / d};
    const Point B       = {A.x + along * e.x - across * e.z, A.z + along * e.z + across * e.x};
    add_bar(A0, A);
    add_bar(A, B);
    add_bar(B0, B);
    add_pin("ground", bars_[0], A0);
    add_pin(bars_[0], bars_[1], A);
    add_pin(bars_[1], bars_[2], B);
    add_pin("ground", bars_[2], B0);
  }

  void slider_crank()
  {
    draft_.machine.kind = "slider-crank";
    const double r = 0.3 * size_, rod = size_ * dice_.between(0.8, 1.5), phi = dice_.between(0., 2. * M_PI),
                 offset = 0.2 * size_ * dice_.between(-1., 1.);
    const Point A       = {r * std::cos(phi), r * std::sin(phi)};
    const Point B       = {A.x + std::sqrt(rod * rod - (offset - A.z) * (offset - A.z)), offset};
    add_bar({}, A);
    add_bar(A, B);
    draft_.table("body.piston");
    draft_.text("type", "slider");
    draft_.line("axis = [1, 0, 0]");
    draft_.number("mass", mass_ * dice_.log_between(0.1, 2.));
    draft_.line("position = " + vector_text(B.x, 0., B.z));
    draft_.watch("piston.displacement");
    add_pin("ground", bars_[0], {});
    add_pin(bars_[0], bars_[1], A);
    add_pin(bars_[1], "piston", B);
    const Link link = link_on("from = \"piston\"\n", false);
    if (dice_.chance(0.7))
      add_random_law(draft_, link);
  }

  /// Springs, dampers and laws between bars, and the start.
  void finish(bool tree)
  {
    for (int i = 0, n = dice_.whole(4); i < n; ++i)
    {
      const Link link = random_link();
      if (dice_.chance(0.5))
        add_spring(draft_, link, link.scale.stiffness() * dice_.log_between(0.1, 10.),
                   dice_.chance(0.3) ? 0. : dice_.log_between(0.01, 0.3));
      else
        add_random_law(draft_, link);
    }
    draft_.table("start");
    std::string speeds;
    for (std::size_t i = 0; i < (tree ? bars_.size() : 1); ++i) // zero included: a play between them is meant so
    {
      const double speed = dice_.chance(0.6) ? omega_ * dice_.between(-2., 2.) : 0.;
      if (tree || speed != 0.)
        speeds += (speeds.empty() ? "" : ", ") + ("\"" + bars_[i]) + ".angle\" = " + digits(speed);
    }
    draft_.line("v = { " + speeds + " }");
  }

private:
  void add_bar(const Point &a, const Point &b)
  {
    const double length = distance(a, b), mass = mass_ * dice_.log_between(0.2, 1.), along = dice_.between(0.3, 0.7),
                 across = 0.1 * dice_.between(-1., 1.);
    bars_.push_back("bar" + std::to_string(bars_.size() + 1));
    ends_.push_back(b);
    draft_.table("body." + bars_.back());
    draft_.text("type", "planar");
    draft_.line("normal = [0, 1, 0]");
    draft_.number("mass", mass);
    draft_.number("inertia", mass * length * length * dice_.between(0.05, 0.2));
    draft_.line("position = " + vector_text(a.x + along * (b.x - a.x) + across * (b.z - a.z), 0.,
                                            a.z + along * (b.z - a.z) - across * (b.x - a.x)));
    draft_.watch(bars_.back() + ".angle");
    draft_.watch(bars_.back() + ".speed");
  }

  std::string add_place(const std::string &body, const Point &at)
  {
    const std::string name = draft_.new_name("at");
    draft_.table("place." + name);
    draft_.text("on", body);
    draft_.line("at = " + vector_text(at.x, 0., at.z));
    return name;
  }

  void add_pin(const std::string &from, const std::string &to, const Point &at)
  {
    const std::string name = draft_.new_name("pin");
    draft_.table("joint." + name);
    draft_.text("type", "revolute");
    draft_.text("from", from);
    draft_.text("to", to);
    draft_.line("at = " + vector_text(at.x, 0., at.z));
    if (draft_.machine.wide && dice_.chance(0.3))
    {
      draft_.number("stiffness", mass_ * omega_ * omega_ * dice_.log_between(100., 1e4));
      if (dice_.chance(0.7))
      {
        draft_.machine.conservative = false;
        draft_.number("damping", mass_ * omega_ * dice_.log_between(0.1, 30.));
      }
      return;
    }
    PinFact fact{name, "", add_place(to, at), {'x', 'z'}, size_};
    if (from != "ground")
      fact.a = add_place(from, at);
    for (const std::string &place : {fact.a, fact.b})
      for (const char axis : fact.axes)
        if (!place.empty())
          draft_.watch(place + "." + axis, size_);
    fact.x = {rounded(at.x), 0., rounded(at.z)};
    draft_.machine.pins.push_back(fact);
  }

  /// On the angle of two bars, or on the way of a bar's end along an axis.
  Link random_link()
  {
    const int         i = dice_.whole(int(bars_.size())), j = dice_.whole(int(bars_.size()) + 1) - 1;
    const std::string other = j < 0 || j == i ? "ground" : bars_[j];
    if (dice_.chance(0.5))
    {
      const std::string measure = draft_.new_name("turn");
      draft_.table("measure." + measure);
      draft_.text("type", "angle");
      draft_.text("from", bars_[i]);
      draft_.text("to", other);
      draft_.line("about = [0, 1, 0]");
      return link_on("on = \"" + measure + "\"\n", true);
    }
    const std::string from = add_place(bars_[i], ends_[i]);
    Link              link = link_on(
                     "from = \"" + from + "\"\ndirection = " + (dice_.chance(0.5) ? "[1, 0, 0]" : "[0, 0, 1]") + "\n", false);
    link.on_measure = true;
    return link;
  }

  Link link_on(const std::string &entries, bool turns) const
  {
    Link link;
    link.entries = entries;
    link.turns   = turns;
    link.scale   = turns ? Scale{mass_ * size_ * size_, omega_, 0.5} : Scale{mass_, omega_, 0.3 * size_};
    return link;
  }

  Draft                   &draft_;
  Dice                    &dice_;
  double                   size_ = 1., mass_ = 1., omega_ = 1.;
  std::vector<std::string> bars_;
  std::vector<Point>       ends_;
};

} // namespace

void write_linkage(Draft &draft)
{
  Linkage   linkage(draft);
  const int kind = draft.dice.whole(4);
  if (kind < 2)
    linkage.pendulums();
  else if (kind == 2)
    linkage.four_bar();
  else
    linkage.slider_crank();
  linkage.finish(kind < 2);
}

} // namespace gestell::tests
