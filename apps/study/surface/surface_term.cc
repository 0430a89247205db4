#include "apps/study/surface/surface_term.h"

#include "apps/study/values/word_choice.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

const std::vector<std::string> order_words = {"linear", "interactions", "quadratic"}; ///< as SurfaceOrder

} // namespace

double SurfaceTerm::value(const Eigen::VectorXd &xi) const
{
  return (first < 0 ? 1. : xi(first)) * (second < 0 ? 1. : xi(second));
}

void SurfaceTerm::add_gradient(const Eigen::VectorXd &xi, double factor, Eigen::VectorXd &gradient) const
{
  if (first >= 0)
    gradient(first) += factor * (second < 0 ? 1. : xi(second));
  if (second >= 0)
    gradient(second) += factor * xi(first);
}

std::string term_name(const SurfaceTerm &term, const std::vector<std::string> &variables)
{
  if (term.first < 0)
    return "1";
  if (term.second < 0)
    return variables.at(term.first);
  return term.is_square() ? variables.at(term.first) + "^2"
                          : variables.at(term.first) + "*" + variables.at(term.second);
}

SurfaceOrder surface_order(const std::string &word)
{
  return static_cast<SurfaceOrder>(word_choice(word, order_words, "order of a surface"));
}

const std::string &order_word(SurfaceOrder order)
{
  return order_words[static_cast<std::size_t>(order)];
}

std::vector<SurfaceTerm> surface_terms(int n_variables, SurfaceOrder order)
{
  std::vector<SurfaceTerm> terms(1);
  for (int i = 0; i < n_variables; ++i)
    terms.push_back({i, -1});
  if (order == SurfaceOrder::quadratic)
    for (int i = 0; i < n_variables; ++i)
      terms.push_back({i, i});
  if (order != SurfaceOrder::linear)
    for (int i = 0; i < n_variables; ++i)
      for (int j = i + 1; j < n_variables; ++j)
        terms.push_back({i, j});
  return terms;
}

Eigen::MatrixXd model_matrix(const Eigen::MatrixXd &coded, const std::vector<SurfaceTerm> &terms)
{
  Eigen::MatrixXd X(coded.rows(), static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index run = 0; run < coded.rows(); ++run)
  {
    const Eigen::VectorXd xi = coded.row(run).transpose();
    for (Eigen::Index j = 0; j < X.cols(); ++j)
      X(run, j) = terms[j].value(xi);
  }
  return X;
}

} // namespace gestell::apps
