#include "tests/random_machines/train.h"

namespace gestell::tests
{

Scale random_scale(Dice &dice, bool turns)
{
  Scale scale;
  scale.omega  = 2. * M_PI * dice.log_between(0.5, 200.);
  scale.mass   = dice.log_between(0.1, 5000.);
  scale.length = turns ? dice.log_between(1e-3, 1.) : dice.log_between(1e-5, 0.1);
  return scale;
}

void Train::add_body(const std::string &entries)
{
  const std::string name = "b" + std::to_string(bodies_.size() + 1);
  draft_.table("body." + name);
  draft_.text("type", turns_ ? "rotor" : "slider");
  draft_.line("axis = [1, 0, 0]");
  draft_.number(turns_ ? "inertia" : "mass", scale_.mass * dice_.log_between(0.1, 3.));
  draft_.machine.scene += entries;
  draft_.watch(name + (turns_ ? ".angle" : ".displacement"));
  draft_.watch(name + (turns_ ? ".speed" : ".velocity"));
  bodies_.push_back(name);
  ends_.push_back({name, ""});
}

void Train::add_point(const std::string &marker, const std::string &direction)
{
  ends_.push_back({marker, direction});
}

Link Train::link(int from, int to) const
{
  Link link;
  link.entries = "from = \"" + ends_[from].marker + "\"\nto = \"" + (to < 0 ? "ground" : ends_[to].marker) + "\"\n";
  for (const int end : {from, to})
    if (end >= 0 && !ends_[end].direction.empty())
    {
      link.entries += ends_[end].direction + "\n";
      break;
    }
  link.from  = from;
  link.to    = to;
  link.turns = turns_;
  link.scale = scale_;
  if (turns_ && from < n_bodies() && to < 0)
    link.shaft = "on = \"" + ends_[from].marker + "\"\n";
  return link;
}

Link Train::random_link()
{
  const int n = n_ends(), from = dice_.whole(n), to = dice_.whole(n + 1) - 1;
  return link(from, to == from ? -1 : to);
}

void Train::springs_of_a_tree()
{
  for (int i = 0; i < n_bodies(); ++i)
    add_spring(draft_, link(i, i == 0 ? -1 : dice_.whole(i + 1) - 1), stiffness(), damping());
}

void Train::start()
{
  draft_.table("start");
  if (dice_.chance(0.2) && draft_.machine.frictions.empty())
  {
    draft_.text("rule", "static");
    return;
  }
  if (dice_.chance(0.2))
    return; // at rest
  for (const char *key : {"q", "v"})
  {
    std::string values;
    for (const std::string &body : bodies_)
      if (dice_.chance(0.7))
        values += (values.empty() ? "" : ", ") + body + " = " +
                  digits((*key == 'q' ? scale_.length : scale_.speed()) * dice_.between(-1., 1.));
      else if (*key == 'v') // else the program warns of a play that the others close
        values += (values.empty() ? "" : ", ") + body + " = 0";
    draft_.line(std::string(key) + " = { " + values + " }");
  }
}

void write_train(Draft &draft)
{
  const bool  turns = draft.dice.chance(0.25);
  const Scale scale = random_scale(draft.dice, turns);
  Train       train(draft, turns, scale);
  draft.machine.kind = turns ? "train of rotors" : "train of sliders";
  set_times(draft, scale, 1.5, 10.);
  if (!turns && draft.dice.chance(0.2))
  {
    constexpr double g    = 9.81;
    RandomMachine   &made = draft.machine;
    made.loadless         = false;
    made.fall_length      = g / (scale.omega * scale.omega);
    made.fall_speed       = g / scale.omega;
    made.weight           = scale.mass * g;
    draft.line("gravity = [" + digits(g * draft.dice.sign()) + ", 0, 0]");
  }
  for (int i = 0, n = 1 + draft.dice.whole(4); i < n; ++i)
    train.add_body();
  train.springs_of_a_tree();
  for (int i = 0, loops = draft.dice.whole(3); i < loops; ++i)
    add_spring(draft, train.random_link(), train.stiffness(), train.damping());
  for (int i = 0, laws = draft.dice.chance(0.1) ? 0 : 1 + draft.dice.whole(3); i < laws; ++i)
    add_random_law(draft, train.random_link());
  train.start();
}

} // namespace gestell::tests
