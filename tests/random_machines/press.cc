#include "tests/random_machines/laws.h"

#include <string>
#include <tuple>

namespace gestell::tests
{
namespace
{

/// Crank, rod and slide: r is length, omega the speed of the crank, mass the slide's.
class Press
{
public:
  Press(Draft &draft, const Scale &scale, double rod) : draft_(draft), dice_(draft.dice), scale_(scale), rod_(rod) {}

  void parameters()
  {
    draft_.table("parameters");
    draft_.text("r", digits(scale_.length) + " m");
    draft_.text("l", digits(rounded(scale_.length) * dice_.between(2.5, 8.)) + " m");
    draft_.text("phi", digits(dice_.between(0.3, 5.9)) + " rad");
    draft_.text("w", digits(scale_.omega) + " rad/s");
  }

  void frame()
  {
    has_frame_ = true;
    draft_.table("frame");
    const double m1 = scale_.mass * dice_.log_between(0.5, 5.), m2 = scale_.mass * dice_.log_between(0.5, 5.);
    const double c1 = stiffness() * dice_.log_between(0.5, 10.), c2 = stiffness() * dice_.log_between(0.3, 3.);
    draft_.line("mass = [[" + digits(m1) + ", 0], [0, " + digits(m2) + "]]");
    draft_.line("stiffness = " + coupled(rounded(c1), rounded(c2)));
    if (dice_.chance(0.8))
    {
      const double b = 0.1 * std::sqrt(stiffness() * scale_.mass);
      lossy(draft_);
      draft_.line("damping = " +
                  coupled(rounded(b * dice_.log_between(0.1, 1.)), rounded(b * dice_.log_between(0.1, 1.))));
    }
    for (const auto &[name, row, z] : {std::tuple{"crown", "1", 2.}, std::tuple{"table", "2", 0.}})
    {
      draft_.table(std::string("frame.interface.") + name);
      draft_.line(std::string("rows = { \"-uz\" = ") + row + " }");
      draft_.line("position = " + vector_text(0., 0., z));
      draft_.watch(std::string("frame.") + name + ".uz", scale_.length);
    }
  }

  void bodies()
  {
    const double inertia = scale_.mass * scale_.length * scale_.length;
    rotor("flywheel", inertia * dice_.log_between(3., 100.));
    rotor("crank", inertia * dice_.log_between(0.1, 3.));
    draft_.table("body.slide");
    draft_.text("type", "slider");
    draft_.line("axis = [0, 0, -1]");
    if (has_frame_)
      draft_.text("guide", "frame.crown");
    draft_.number("mass", scale_.mass);
    draft_.watch("slide.displacement");
    draft_.watch("slide.velocity");
  }

  void drive()
  {
    Link shaft;
    shaft.shaft          = "on = \"flywheel\"\n";
    shaft.turns          = true;
    shaft.scale          = {scale_.mass * scale_.length * scale_.length, scale_.omega, 1.};
    const double torsion = stiffness() * scale_.length * scale_.length * dice_.log_between(0.03, 3.);
    draft_.table("element.clutch");
    draft_.text("type", "spring-damper");
    draft_.line("from = \"flywheel\"\nto = \"crank\"");
    draft_.number("stiffness", torsion);
    if (dice_.chance(0.6))
    {
      lossy(draft_);
      draft_.number("damping", torsion / (rod_ * scale_.omega) * dice_.log_between(0.003, 0.1));
    }
    if (dice_.chance(0.5))
      add_motor(draft_, shaft);
  }

  void rod()
  {
    draft_.table("element.rod");
    draft_.text("type", "connecting rod");
    draft_.line("from = \"crank\"\nto = \"slide\"\ncrank_radius = \"r\"\nlength = \"l\"");
    nonlinear(draft_);
    draft_.number("stiffness", stiffness());
    const double closing = stiffness() / (rod_ * scale_.omega);
    if (dice_.chance(0.7))
      draft_.number("clearance", scale_.length * dice_.log_between(1e-4, 1e-2));
    if (dice_.chance(0.6))
    {
      lossy(draft_);
      draft_.number("damping", closing * dice_.log_between(0.003, 0.1));
      draft_.number("closing_length", scale_.length * dice_.log_between(1e-4, 1e-2));
    }
    if (dice_.chance(0.4))
    {
      lossy(draft_);
      draft_.number("oil_damping", closing * dice_.log_between(0.001, 0.03));
    }
    draft_.watch("rod.force", stiffness() * 0.01 * scale_.length);
    draft_.watch("rod.compression", 0.01 * scale_.length);
  }

  /// On the slide: a tool, a counterbalance, friction of the guide.
  void laws()
  {
    for (int i = 0, laws = 1 + dice_.whole(3); i < laws; ++i)
    {
      Link link;
      link.entries = std::string("from = \"slide\"\nto = \"") + (has_frame_ ? "frame.table" : "ground") + "\"\n" +
                     (has_frame_ ? "direction = [0, 0, -1]\n" : "");
      link.scale = {scale_.mass, 0.1 * rod_ * scale_.omega, scale_.length};
      link.from  = 0;
      add_random_law(draft_, link);
    }
  }

  /// The bodies move as a rigid rod would let them.
  void start()
  {
    draft_.table("start");
    draft_.line("q = { flywheel = \"phi\", crank = \"phi\", "
                "slide = \"r*(1 - cos(phi)) - l*(1 - sqrt(1 - (r/l*sin(phi))^2))\" }");
    draft_.line("v = { flywheel = \"w\", crank = \"w\", "
                "slide = \"w*r*(sin(phi) - r/l*sin(phi)*cos(phi)/sqrt(1 - (r/l*sin(phi))^2))\" }");
  }

private:
  double stiffness() const { return scale_.mass * rod_ * rod_ * scale_.omega * scale_.omega; }

  static std::string coupled(double a, double b)
  {
    return "[[" + digits(a) + ", " + digits(-a) + "], [" + digits(-a) + ", " + digits(a + b) + "]]";
  }

  void rotor(const std::string &name, double inertia)
  {
    draft_.table("body." + name);
    draft_.text("type", "rotor");
    draft_.line("axis = [0, 1, 0]");
    if (has_frame_)
      draft_.text("on", "frame.crown");
    draft_.number("inertia", inertia);
    draft_.watch(name + ".angle", 1.);
    draft_.watch(name + ".speed", scale_.omega);
  }

  Draft       &draft_;
  Dice        &dice_;
  const Scale &scale_;
  double       rod_; ///< frequency of the slide on the rod, in parts of the speed of the crank
  bool         has_frame_ = false;
};

} // namespace

/// Flywheel, clutch, crank, rod with play, slide and what it works on, on a frame of two masses or on the ground.
void write_press(Draft &draft)
{
  Dice &dice = draft.dice;
  Scale scale;
  scale.omega        = 2. * M_PI * dice.log_between(0.3, 10.);
  scale.mass         = dice.log_between(0.5, 5000.);
  scale.length       = dice.log_between(0.005, 0.3);
  draft.machine.kind = "press";
  set_times(draft, scale, 0.3, 1.5);
  Press press(draft, scale, dice.log_between(15., 200.));
  press.parameters();
  if (dice.chance(0.6))
    press.frame();
  press.bodies();
  press.drive();
  press.rod();
  press.laws();
  press.start();
}

} // namespace gestell::tests
