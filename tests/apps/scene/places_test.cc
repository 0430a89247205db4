// Elements, drives and signals on points and directions of bodies that turn.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;

/// A plate in the plane y = 0, 2 kg and 0.5 kg m^2, with its tip 0.4 m from the centre of mass; half a second.
const std::string plate = planar_body("plate", "2", "0.5", "[0.1, 0, 0.2]") + place("tip", "plate", "[0.5, 0, 0.2]") +
                          steps("0.2 ms", "0.5 s", {{"order", "4"}});

std::string with_tip(const std::string &element, const std::string &signals = "")
{
  return plate + "[element.load]\n" + element +
         "[output.signals]\nx = \"plate.x\"\nz = \"plate.z\"\nphi = \"plate.angle\"\nvx = \"plate.vx\"\nvz = "
         "\"plate.vz\"\nw = \"plate.speed\"\ntip_x = \"tip.x\"\ntip_z = \"tip.z\"\ntip_uz = \"tip.uz\"\ntip_vx = "
         "\"tip.vx\"\ntip_vz = \"tip.vz\"\nF = \"load.force\"\n" +
         signals;
}

double kinetic(const SceneRun &run)
{
  return 0.5 * 2. * (std::pow(run.signal("vx").final, 2) + std::pow(run.signal("vz").final, 2)) +
         0.5 * 0.5 * std::pow(run.signal("w").final, 2);
}

// A load of constant direction at the tip: its work is F times the way of the tip, and signals of the tip are those of
// the body that carries it.
TEST(Places, ALoadOffTheCentreTurnsItsBody)
{
  for (const char *from : {"from = \"tip\"\n", "from = \"plate\"\nat_from = [0.5, 0, 0.2]\n"})
  {
    const auto   motion = run(with_tip(std::string("type = \"force\"\ndirection = [0, 0, 1]\nconstant = 3\n") + from));
    const auto   final  = [&](const char *name) { return motion.signal(name).final; };
    const double phi = final("phi"), w = final("w"); // about y: x turns towards -z
    EXPECT_LT(phi, -0.2);
    EXPECT_NEAR(final("tip_x"), final("x") + 0.4 * std::cos(phi), 1e-13);
    EXPECT_NEAR(final("tip_z"), final("z") - 0.4 * std::sin(phi), 1e-13);
    EXPECT_NEAR(final("tip_uz"), final("tip_z") - 0.2, 1e-13);
    EXPECT_NEAR(final("tip_vx"), final("vx") - 0.4 * w * std::sin(phi), 1e-13);
    EXPECT_NEAR(final("tip_vz"), final("vz") - 0.4 * w * std::cos(phi), 1e-13);
    EXPECT_NEAR(final("vz"), 3. / 2. * 0.5, 1e-9); // the centre of mass moves as if the load acted there
    EXPECT_NEAR(kinetic(motion), 3. * final("tip_uz"), 1e-7);
    expect_closed_balance(motion, 1e-6);
  }
}

// A thrust that turns with its body at an arm: the moment is constant, and the velocity the integral of the direction.
TEST(Places, AThrustTurnsWithItsBody)
{
  for (const char *type : {"type = \"force\"\nconstant = 3\n", "type = \"force profile\"\nprofile = 3\n"})
  {
    const auto motion =
        run(with_tip(std::string(type) + "from = \"tip\"\ncarried_by = \"plate\"\ndirection = [0, 0, 1]\n"));
    const double alpha = -3. * 0.4 / 0.5, T = 0.5;
    EXPECT_NEAR(motion.signal("w").final, alpha * T, 1e-9);
    EXPECT_NEAR(motion.signal("phi").final, 0.5 * alpha * T * T, 1e-9);
    double        vx = 0., vz = 0.; // Simpson's rule over the turning direction (sin phi, cos phi)
    constexpr int n = 200;
    for (int k = 0; k <= n; ++k)
    {
      const double t = T * k / n, phi = 0.5 * alpha * t * t, weight = k == 0 || k == n ? 1. : k % 2 ? 4. : 2.;
      vx += weight * T / n / 3. * 1.5 * std::sin(phi);
      vz += weight * T / n / 3. * 1.5 * std::cos(phi);
    }
    EXPECT_NEAR(motion.signal("vx").final, vx, 1e-8);
    EXPECT_NEAR(motion.signal("vz").final, vz, 1e-8);
    expect_closed_balance(motion, 1e-6);
  }
}

