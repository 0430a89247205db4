#pragma once

#include "tests/random_machines/draft.h"

namespace gestell::tests
{

/// Bodies in a row, and links between any two of them: tree and loops.
class Train
{
public:
  Train(Draft &draft, bool turns, const Scale &scale) : draft_(draft), dice_(draft.dice), turns_(turns), scale_(scale)
  {
  }

  /// A rotor or slider of about the scale's mass.  @param entries  besides, with line ends
  void add_body(const std::string &entries = "");
  /// Another motion to hold on to, of a frame.
  void add_point(const std::string &marker, const std::string &direction);

  int    n_ends() const { return int(ends_.size()); }
  int    n_bodies() const { return int(bodies_.size()); }
  Link   link(int from, int to) const; ///< of ends, to = -1: ground
  Link   random_link();
  double stiffness() { return scale_.stiffness() * dice_.log_between(0.3, 10.); }
  double damping() { return dice_.chance(0.3) ? 0. : dice_.log_between(0.001, 0.3); }
  void   springs_of_a_tree(); ///< from each body to one before it or to the ground
  void   start();

  const std::vector<std::string> &bodies() const { return bodies_; }

private:
  struct End
  {
    std::string marker, direction; ///< direction: an entry, empty for bodies
  };

  Draft                   &draft_;
  Dice                    &dice_;
  bool                     turns_ = false;
  Scale                    scale_;
  std::vector<std::string> bodies_;
  std::vector<End>         ends_;
};

/// Scales of translations, or of rotations.
Scale random_scale(Dice &dice, bool turns);

} // namespace gestell::tests
