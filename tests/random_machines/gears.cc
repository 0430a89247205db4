#include "tests/random_machines/train.h"

namespace gestell::tests
{

/// Rotors, some of them in mesh: ideal joints without change of geometry.
void write_gears(Draft &draft)
{
  Dice       &dice   = draft.dice;
  const Scale scale  = random_scale(dice, true);
  draft.machine.kind = "gears";
  set_times(draft, scale, 1.5, 10.);
  Train train(draft, true, scale);
  for (int i = 0, n = 2 + dice.whole(4); i < n; ++i)
    train.add_body();
  train.springs_of_a_tree();
  draft.machine.jointed = true;
  for (int i = 1; i < train.n_bodies(); ++i)
    if (i == 1 || dice.chance(0.4))
    {
      draft.may_stick(i - 1, i);
      draft.table("joint." + draft.new_name("gear"));
      draft.text("type", "gear");
      draft.text("from", train.bodies()[i - 1]);
      draft.text("to", train.bodies()[i]);
      draft.number("ratio", dice.sign() * dice.log_between(0.3, 3.));
    }
  for (int i = 0, laws = dice.whole(3); i < laws; ++i)
    add_random_law(draft, train.random_link());
  // At rest, or by the speed of the first: the others follow.
  draft.table("start");
  if (dice.chance(0.6))
    draft.line("v = { " + train.bodies()[0] + " = " + digits(scale.speed() * dice.between(-1., 1.)) + " }");
}

} // namespace gestell::tests