// A spring between places acts as one on the measure of the two, less what that is as described.
TEST(Places, ASpringBetweenPlacesIsZeroInTheReferenceConfiguration)
{
  const std::string spring = "type = \"spring-damper\"\nstiffness = 50\ndamping = 2\n";
  const auto        places =
      run(with_tip(spring + "from = \"tip\"\ndirection = [0, 0, 1]\n[start]\nv = { \"plate.angle\" = 3 }\n"));
  const auto measured = run(
      with_tip(spring + "on = \"height\"\nrest = 0.2\n[measure.height]\ntype = \"along\"\nfrom = \"tip\"\ndirection = "
                        "[0, 0, 1]\n[start]\nv = { \"plate.angle\" = 3 }\n"));
  for (const char *signal : {"x", "z", "phi", "F"})
    EXPECT_NEAR(places.signal(signal).final, measured.signal(signal).final, 1e-12) << signal;
  EXPECT_GT(std::abs(places.signal("F").final), 1.);
  expect_closed_balance(places, 1e-6);
}

// Play along a rod that turns: the bead flies out to the stop and presses on it with m omega^2 r.
TEST(Places, PlayAlongATurningRodHoldsABead)
{
  const auto motion =
      run(rotor_body("rod", "1e9", "[0, 1, 0]") + point_body("bead", "0.1", "[0.5, 0, 0]") +
          joint("slot", "prismatic", {{"from", "rod"}, {"to", "bead"}, {"axis", "[1, 0, 0]"}}) +
          measure("way", "along",
                  {{"from", "bead"},
                   {"to", "rod"},
                   {"at_to", "[0.5, 0, 0]"},
                   {"direction", "[1, 0, 0]"},
                   {"carried_by", "rod"}}) +
          element("play", "clearance",
                  {{"on", "way"}, {"gap", "20 mm"}, {"stiffness", "20 kN/m"}, {"dissipation", "5 s/m"}}) +
          start("v = { rod = '10 rad/s' }") + steps("0.1 ms", "1 s") + signals("F = 'play.force', s = 'way.value'"));
  EXPECT_GE(count(motion, "contact_positive"), 1);
  // m omega^2 (r + gap + e) = c e
  const double e = 0.1 * 100. * 0.52 / (2e4 - 0.1 * 100.);
  EXPECT_NEAR(motion.signal("s").final, 0.02 + e, 1e-6);
  EXPECT_NEAR(std::abs(motion.signal("F").final), 2e4 * e, 0.01 * 2e4 * e);
}

/// Two discs on one pin: planar bodies, whose angles belong to them.
const std::string discs = planar_body("one", "1", "0.2", "[0, 0, 0]") + planar_body("two", "1", "0.3", "[0, 0, 0]") +
                          measure("twist", "angle", {{"from", "one"}, {"to", "two"}, {"about", "[0, 1, 0]"}}) +
                          start("v = { 'one.angle' = 10 }") + steps("0.5 ms", "1 s") +
                          signals("w1 = 'one.speed', w2 = 'two.speed'");

// True friction between two bodies that turn: they stick once both have the common speed, and keep it.
TEST(Places, DryFrictionBetweenTurningBodiesSticks)
{
  const auto   motion = run(discs + element("lining", "dry friction",
                                            {{"on", "twist"}, {"kinetic_force", "3 N m"}, {"static_force", "3 N m"}}));
  const double common = 0.2 * 10. / 0.5;
  EXPECT_NEAR(time_of(motion, "stick"), 10. / (3. / 0.2 + 3. / 0.3), 1e-9);
  EXPECT_NEAR(motion.signal("w1").final, common, 1e-9);
  EXPECT_NEAR(motion.signal("w2").final, common, 1e-9);
  const auto brushed =
      run(discs + "[element.lining]\ntype = \"lugre friction\"\non = \"twist\"\nkinetic_force = \"3 N m\"\n"
                  "bristle_stiffness = \"1e4 N m/rad\"\nbristle_damping = \"10 N m s/rad\"\n");
  EXPECT_NEAR(brushed.signal("w1").final, common, 1e-3);
  EXPECT_NEAR(brushed.signal("w2").final, common, 1e-3);
}

