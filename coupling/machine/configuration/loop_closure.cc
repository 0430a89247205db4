#include "coupling/machine/configuration/loop_closure.h"

#include "coupling/integration/system/dense_solvers.h"

namespace gestell::coupling
{

namespace
{

std::vector<int> slider_coordinates(const Machine &machine)
{
  std::vector<int> sliders;
  for (const Body &body : machine.model().bodies())
    if (body.kind == BodyKind::slider)
      sliders.push_back(body.coordinate);
  return sliders;
}

} // namespace

Closures closures(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  const auto                  &W = machine.forces().directions();
  const Eigen::VectorXd        u = W.transpose() * q, u_rate = W.transpose() * v;
  std::vector<double>          values, curvatures;
  std::vector<Eigen::VectorXd> rows;
  int                          first = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    const int                   k = placement.element->n_measures();
    std::vector<double>         gradient(k);
    double                      g, curvature;
    const mechanism::Structure *structure = placement.element->structure();
    if (structure && structure->closure(u.data() + first, u_rate.data() + first, g, gradient.data(), curvature))
    {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(machine.size());
      for (int j = 0; j < k; ++j)
        row += gradient[j] * Eigen::VectorXd(W.col(first + j));
      rows.push_back(row);
      values.push_back(g);
      curvatures.push_back(curvature);
    }
    first += k;
  }
  Closures result;
  result.g         = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  result.curvature = Eigen::Map<Eigen::VectorXd>(curvatures.data(), static_cast<Eigen::Index>(curvatures.size()));
  result.J.resize(static_cast<Eigen::Index>(rows.size()), machine.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    result.J.row(static_cast<Eigen::Index>(i)) = rows[i];
  return result;
}

Eigen::VectorXd slider_solution(const Machine &machine, const Eigen::MatrixXd &J, const Eigen::VectorXd &b)
{
  const std::vector<int> sliders = slider_coordinates(machine);
  Eigen::VectorXd        x       = Eigen::VectorXd::Zero(J.cols());
  if (sliders.empty() || J.rows() == 0)
    return x;
  const Eigen::MatrixXd own   = J(Eigen::all, sliders);
  const Eigen::VectorXd least = LeastSquaresSolver(own).solve(b);
  x(sliders)                  = least;
  return x;
}

void close_chains(const Machine &machine, Eigen::VectorXd &q)
{
  const Eigen::VectorXd rest        = Eigen::VectorXd::Zero(machine.size());
  constexpr int         most_rounds = 20; // Newton's: quadratic near the end, some rounds from any place that closes
  for (int i = 0; i < most_rounds; ++i)
  {
    const Closures chain = closures(machine, q, rest);
    if (chain.g.size() == 0)
      return;
    q += slider_solution(machine, chain.J, -chain.g);
  }
}

} // namespace gestell::coupling
