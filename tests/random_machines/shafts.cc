#include "tests/random_machines/twin_laws.h"

#include "tests/random_machines/laws.h"
#include "tests/random_machines/train.h"

#include <cstdio>
#include <memory>

namespace gestell::tests
{
namespace
{

Twin::Measure times(double c, const Twin::Measure &a)
{
  return [=](const Jet *q, const Jet &t) { return c * a(q, t); };
}

Twin::Measure sum(const Twin::Measure &a, double c, const Twin::Measure &b)
{
  return [=](const Jet *q, const Jet &t) { return a(q, t) + c * b(q, t); };
}

/// Rotors joined by springs, gears, planets and belts; cams, racks and sliders that they drive; one that shakes its
/// frame by an unbalance.
class Shafts
{
public:
  explicit Shafts(Draft &draft) : draft_(draft), dice_(draft.dice), twin_(std::make_shared<Twin>())
  {
    turning_        = random_scale(dice_, true);
    turning_.length = dice_.log_between(0.05, 1.);
    r_              = dice_.log_between(0.05, 0.3);
    straight_       = {turning_.mass / (r_ * r_), turning_.omega, turning_.length * r_};

    draft.machine.twin = twin_;
    set_times(draft, turning_, 1., 5.);
  }

  void write()
  {
    if (dice_.chance(0.5))
      add_frame();
    for (int i = 0, n = 1 + dice_.whole(4); i < n; ++i)
      add_rotor(i);
    for (int i = 0, n = dice_.whole(3); i < n; ++i)
      add_slider(i);
    draft_.machine.kind = "shafts" + kind_;
    for (int i = 0, laws = 1 + dice_.whole(3); i < laws; ++i)
      add_twin_law(draft_, *twin_, random_link());
    if (dice_.chance(0.5))
    {
      TwinLink on   = of_rotor(dice_.whole(int(rotors_.size())));
      on.link.shaft = "on = \"" + rotors_[last_].name + "\"\n";
      add_twin_drive(draft_, *twin_, on);
    }
    start();
  }

private:
  struct Body
  {
    std::string   name;
    Twin::Measure s;
    bool          free = true; ///< a coordinate; else another one moves it
    double        q = 0., v = 0.;
  };

  void tell(const std::string &signal, const Twin::Measure &s, Twin::Quantity quantity, double size)
  {
    draft_.watch(signal, size);
    twin_->tell(signal, s, quantity);
  }

  /// Two motions of a bearing, and one of what it stands on.
  void add_frame()
  {
    const Scale &scale   = straight_;
    const double gravity = dice_.chance(0.5) ? 9.81 : 0.;
    if (gravity > 0.)
    {
      draft_.line("gravity = [0, 0, -9.81]");
      draft_.machine.loadless = false;
    }
    carried_ = scale.mass * dice_.log_between(0.1, 1.);
    carried_ = rounded(carried_);
    std::vector<std::vector<double>> M(3, std::vector<double>(3, 0.)), C = M, B = M;
    for (int i = 0; i < 3; ++i)
      M[i][i] = scale.mass * dice_.log_between(0.5, 3.);
    for (const double sign : {1., -1.})
      add_spring_to(C, dice_, scale.stiffness() * dice_.log_between(0.5, 10.), sign);
    for (int i = 0; i < 3; ++i)
      C[i][i] += scale.stiffness() * dice_.log_between(0.3, 3.);
    const bool damped = dice_.chance(0.7);
    for (int i = 0; i < 3; ++i)
      B[i][i] = damped ? scale.damping() * dice_.log_between(0.01, 0.3) : 0.;
    draft_.table("frame");
    draft_.line("mass = " + text_of(M));
    draft_.line("stiffness = " + text_of(C));
    if (damped)
    {
      lossy(draft_);
      draft_.line("damping = " + text_of(B));
    }
    if (gravity > 0.)
      draft_.line("translations = [[1, 0, 0], [0, 0, 1], [0, 0, 1]]");
    draft_.table("frame.interface.p1");
    draft_.line("rows = { ux = 1, uz = 2 }");
    draft_.line("position = [0, 0, 0]");
    std::vector<Twin::Measure> p;
    for (int i = 0; i < 3; ++i)
      p.push_back(twin_->add_coordinate(0., 0., scale.length, scale.speed()));
    for (int i = 0; i < 3; ++i)
    {
      twin_->add_mass(M[i][i], p[i]);
      if (gravity > 0. && i > 0)
        twin_->add_force(p[i], [F = M[i][i] * gravity](double, double, double) { return -F; });
    }
    twin_->add_law(p,
                   [C, B](const Twin::Seen &seen, double *F, double *)
                   {
                     for (int i = 0; i < 3; ++i)
                       for (int j = 0; j < 3; ++j)
                         F[i] -= C[i][j] * seen.u[j] + B[i][j] * seen.v[j];
                   });
    tell("frame.p1.ux", p[0], Twin::Quantity::value, scale.length);
    tell("frame.p1.uz", p[1], Twin::Quantity::value, scale.length);
    tell("frame.p1.uz_rate", p[1], Twin::Quantity::rate, scale.speed());
    x_         = p[0];
    z_         = p[1];
    gravity_   = gravity;
    m_frame_   = std::min(M[0][0], M[1][1]);
    has_frame_ = true;
    kind_ += " on a frame";
  }