/// Speed of a shaft of 0.5 kg m^2 under a drive after 0.3 s: a rotor, a planar body, or a body in space on a pin.
double driven(const std::string &shaft, const std::string &on, const std::string &drive)
{
  const std::string bodies = shaft == "rotor" ? rotor_body("shaft", "0.5", "[0, 1, 0]")
                             : shaft == "planar"
                                 ? planar_body("shaft", "1", "0.5", "[0, 0, 0]")
                                 : rigid_body("shaft", "1", "[0.3, 0.5, 0.4]", "[0, 0, 0]") +
                                       revolute("pin", "ground", "shaft", "[0, 0, 0]", {{"axis", "[0, 1, 0]"}});
  const std::string speed  = shaft == "rigid" ? "shaft.wy" : "shaft.speed";
  const auto        motion =
      run(bodies + measure("turn", "angle", {{"from", "shaft"}, {"about", "[0, 1, 0]"}}) + "[element.drive]\non = \"" +
          on + "\"\n" + drive + steps("0.2 ms", "0.3 s") + signals("w = '" + speed + "'"));
  return motion.signal("w").final;
}

// A drive turns whatever has the angle: rotors, planar bodies and measures give one motion.
TEST(Places, DrivesTurnRotorsPlanarBodiesAndAngles)
{
  const std::string kloss = "breakdown_torque = \"20 N m\"\nbreakdown_slip = 0.2\nsynchronous_speed = \"300 rpm\"\n";
  for (const std::string &drive :
       {"type = \"asynchronous motor\"\n" + kloss, "type = \"dynamic motor\"\ntime_constant = \"20 ms\"\n" + kloss,
        std::string("type = \"speed drive\"\nspeed = \"200 rpm\"\nproportional_gain = 4\nintegral_gain = 20\n")})
  {
    const double rotor = driven("rotor", "shaft", drive);
    EXPECT_GT(rotor, 1.) << drive;
    EXPECT_NEAR(driven("rotor", "turn", drive), rotor, 1e-9);
    EXPECT_NEAR(driven("planar", "shaft", drive), rotor, 1e-9);
    EXPECT_NEAR(driven("planar", "turn", drive), rotor, 1e-9);
    EXPECT_NEAR(driven("rigid", "turn", drive), rotor, 1e-4 * rotor); // of second order in the turn per step
  }
}

// Between two planar bodies no torque comes from outside; the measure of their twist gives the same motion.
TEST(Places, DrivesPushThemselvesOffPlanarBodies)
{
  const std::string drive  = "[element.drive]\ntype = \"speed drive\"\nspeed = \"100 rpm\"\nproportional_gain = 2\n";
  const auto        bodies = run(discs + drive + "on = \"one\"\nto = \"two\"\n");
  const double      w_1 = bodies.signal("w1").final, w_2 = bodies.signal("w2").final;
  EXPECT_NEAR(0.2 * w_1 + 0.3 * w_2, 0.2 * 10., 1e-9);
  EXPECT_NEAR(w_1 - w_2, 10. * M_PI / 3., 1e-4);
  EXPECT_NEAR(run(discs + drive + "on = \"twist\"\n").signal("w1").final, w_1, 1e-9);
}

// Loads that turn with their body obey as all others do (3 N, then 1 N, at an arm of 0.4 m), and so do springs on
// places.
TEST(Places, LoadsOnPlacesObeySwitches)
{
  const auto thrust = [](const std::string &type, const std::string &order)
  {
    const auto motion = run(with_tip(type + "from = \"tip\"\ncarried_by = \"plate\"\ndirection = [0, 0, 1]\n" +
                                     "[switch.less]\nwhen = \"t\"\nabove = \"0.2 s\"\ntell = \"load\"\n" + order));
    expect_closed_balance(motion, 1e-6);
    return motion;
  };
  for (const char *type : {"type = \"force\"\nconstant = 3\n", "type = \"force profile\"\nprofile = 3\n"})
  {
    const auto set = thrust(type, "order = \"set\"\nto = 1\n"), off = thrust(type, "order = \"off\"\n");
    EXPECT_NEAR(set.signal("w").final, -0.4 / 0.5 * (3. * 0.2 + 1. * 0.3), 1e-9) << type;
    EXPECT_EQ(set.signal("F").final, 1.) << type;
    EXPECT_NEAR(off.signal("w").final, -0.4 / 0.5 * 3. * 0.2, 1e-9) << type;
    EXPECT_EQ(off.signal("F").final, 0.) << type;
  }
  const std::string spring = "type = \"spring-damper\"\nfrom = \"tip\"\ndirection = [0, 0, 1]\npreload = -3\n";
  const auto        freed =
      run(with_tip(spring + "[switch.off]\nwhen = \"tip.vz\"\nabove = 0.5\ntell = \"load\"\norder = \"off\"\n"));
  EXPECT_NEAR(freed.signal("vz").final, 3. / 2. * time_of(freed, "switch"), 1e-9);
  EXPECT_LT(time_of(freed, "switch"), 0.4);
  // The preload has worked, and what it gave stays given: store and kinetic energy are in balance.
  EXPECT_LT(std::abs(freed.result.energy.residual), 1e-9 * kinetic(freed));
}

