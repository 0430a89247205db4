#include "apps/session/story/local_modes.h"

#include "coupling/machine/configuration/dense_matrices.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace gestell::apps
{

namespace
{

constexpr double most_work = 2e9; ///< states times n^3: a few seconds

std::string place_of(const coupling::Machine &machine, const Eigen::VectorXd &q)
{
  std::string text;
  int         reported = 0;
  for (const coupling::Body &body : machine.model().bodies())
  {
    const bool    turns       = body.kind == coupling::BodyKind::rotor;
    constexpr int most_places = 3; // bodies of a line of text
    if ((!turns && body.kind != coupling::BodyKind::slider) || ++reported > most_places)
      continue;
    const double x = q[body.coordinate];
    text +=
        (text.empty() ? "" : ", ") + body.name + ' ' +
        (turns ? short_text(std::remainder(x, 2. * M_PI) * 180. / M_PI, 4) + " deg" : short_text(1e3 * x, 4) + " mm");
  }
  return text;
}

/// Indices of the scene's modes for these modes.
std::vector<int> numbers_of(const coupling::Machine &machine, const std::vector<coupling::Mode> &modes,
                            const std::vector<coupling::Mode> &numbered)
{
  std::vector<int>      numbers(modes.size(), -1);
  const Eigen::MatrixXd M = coupling::dense_mass(machine);
  for (std::size_t j = 0; j < numbered.size(); ++j)
  {
    const Eigen::VectorXd moved = M * numbered[j].shape;
    // squared cosine in the metric of mass: above half, at most one mode can be the same
    constexpr double same_shape = 0.8;
    for (std::size_t i = 0; i < modes.size(); ++i)
      if (std::pow(modes[i].shape.dot(moved), 2) >= same_shape)
        numbers[i] = int(j);
  }
  return numbers;
}

} // namespace

std::string LocalModes::strain(std::size_t mode) const
{
  if (shares.strain.rows() == 0)
    return "";
  Eigen::Index most  = 0;
  const double share = shares.strain.col(Eigen::Index(mode)).maxCoeff(&most);
  if (!(share > 0.))
    return "";
  const std::string &spring = shares.springs[std::size_t(most)];
  return share > 1. ? spring : spring + " " + short_text(100. * share, 3) + " %"; // turning forces may be negative
}

ModesOfRun::ModesOfRun(const Scene &scene, const coupling::Machine &machine, const Result &result)
    : scene_(scene), machine_(machine), result_(result),
      most_states_(std::size_t(std::clamp(most_work / std::pow(double(std::max(1, machine.size())), 3), 1., 60.)))
{
}

int ModesOfRun::most() const
{
  return scene_.modes.number;
}

const LocalModes &ModesOfRun::at(const coupling::KeptState &state)
{
  for (const LocalModes &there : found_)
    if (there.t == state.t)
      return there;
  found_.push_back(found(state));
  return found_.back();
}

LocalModes ModesOfRun::found(const coupling::KeptState &state) const
{
  LocalModes there;
  there.t = state.t;
  if (result_.coupled_modes.empty())
    there.unknown = "the machine has no modes";
  else if (found_.size() >= most_states_)
    there.unknown = "the machine is too large to be linearised at more instants";
  if (!there.unknown.empty())
    return there;
  try
  {
    coupling::Linearisation how{scene_.modes.open};
    how.damping   = false;
    there.place   = place_of(machine_, state.q);
    there.modes   = coupling::linearised_modes(machine_, state.q, how, machine_.size());
    there.numbers = numbers_of(machine_, there.modes, result_.coupled_modes);
    there.shares  = coupling::energy_shares(machine_, state.q, scene_.modes.open, there.modes);
  }
  catch (const std::exception &error)
  {
    there.modes.clear();
    there.unknown = error.what();
  }
  return there;
}

} // namespace gestell::apps