  /// Rounded as it is written, and each coupling counted on both sides.
  static void add_spring_to(std::vector<std::vector<double>> &C, Dice &dice, double c, double sign)
  {
    const int i = dice.whole(2), j = 2;
    C[i][i] += c;
    C[j][j] += c;
    C[i][j] += sign * c;
    C[j][i] += sign * c;
  }

  static std::string text_of(std::vector<std::vector<double>> &A)
  {
    std::string text = "[";
    for (std::size_t i = 0; i < A.size(); ++i)
    {
      text += i ? ", [" : "[";
      for (std::size_t j = 0; j < A.size(); ++j)
      {
        A[i][j] = rounded(A[i][j]);
        text += (j ? ", " : "") + digits(A[i][j]);
      }
      text += "]";
    }
    return text + "]";
  }

  void add_rotor(int i)
  {
    Body rotor;
    rotor.name = "b" + std::to_string(i + 1);
    draft_.table("body." + rotor.name);
    draft_.text("type", "rotor");
    draft_.line("axis = [0, 1, 0]");
    const double J          = draft_.number("inertia", turning_.mass * dice_.log_between(0.2, 3.));
    const bool   on_bearing = i == 0 && has_frame_;
    double       U = 0., psi = 0.;
    if (on_bearing)
    {
      draft_.line("on = \"frame.p1\"");
      draft_.number("mass", carried_);
      if (dice_.chance(0.8))
      {
        // The matrix of masses stays positive, and about its axis the mass has no more inertia than J.
        const double share = dice_.log_between(0.01, 0.4);
        U                  = draft_.number("unbalance",
                                           std::sqrt(J) * std::min(std::sqrt(m_frame_ + carried_) * share, 0.95 * std::sqrt(carried_)));
        psi                = draft_.number("unbalance_phase", dice_.between(0., 6.));
      }
    }
    const int   kind = i == 0 ? dice_.whole(4) : dice_.whole(5);
    std::string joint;
    if (i == 0 && kind == 0)
    {
      const Prescribed motion = prescribed_motion(draft_, *twin_, turning_);
      rotor.s                 = motion.f;
      rotor.free              = false;
      joint                   = "type = \"prescribed motion\"\non = \"b1\"\nmotion = " + motion.table + "\n";
      kind_ += ", prescribed";
    }
    else if (i > 0 && kind < 3)
      rotor.s = geared(i, rotor, joint);
    else
    {
      rotor.q = dice_.chance(0.5) ? 0. : rounded(turning_.length * dice_.between(-1., 1.));
      rotor.v = rounded(turning_.speed() * dice_.between(-1., 1.) * (U > 0. ? 3. : 1.));
      rotor.s = twin_->add_coordinate(rotor.q, rotor.v, turning_.length, turning_.speed());
    }
    twin_->add_mass(J, rotor.s);
    if (on_bearing)
      bear(rotor.s, U, psi);
    rotors_.push_back(rotor);
    tell(rotor.name + ".angle", rotor.s, Twin::Quantity::value, turning_.length);
    tell(rotor.name + ".speed", rotor.s, Twin::Quantity::rate, turning_.speed());
    tell(rotor.name + ".acceleration", rotor.s, Twin::Quantity::acceleration, turning_.speed() * turning_.omega);
    if (!joint.empty())
    {
      if (i == 0)
      {
        lossy(draft_);
        draft_.machine.passive = draft_.machine.loadless = draft_.machine.linear = false;
      }
      draft_.machine.jointed = true;
      draft_.table("joint." + draft_.new_name("joint"));
      draft_.machine.scene += joint;
    }
    else if (i > 0)
    {
      TwinLink on;
      on.link = between(i, dice_.chance(0.3) ? -1 : i - 1);
      on.u    = on.link.to < 0 ? rotor.s : sum(rotor.s, -1., rotors_[i - 1].s);
      if (on.link.to >= 0 && dice_.chance(0.5))
        belt(on, rotor);
      add_twin_spring(draft_, *twin_, on, turning_.stiffness() * dice_.log_between(0.3, 10.),
                      dice_.chance(0.3) ? 0. : dice_.log_between(0.001, 0.3));
    }
  }

