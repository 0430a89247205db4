#include "tests/random_machines/twin_laws.h"

#include "tests/random_machines/laws.h"

#include <algorithm>
#include <memory>

namespace gestell::tests
{
namespace
{

struct Point
{
  double x = 0., z = 0.;
};

std::string text_of(const Point &p)
{
  return vector_text(p.x, 0., p.z);
}

/// As it is read.
Point rounded(const Point &p)
{
  return {tests::rounded(p.x), tests::rounded(p.z)};
}

/// A motion of a point in the plane.
struct Place
{
  Twin::Measure x, z;
};

/// Positive about y, as z is turned to x.
Place turned(const Point &r, const Twin::Measure &phi)
{
  return {[=](const Jet *q, const Jet &t) { return r.x * cos(phi(q, t)) + r.z * sin(phi(q, t)); },
          [=](const Jet *q, const Jet &t) { return r.z * cos(phi(q, t)) - r.x * sin(phi(q, t)); }};
}

Twin::Measure sum(const Twin::Measure &a, double c, const Twin::Measure &b)
{
  return [=](const Jet *q, const Jet &t) { return a(q, t) + c * b(q, t); };
}

Twin::Measure constant(double c)
{
  return [c](const Jet *, const Jet &) { return Jet(c); };
}

/// Bars in a plane that hang on each other by ideal pins, by pins that yield, and by journals with play; with loads
/// that turn with them.
class Hinged
{
public:
  explicit Hinged(Draft &draft) : draft_(draft), dice_(draft.dice), twin_(std::make_shared<Twin>())
  {
    size_  = dice_.log_between(0.05, 3.);
    mass_  = dice_.log_between(0.1, 500.);
    omega_ = std::sqrt(9.81 / size_);

    draft.machine.linear = draft.machine.loadless = false;
    draft.machine.twin                            = twin_;
    draft.line("gravity = [0, 0, -9.81]");
    // Where play is, impacts enlarge errors.
    may_play_ = dice_.chance(0.5);
    set_times(draft, {mass_ * size_ * size_, omega_, 1.}, 0.2, may_play_ ? 0.5 : 1.5);
  }

  void write()
  {
    const int n = 1 + dice_.whole(3);
    for (int i = 0; i < n; ++i)
      add_bar(i);
    for (int i = 0, laws = dice_.whole(4); i < laws; ++i)
      add_law();
    for (int i = 0, loads = dice_.whole(3); i < loads; ++i)
      add_follower();
    draft_.machine.kind = "bars" + kind_;
    start();
  }

private:
  struct Bar
  {
    std::string   name;
    Point         centre, tip;
    Twin::Measure phi, x, z;
    bool          driven = false;
    double        angle = 0., speed = 0.;
  };

  Place point_of(const Bar &bar, const Point &at) const
  {
    const Place lever = turned({at.x - bar.centre.x, at.z - bar.centre.z}, bar.phi);
    return {sum(bar.x, 1., lever.x), sum(bar.z, 1., lever.z)};
  }

  Scale of_lengths() const { return {mass_, omega_, 0.3 * size_}; }
  Scale of_angles() const { return {mass_ * size_ * size_, omega_, 0.5}; }