TEST(Places, ASwitchWatchesAPlace)
{
  const auto motion =
      run(with_tip("type = \"force\"\nfrom = \"tip\"\ndirection = [0, 0, 1]\nconstant = 3\n") +
          "[joint.pull]\ntype = \"prescribed motion\"\non = \"plate.ux\"\nmotion = { speed = \"1 m/s\", "
          "brake = { duration = \"10 ms\" } }\n[switch.far]\nwhen = \"tip.x\"\nabove = \"0.7 m\"\ntell = "
          "\"pull\"\norder = \"brake\"\n");
  const double t = time_of(motion, "switch");
  EXPECT_GT(t, 0.19);
  EXPECT_LT(t, 0.3);
}

TEST(Places, WhatCannotActIsRefused)
{
  const std::string point = "[body.bob]\ntype = \"point\"\nmass = 1\nposition = [0, 0, 0]\n";
  expect_complaint(point + "[element.e]\ntype = \"spring-damper\"\nfrom = \"bob\"\nabout = [0, 0, 1]\nstiffness = 1\n",
                   "is a point, which has no rotation");
  expect_complaint(point + "[element.e]\ntype = \"force\"\nfrom = \"bob\"\nabout = [0, 0, 1]\nconstant = 1\n",
                   "is a point, which has no rotation");
  expect_complaint(
      plate + point +
          "[element.e]\ntype = \"friction\"\nfrom = \"plate\"\nto = \"bob\"\nabout = [0, 1, 0]\nforce = 1\n",
      "element.e.to: 'bob' is a point");
  expect_complaint(plate + point + "[measure.m]\ntype = \"angle\"\nfrom = \"plate\"\nto = \"bob\"\nabout = [0, 1, 0]\n",
                   "measure.m.to: 'bob' is a point");
  const auto load = [](const std::string &keys) { return plate + "[element.e]\n" + keys; };
  expect_complaint(load("type = \"force\"\nfrom = \"plate\"\nat_from = [0, 0, 0]\nabout = [0, 1, 0]\nconstant = 1\n"),
                   "at_from: has no effect");
  expect_complaint(load("type = \"force\"\nfrom = \"tip\"\nconstant = 1\n"), "give 'direction'");
  expect_complaint(load("type = \"force\"\nfrom = \"top\"\ndirection = [0, 0, 1]\nconstant = 1\n"),
                   "there is no body 'top'");
  expect_complaint(load("type = \"dry friction\"\nfrom = \"tip\"\ndirection = [0, 0, 1]\nkinetic_force = 1\n"
                        "static_force = 1\n"),
                   "cannot follow points");
  expect_complaint(load("type = \"force\"\nfrom = \"tip\"\ncarried_by = \"plate\"\nconstant = 1\n"),
                   "needs a direction");
  expect_complaint(load("type = \"force\"\nfrom = \"tip\"\ndirection = [1, 0, 0]\ncarried_by = \"ground\"\nconstant = "
                        "1\n"),
                   "acts on 'plate'");
  expect_complaint(load("type = \"asynchronous motor\"\non = \"height\"\n[measure.height]\ntype = \"along\"\nfrom = "
                        "\"tip\"\ndirection = [0, 0, 1]\n"),
                   "is a length");
  const std::string motor = "[element.e]\ntype = \"speed drive\"\nspeed = 1\nproportional_gain = 1\n";
  expect_complaint(discs + motor + "on = \"twist\"\nto = \"two\"\n", "element.e.to: has no effect");
  expect_complaint(discs + point + motor + "on = \"one\"\nto = \"bob\"\n", "'bob' is a point");
  expect_complaint(point + "[element.e]\ntype = \"asynchronous motor\"\non = \"bob\"\n", "'bob' is not a rotor");
  expect_complaint(plate + point +
                       "[measure.m]\ntype = \"along\"\nfrom = \"tip\"\ndirection = [0, 0, 1]\ncarried_by = \"bob\"\n",
                   "can rotate with `from` or `to` only");
}

} // namespace
} // namespace gestell::tests
