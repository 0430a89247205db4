#include "coupling/modes/energy_shares.h"

#include "fem/values/two_pi.h"
#include "mechanism/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gestell::coupling
{

namespace
{

double dot(const Measure &u, const Eigen::VectorXd &v)
{
  double sum = 0.;
  for (const auto &[i, weight] : u)
    sum += weight * v[i];
  return sum;
}

Eigen::MatrixXd shapes_of(const std::vector<Mode> &modes, Eigen::Index size)
{
  Eigen::MatrixXd V(size, Eigen::Index(modes.size()));
  for (std::size_t j = 0; j < modes.size(); ++j)
    V.col(Eigen::Index(j)) = modes[j].shape;
  return V;
}

/// v^T A v of each column.
Eigen::RowVectorXd forms(const Eigen::MatrixXd &A, const Eigen::MatrixXd &V)
{
  return V.cwiseProduct(A * V).colwise().sum();
}

/// Energies by name, one row each.
struct NamedRows
{
  std::vector<std::string>        names;
  std::vector<Eigen::RowVectorXd> rows;

  void add(const std::string &name, const Eigen::RowVectorXd &row)
  {
    names.push_back(name);
    rows.push_back(row);
  }
};

bool is_open(const std::vector<std::string> &open, const std::string &name)
{
  return std::find(open.begin(), open.end(), name) != open.end();
}

/// Adds W K W^T of every element, engaged or open at q.
void add_elements(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                  const Eigen::MatrixXd &V, NamedRows &strain)
{
  const auto           &W     = machine.forces().directions();
  const Eigen::VectorXd u     = W.transpose() * q;
  const Eigen::MatrixXd moved = W.transpose() * V; // [n_u x modes]
  int                   first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int       k = placement.element->n_measures();
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K;
    if (is_open(open, placement.name))
      mechanism::open_branch(*placement.element, u.data() + first, K.data(), D.data());
    else
      mechanism::engaged(*placement.element, u.data() + first, K.data(), D.data());
    strain.add(placement.name, forms(K, moved.middleRows(first, k)));
    first += k;
  }
}

void add_linear(const MachineModel &model, const Eigen::MatrixXd &V, NamedRows &strain)
{
  for (const LinearSpring &spring : linear_springs(model))
  {
    Eigen::RowVectorXd own(V.cols());
    for (Eigen::Index j = 0; j < V.cols(); ++j)
      own[j] = dot(spring.force, V.col(j)) * dot(spring.displacement, V.col(j));
    strain.add(spring.name, own);
  }
}

NamedRows strain_of(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                    const Eigen::MatrixXd &V)
{
  NamedRows strain;
  if (const ReducedFrame *frame = machine.model().reduced_frame())
    strain.add("frame", forms(frame->C, V.topRows(frame->C.rows())));
  add_linear(machine.model(), V, strain);
  add_elements(machine, q, open, V, strain);
  return strain;
}

/// Kinetic energies of the frame's coordinates and of those of each body, with lags.
NamedRows kinetic_of(const Machine &machine, const Eigen::MatrixXd &V)
{
  const MachineModel   &model = machine.model();
  const Eigen::MatrixXd part  = V.cwiseProduct(dense_mass(machine) * V);
  NamedRows             kinetic;
  if (model.n_frame() > 0)
    kinetic.add("frame", part.topRows(model.n_frame()).colwise().sum());
  const auto &bodies = model.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    const int begin = bodies[b].coordinate, end = b + 1 < bodies.size() ? bodies[b + 1].coordinate : machine.size();
    kinetic.add(bodies[b].name, part.middleRows(begin, end - begin).colwise().sum());
  }
  return kinetic;
}

Eigen::MatrixXd stacked(const std::vector<Eigen::RowVectorXd> &rows, Eigen::Index columns)
{
  Eigen::MatrixXd matrix(Eigen::Index(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i)
    matrix.row(Eigen::Index(i)) = rows[i];
  return matrix;
}

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

/// Whether the mode flutters: its energy changes while it vibrates, springs and masses store it at different times.
bool flutters(const Mode &mode)
{
  return mode.frequency_hz > 0. && mode.growth != 0.;
}

/// omega^2 [modes] with the sign for vibration or growth; nan for flutter.
Eigen::RowVectorXd stiffnesses(const std::vector<Mode> &modes)
{
  Eigen::RowVectorXd result(Eigen::Index(modes.size()));
  double             highest = 0.;
  for (const Mode &mode : modes)
    highest = std::max(highest, two_pi * mode.frequency_hz);
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    const double omega = two_pi * modes[j].frequency_hz, fall = modes[j].growth * modes[j].growth;
    // of the highest frequency, the rounding of its square: below it a mode has none
    constexpr double no_strain = 1e-8;
    result[Eigen::Index(j)]    = flutters(modes[j]) ? not_defined : omega > no_strain * highest ? omega * omega : -fall;
  }
  return result;
}

} // namespace

std::vector<LinearSpring> linear_springs(const MachineModel &model)
{
  const auto                  paths = model.signal_paths();
  const std::set<std::string> known(paths.begin(), paths.end());
  const std::string           ending = ".force";
  std::vector<LinearSpring>   springs;
  for (const std::string &path : paths)
  {
    const std::string name = path.substr(0, path.size() - std::min(path.size(), ending.size()));
    if (path != name + ending || known.count(name + ".displacement") == 0)
      continue;
    const Signal force = model.signal(name, path), displacement = model.signal(name, name + ".displacement");
    const bool   linear = force.element < 0 && displacement.element < 0 && force.load < 0;
    if (linear && !(force.on_q.empty() && force.on_v.empty()) && !displacement.on_q.empty())
      springs.push_back({name, force.on_q, displacement.on_q});
  }
  return springs;
}

EnergyShares energy_shares(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                           const std::vector<Mode> &modes)
{
  const Eigen::MatrixXd    V      = shapes_of(modes, machine.size());
  const Eigen::RowVectorXd total  = stiffnesses(modes);
  NamedRows                strain = strain_of(machine, q, open, V), kinetic = kinetic_of(machine, V);
  Eigen::RowVectorXd       turning = total;
  for (const Eigen::RowVectorXd &row : strain.rows)
    turning -= row;
  strain.add("turning forces", turning);

  EnergyShares                    shares;
  std::vector<Eigen::RowVectorXd> kept;
  for (std::size_t i = 0; i < strain.rows.size(); ++i)
  {
    Eigen::RowVectorXd share = strain.rows[i].cwiseQuotient(total);
    for (Eigen::Index j = 0; j < share.size(); ++j)
      if (total[j] == 0.)
        share[j] = not_defined;
    constexpr double no_share = 1e-6; // below it, of all modes, a spring is left out
    const bool       any      = (share.array().isFinite() && share.array().abs() > no_share).any();
    if (!any)
      continue;
    shares.springs.push_back(strain.names[i]);
    kept.push_back(share);
  }
  shares.strain  = stacked(kept, V.cols());
  shares.masses  = kinetic.names;
  shares.kinetic = stacked(kinetic.rows, V.cols());
  for (std::size_t j = 0; j < modes.size(); ++j)
    if (flutters(modes[j]))
      shares.kinetic.col(Eigen::Index(j)).setConstant(not_defined);
  return shares;
}

} // namespace gestell::coupling
