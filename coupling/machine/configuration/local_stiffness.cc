#include "coupling/machine/configuration/local_stiffness.h"

#include "mechanism/facets.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// v^T g'' w of the position function of an element, by polarisation of its quadratic form.
double closure_curvature(const mechanism::Structure &element, const double *u, const Eigen::VectorXd &v,
                         const Eigen::VectorXd &w)
{
  Eigen::VectorXd       gradient(v.size());
  const Eigen::VectorXd sum = v + w, difference = v - w;
  double                g, of_sum, of_difference;
  element.closure(u, sum.data(), g, gradient.data(), of_sum);
  element.closure(u, difference.data(), g, gradient.data(), of_difference);
  return 0.25 * (of_sum - of_difference);
}

/// K -= P g'' for each element with a position function, p = P grad g.
void add_turning_closures(const Machine &machine, const LocalState &state, Eigen::MatrixXd &K)
{
  Eigen::VectorXd p = Eigen::VectorXd::Zero(state.u.size());
  machine.forces().force(state, p);
  int first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int                   k    = placement.element->n_measures();
    const Eigen::VectorXd       rest = Eigen::VectorXd::Zero(k);
    Eigen::VectorXd             gradient(k);
    double                      g, curvature;
    const double               *u         = state.u.data() + first;
    const mechanism::Structure *structure = placement.element->structure();
    if (structure && structure->closure(u, rest.data(), g, gradient.data(), curvature))
    {
      const double P = p.segment(first, k).dot(gradient) / gradient.squaredNorm();
      for (int i = 0; i < k; ++i)
        for (int j = 0; j < k; ++j)
          K(first + i, first + j) -=
              P * closure_curvature(*structure, u, Eigen::VectorXd::Unit(k, i), Eigen::VectorXd::Unit(k, j));
    }
    first += k;
  }
}

/// Stiffness [k x k] of an element that is engaged at u, or open if it is named there.
Eigen::MatrixXd own_stiffness(const ElementPlacement &placement, const double *u, int k,
                              const std::vector<std::string> &open)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(k, k), D = K;
  const bool      is_open  = std::find(open.begin(), open.end(), placement.name) != open.end();
  const auto      matrices = is_open ? mechanism::open_branch : mechanism::engaged;
  matrices(*placement.element, u, K.data(), D.data());
  return K;
}

/// Calls look(element, its first measure, how many).
template <typename Look>
void for_elements(const Machine &machine, const Look &look)
{
  int first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int k = placement.element->n_measures();
    look(placement, first, k);
    first += k;
  }
}

} // namespace

Eigen::MatrixXd geometric_of_measures(const Machine &machine, const LocalState &state)
{
  Eigen::MatrixXd local;
  machine.geometric(state, local);
  add_turning_closures(machine, state, local);
  return local;
}

Eigen::MatrixXd stiffness_of_measures(const Machine &machine, const LocalState &state,
                                      const std::vector<std::string> &open)
{
  Eigen::MatrixXd local = geometric_of_measures(machine, state);
  for_elements(machine, [&](const ElementPlacement &placement, int first, int k)
               { local.block(first, first, k, k) += own_stiffness(placement, state.u.data() + first, k, open); });
  return local;
}

bool is_circulatory(const Machine &machine, const LocalState &state, const Eigen::VectorXd &acts)
{
  constexpr double      rounding = 1e-12; // of the sums that the stiffness of an element is made of
  const Eigen::MatrixXd local    = geometric_of_measures(machine, state);
  bool                  found    = false;
  for_elements(machine,
               [&](const ElementPlacement &, int first, int k)
               {
                 if (k == 0)
                   return;
                 const Eigen::MatrixXd own = acts.segment(first, k).asDiagonal() * local.block(first, first, k, k);
                 const double skew = (own - own.transpose()).cwiseAbs().maxCoeff(), all = own.cwiseAbs().maxCoeff();
                 found = found || skew > rounding * all;
               });
  return found;
}

Eigen::VectorXd stiffness_terms(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                                const LocalState *geometric, const Eigen::MatrixXd &V)
{
  const auto           &W     = machine.forces().directions();
  const Eigen::VectorXd u     = W.transpose() * q;
  const Eigen::MatrixXd moved = (W.transpose() * V).cwiseAbs();
  const Eigen::MatrixXd local = geometric ? geometric_of_measures(machine, *geometric) : Eigen::MatrixXd();
  Eigen::VectorXd       sum   = Eigen::VectorXd::Zero(V.cols());
  for_elements(machine,
               [&](const ElementPlacement &placement, int first, int k)
               {
                 Eigen::MatrixXd K = own_stiffness(placement, u.data() + first, k, open).cwiseAbs();
                 if (geometric)
                   K += local.block(first, first, k, k).cwiseAbs();
                 const auto own = moved.middleRows(first, k);
                 sum += own.cwiseProduct(K * own).colwise().sum().transpose();
               });
  return sum;
}

} // namespace gestell::coupling