  /// A belt that yields, on a sum of the two angles.
  void belt(TwinLink &on, const Body &rotor)
  {
    const double      ratio = rounded(dice_.sign() * dice_.log_between(0.3, 3.));
    const std::string name  = draft_.new_name("slip");
    const Body       &other = rotors_[on.link.to];
    draft_.table("measure." + name);
    draft_.text("type", "sum");
    draft_.line("terms = [{ of = \"" + rotor.name + "\" }, { of = \"" + other.name + "\", factor = " + digits(-ratio) +
                " }]");
    on.link.entries = "on = \"" + name + "\"\n";
    on.u            = sum(rotor.s, -ratio, other.s);
    tell(name + ".value", on.u, Twin::Quantity::value, turning_.length);
    kind_ += ", belt";
  }

  /// Its mass at the bearing, and what its unbalance adds to the kinetic energy and to the weight.
  void bear(const Twin::Measure &phi, double U, double psi)
  {
    twin_->add_mass(carried_, x_);
    twin_->add_mass(carried_, z_);
    if (gravity_ > 0.)
    {
      draft_.machine.loadless = false;
      twin_->add_force(z_, [F = gravity_ * carried_](double, double, double) { return -F; });
    }
    if (!(U > 0.))
      return;
    nonlinear(draft_);
    draft_.machine.accelerated = true;
    kind_ += ", unbalance";
    const Twin::Measure e_x = [=](const Jet *q, const Jet &t) { return U * cos(phi(q, t) + Jet(psi)); },
                        e_z = [=](const Jet *q, const Jet &t) { return -U * sin(phi(q, t) + Jet(psi)); };
    twin_->add_inertia(2., x_, e_x);
    twin_->add_inertia(2., z_, e_z);
    twin_->add_force(e_z, [g = gravity_](double, double, double) { return -g; });
  }

  Twin::Measure geared(int i, Body &rotor, std::string &joint)
  {
    rotor.free         = false;
    const double ratio = rounded(dice_.sign() * dice_.log_between(0.3, 3.));
    const int    from  = i - 1;
    // The motion of a rotor on the frame is that of its angle: the bearing does not turn.
    joint = "type = \"gear\"\nfrom = \"" + rotors_[from].name + "\"\nto = \"" + rotor.name +
            "\"\nratio = " + digits(ratio) + "\n";
    if (i < 2 || dice_.chance(0.5))
    {
      kind_ += ", gear";
      return times(ratio, rotors_[from].s);
    }
    const Body &carrier = rotors_[i - 2];
    joint += "carrier = \"" + carrier.name + "\"\n";
    kind_ += ", planets";
    return sum(times(ratio, rotors_[from].s), 1. - ratio, carrier.s);
  }

  void add_slider(int i)
  {
    Body slider;
    slider.name = "s" + std::to_string(i + 1);
    draft_.table("body." + slider.name);
    draft_.text("type", "slider");
    draft_.line("axis = [1, 0, 0]");
    const double m    = draft_.number("mass", straight_.mass * dice_.log_between(0.1, 3.));
    const int    kind = dice_.whole(5);
    std::string  joint;
    if (kind == 0)
      joint = cam(slider.name, slider.s);
    else if (kind == 1)
    {
      const double radius = rounded(r_ * dice_.log_between(0.3, 3.));
      const Body  &pinion = rotors_.back();
      slider.s            = times(radius, pinion.s);
      joint               = "type = \"rack\"\nfrom = \"" + pinion.name + "\"\nto = \"" + slider.name +
              "\"\nradius = " + digits(radius) + "\ndirection = [1, 0, 0]\n";
      // against a pinion that its bearing shakes
      if (rotors_.size() == 1 && has_frame_)
        slider.s = sum(slider.s, 1., x_);
      kind_ += ", rack";
    }
    else
    {
      slider.q = dice_.chance(0.5) ? 0. : rounded(straight_.length * dice_.between(-1., 1.));
      slider.v = rounded(straight_.speed() * dice_.between(-1., 1.));
      slider.s = twin_->add_coordinate(slider.q, slider.v, straight_.length, straight_.speed());
    }
    twin_->add_mass(m, slider.s);
    tell(slider.name + ".displacement", slider.s, Twin::Quantity::value, straight_.length);
    tell(slider.name + ".velocity", slider.s, Twin::Quantity::rate, straight_.speed());
    slider.free = joint.empty();
    sliders_.push_back(slider);
    if (!joint.empty())
    {
      draft_.machine.jointed = true;
      draft_.table("joint." + draft_.new_name("joint"));
      draft_.machine.scene += joint;
    }
    TwinLink on = of_slider(i);
    if (kind == 4)
      groove(on, slider);
    add_twin_spring(draft_, *twin_, on, straight_.stiffness() * dice_.log_between(0.3, 10.),
                    dice_.chance(0.3) ? 0. : dice_.log_between(0.001, 0.3));
  }