  void add_bar(int i)
  {
    const int   on  = dice_.whole(i + 1) - 1; // -1: the ground
    const Point pin = on < 0 ? rounded({size_ * i, 0.}) : bars_[on].tip;
    Bar         bar;
    bar.name = "bar" + std::to_string(i + 1);
    bar.tip  = rounded({pin.x + size_ * dice_.between(-1., 1.), pin.z - size_ * dice_.between(0.3, 1.)});

    const double along = dice_.between(0.3, 0.7), length = std::hypot(bar.tip.x - pin.x, bar.tip.z - pin.z);
    bar.centre = rounded({pin.x + along * (bar.tip.x - pin.x), pin.z + along * (bar.tip.z - pin.z)});
    draft_.table("body." + bar.name);
    draft_.text("type", "planar");
    draft_.line("normal = [0, 1, 0]");
    const double mass    = draft_.number("mass", mass_ * dice_.log_between(0.2, 1.));
    const double inertia = draft_.number("inertia", mass * length * length * dice_.between(0.05, 0.2));
    draft_.line("position = " + text_of(bar.centre));

    std::string drive;
    if (i == 0 && dice_.chance(0.2))
    {
      const Prescribed motion = prescribed_motion(draft_, *twin_, of_angles());
      bar.phi                 = motion.f;
      bar.driven              = true;
      drive                   = motion.table;
    }
    else
    {
      bar.angle = dice_.chance(0.5) ? 0. : tests::rounded(dice_.between(-0.7, 0.7));
      bar.speed = dice_.chance(0.4) ? 0. : tests::rounded(omega_ * dice_.between(-2., 2.));
      bar.phi   = twin_->add_coordinate(bar.angle, bar.speed, 1., omega_);
    }
    join(on, pin, bar);
    twin_->add_mass(mass, bar.x);
    twin_->add_mass(mass, bar.z);
    twin_->add_mass(inertia, bar.phi);
    twin_->add_force(bar.z, [=](double, double, double) { return -9.81 * mass; });
    tell(bar.name + ".angle", bar.phi, Twin::Quantity::value);
    tell(bar.name + ".speed", bar.phi, Twin::Quantity::rate);
    tell(bar.name + ".x", bar.x, Twin::Quantity::value, size_);
    tell(bar.name + ".vz", bar.z, Twin::Quantity::rate, size_ * omega_);
    bars_.push_back(bar);
    if (drive.empty())
      return;
    draft_.table("joint." + draft_.new_name("drive"));
    draft_.text("type", "prescribed motion");
    draft_.text("on", bar.name + ".angle");
    draft_.line("motion = " + drive);
    lossy(draft_);
    draft_.machine.passive = false;
    draft_.machine.jointed = true;
    kind_ += ", driven";
  }

  void tell(const std::string &signal, const Twin::Measure &s, Twin::Quantity quantity, double size = 0.)
  {
    if (size > 0.)
      draft_.watch(signal, size);
    else
      draft_.watch(signal);
    twin_->tell(signal, s, quantity);
  }

  void join(int on, const Point &pin, Bar &bar)
  {
    const int           kind    = dice_.whole(may_play_ ? 4 : 3);
    const std::string   from    = on < 0 ? "ground" : bars_[on].name;
    const Place         carrier = on < 0 ? Place{constant(pin.x), constant(pin.z)} : point_of(bars_[on], pin);
    const Twin::Measure phi     = on < 0 ? constant(0.) : bars_[on].phi;
    const Place         arm     = turned({bar.centre.x - pin.x, bar.centre.z - pin.z}, bar.phi);
    bar.x                       = sum(carrier.x, 1., arm.x);
    bar.z                       = sum(carrier.z, 1., arm.z);
    if (kind == 3)
    {
      draft_.table("element." + draft_.new_name("journal"));
      draft_.text("type", "journal bearing");
    }
    else
    {
      draft_.table("joint." + draft_.new_name("pin"));
      draft_.text("type", "revolute");
    }
    draft_.text("from", from);
    draft_.text("to", bar.name);
    draft_.line("at = " + text_of(pin));
    if (kind < 2)
    {
      draft_.machine.jointed = true;
      return;
    }
    // How far the pin is off, along axes that turn with the carrier: a and b, coordinates of their own.
    const double        far = 0.01 * size_;
    const Twin::Measure a   = twin_->add_coordinate(0., 0., far, omega_ * size_),
                        b   = twin_->add_coordinate(0., 0., far, omega_ * size_);
    const auto along  = [=](const Jet *q, const Jet &t) { return a(q, t) * cos(phi(q, t)) + b(q, t) * sin(phi(q, t)); };
    const auto across = [=](const Jet *q, const Jet &t) { return b(q, t) * cos(phi(q, t)) - a(q, t) * sin(phi(q, t)); };
    bar.x             = sum(bar.x, 1., along);
    bar.z             = sum(bar.z, 1., across);
    if (kind == 2)
      yielding(a, b);
    else
      journal(a, b, sum(bar.phi, -1., phi));
  }