  /// A cam that yields: the spring acts on how far the follower is off.
  void groove(TwinLink &on, const Body &slider)
  {
    Twin::Measure     f;
    const std::string name = draft_.new_name("off"), entries = cam(slider.name, f);
    draft_.table("measure." + name);
    draft_.machine.scene += entries;
    on.link.entries = "on = \"" + name + "\"\n";
    on.u            = sum(slider.s, -1., f);
    tell(name + ".value", on.u, Twin::Quantity::value, straight_.length);
  }

  /// A position function of the last rotor.
  std::string cam(const std::string &slider, Twin::Measure &f)
  {
    const Body  &shaft = rotors_.back();
    const double h = rounded(straight_.length * dice_.log_between(0.1, 1.)), n = double(1 + dice_.whole(3)),
                 psi = rounded(dice_.between(0., 6.));
    f = [=, x = shaft.s](const Jet *q, const Jet &t) { return h * (sin(n * x(q, t) + Jet(psi)) - Jet(std::sin(psi))); };
    nonlinear(draft_);
    kind_ += ", cam";
    char text[240];
    std::snprintf(text, sizeof text,
                  "type = \"position function\"\nfrom = \"%s.angle\"\nto = \"%s.displacement\"\n"
                  "function = \"%s m*(sin(%g*x + %s) - sin(%s))\"\n",
                  shaft.name.c_str(), slider.c_str(), digits(h).c_str(), n, digits(psi).c_str(), digits(psi).c_str());
    return text;
  }

  Link between(int from, int to) const
  {
    Link link;
    link.entries = "from = \"" + rotors_[from].name + "\"\nto = \"" + (to < 0 ? "ground" : rotors_[to].name) + "\"\n";
    link.from    = from;
    link.to      = to;
    link.turns   = true;
    link.scale   = turning_;
    return link;
  }

  TwinLink of_rotor(int i)
  {
    TwinLink on;
    last_   = i;
    on.link = between(i, -1);
    on.u    = rotors_[i].s;
    return on;
  }

  TwinLink of_slider(int i)
  {
    TwinLink on;
    on.link.entries = "from = \"" + sliders_[i].name + "\"\n";
    on.link.scale   = straight_;
    on.u            = sliders_[i].s;
    return on;
  }

  TwinLink random_link()
  {
    const int i = dice_.whole(int(rotors_.size() + sliders_.size()));
    return i < int(rotors_.size()) ? of_rotor(i) : of_slider(i - int(rotors_.size()));
  }

  void start()
  {
    std::string q, v;
    for (const std::vector<Body> *bodies : {&rotors_, &sliders_})
      for (const Body &body : *bodies)
        if (body.free)
        {
          q += (q.empty() ? "" : ", ") + body.name + " = " + digits(body.q);
          v += (v.empty() ? "" : ", ") + body.name + " = " + digits(body.v);
        }
    draft_.table("start");
    if (!q.empty())
      draft_.line("q = { " + q + " }\nv = { " + v + " }");
  }

  Draft                &draft_;
  Dice                 &dice_;
  std::shared_ptr<Twin> twin_;
  Scale                 turning_, straight_;
  double                r_ = 1., carried_ = 0., gravity_ = 0., m_frame_ = 0.;
  bool                  has_frame_ = false;
  int                   last_      = 0;
  Twin::Measure         x_, z_;
  std::string           kind_;
  std::vector<Body>     rotors_, sliders_;
};

} // namespace

void write_shafts(Draft &draft)
{
  Shafts(draft).write();
}

} // namespace gestell::tests