  void yielding(const Twin::Measure &a, const Twin::Measure &b)
  {
    const double k = draft_.number("stiffness", mass_ * omega_ * omega_ * dice_.log_between(30., 3000.));
    double       c = 0.;
    if (dice_.chance(0.7))
    {
      lossy(draft_);
      c = draft_.number("damping", std::sqrt(k * mass_) * dice_.log_between(0.01, 0.5));
    }
    for (const Twin::Measure &u : {a, b})
      twin_->add_force(u, [=](double, double u, double v) { return -k * u - c * v; });
    kind_ += ", yielding pin";
  }

  /// With Hunt and Crossley's loss, and with friction that creeps.
  void journal(const Twin::Measure &a, const Twin::Measure &b, const Twin::Measure &phi)
  {
    has_journal_ = true;
    lossy(draft_);
    draft_.line("axis = [0, 1, 0]");
    const bool   hertz = dice_.chance(0.5);
    const double s = draft_.number("clearance", size_ * dice_.log_between(0.003, 0.03)), exponent = hertz ? 1.5 : 1.,
                 k = mass_ * omega_ * omega_ * dice_.log_between(100., 3000.);
    // as stiff as the linear one at a hundredth of the size
    const double c = draft_.number("stiffness", hertz ? k / std::sqrt(0.01 * size_) : k);
    if (hertz)
      draft_.number("exponent", 1.5);
    const double chi = draft_.number("dissipation", dice_.log_between(0.1, 3.) / (0.3 * omega_ * size_));
    double       mu = 0., v_0 = 1., R = 0.;
    if (dice_.chance(0.5))
    {
      R   = draft_.number("radius", size_ * dice_.log_between(0.01, 0.1));
      mu  = tests::rounded(dice_.between(0.02, 0.2));
      v_0 = tests::rounded(omega_ * R * dice_.between(0.1, 0.5));
      draft_.line("friction = { coefficient = " + digits(mu) + ", speed = " + digits(v_0) + " }");
    }
    twin_->add_law({a, b, phi},
                   [=](const Twin::Seen &seen, double *F, double *)
                   {
                     const double r = std::hypot(seen.u[0], seen.u[1]), d = r - s;
                     if (!(d > 0.))
                       return;
                     const double n_a = seen.u[0] / r, n_b = seen.u[1] / r;
                     const double rate = n_a * seen.v[0] + n_b * seen.v[1];
                     const double N    = std::max(0., c * std::pow(d, exponent) * (1. + chi * rate));
                     // The tangent turns a to -b, as phi turns x to -z.
                     const double t_a = n_b, t_b = -n_a;
                     const double v = t_a * seen.v[0] + t_b * seen.v[1] + R * seen.v[2];
                     const double T = -mu * N * std::tanh(v / v_0);
                     F[0]           = -N * n_a + T * t_a;
                     F[1]           = -N * n_b + T * t_b;
                     F[2]           = R * T;
                   });
    kind_ += ", journal";
  }

  std::string add_place(const Bar &bar, const Point &at)
  {
    const std::string name = draft_.new_name("at");
    draft_.table("place." + name);
    draft_.text("on", bar.name);
    draft_.line("at = " + text_of(at));
    return name;
  }

  void add_law()
  {
    const Bar &bar = bars_[dice_.whole(int(bars_.size()))];
    TwinLink   on;
    on.link.on_measure = true;
    const int kind     = dice_.whole(3);
    if (kind == 0)
    {
      const int  j     = dice_.whole(int(bars_.size()) + 1) - 1;
      const bool other = j >= 0 && bars_[j].name != bar.name;

      const std::string measure = draft_.new_name("turn");
      draft_.table("measure." + measure);
      draft_.text("type", "angle");
      draft_.text("from", bar.name);
      draft_.text("to", other ? bars_[j].name : "ground");
      draft_.line("about = [0, 1, 0]");
      on.link.entries = "on = \"" + measure + "\"\n";
      on.link.turns   = true;
      on.link.scale   = of_angles();
      on.u            = other ? sum(bar.phi, -1., bars_[j].phi) : bar.phi;
      return add_twin_law(draft_, *twin_, on);
    }
    const std::string place = add_place(bar, bar.tip);
    const Place       at    = point_of(bar, bar.tip);
    on.link.scale           = of_lengths();
    if (kind == 1)
    {
      const bool upwards = dice_.chance(0.5);
      on.link.entries    = "from = \"" + place + "\"\ndirection = " + (upwards ? "[0, 0, 1]" : "[1, 0, 0]") + "\n";
      on.u               = upwards ? sum(at.z, -bar.tip.z, constant(1.)) : sum(at.x, -bar.tip.x, constant(1.));
      return add_twin_law(draft_, *twin_, on);
    }
    // The distance to a point of the ground that the bar does not reach.
    const Point       anchor  = rounded({bar.tip.x + 8. * size_ * dice_.sign(), 5. * size_});
    const std::string measure = draft_.new_name("way");
    draft_.table("measure." + measure);
    draft_.text("type", "distance");
    draft_.text("from", place);
    draft_.line("at_to = " + text_of(anchor));
    on.link.entries = "on = \"" + measure + "\"\n";
    on.rest         = tests::rounded(std::hypot(bar.tip.x - anchor.x, bar.tip.z - anchor.z));
    on.u            = [=](const Jet *q, const Jet &t)
    {
      const Jet dx = at.x(q, t) - Jet(anchor.x), dz = at.z(q, t) - Jet(anchor.z);
      return sqrt(dx * dx + dz * dz);
    };
    tell(measure + ".value", on.u, Twin::Quantity::value, size_);
    add_twin_law(draft_, *twin_, on);
  }

  void add_follower()
  {
    const Bar        &bar   = bars_[dice_.whole(int(bars_.size()))];
    const std::string place = add_place(bar, bar.tip);
    const Place       at    = point_of(bar, bar.tip);
    add_twin_follower(draft_, *twin_, of_lengths(), "from = \"" + place + "\"\ncarried_by = \"" + bar.name + "\"\n",
                      at.x, at.z, bar.phi);
    kind_ += ", follower";
  }

  /// Angles; what play leaves free starts in its middle, at rest against its bearing.
  void start()
  {
    std::string q, v;
    const auto  give = [](std::string &values, const std::string &name, double value)
    {
      char text[40];
      std::snprintf(text, sizeof text, "%.17g", value);
      values += (values.empty() ? "\"" : ", \"") + name + "\" = " + text;
    };
    for (const Bar &bar : bars_)
    {
      const Jet phi = twin_->at_start(bar.phi), x = twin_->at_start(bar.x), z = twin_->at_start(bar.z);
      if (!bar.driven || has_journal_)
      {
        give(q, bar.name + ".angle", phi.v);
        give(v, bar.name + ".angle", phi.d);
      }
      if (!has_journal_)
        continue;
      give(q, bar.name + ".ux", x.v - bar.centre.x);
      give(q, bar.name + ".uz", z.v - bar.centre.z);
      give(v, bar.name + ".ux", x.d);
      give(v, bar.name + ".uz", z.d);
    }
    draft_.machine.closed_start = has_journal_;
    draft_.table("start");
    draft_.line("q = { " + q + " }");
    draft_.line("v = { " + v + " }");
  }

  Draft                &draft_;
  Dice                 &dice_;
  std::shared_ptr<Twin> twin_;
  double                size_ = 1., mass_ = 1., omega_ = 1.;
  bool                  may_play_ = false, has_journal_ = false;
  std::string           kind_;
  std::vector<Bar>      bars_;
};

} // namespace

void write_hinged(Draft &draft)
{
  Hinged(draft).write();
}

} // namespace gestell::tests
