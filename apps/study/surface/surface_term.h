#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// A term of a response surface: 1, xi_i, xi_i^2 or xi_i xi_j.
struct SurfaceTerm
{
  int first  = -1; ///< variable; -1: the constant
  int second = -1; ///< variable, not before `first`; -1: none

  int    degree() const { return (first >= 0) + (second >= 0); }
  bool   is_square() const { return first >= 0 && first == second; }
  bool   is_interaction() const { return second >= 0 && first != second; }
  double value(const Eigen::VectorXd &xi) const;
  /// Adds `factor` times the term's derivatives by all variables.
  void add_gradient(const Eigen::VectorXd &xi, double factor, Eigen::VectorXd &gradient) const;
};

/// "1", "c_P", "c_P^2" or "c_P*s_cl".
std::string term_name(const SurfaceTerm &term, const std::vector<std::string> &variables);

/// What a surface consists of.
enum class SurfaceOrder
{
  linear,       ///< 1 + k coefficients
  interactions, ///< and all products of two: 1 + k + k (k - 1) / 2
  quadratic     ///< and all squares: (k + 1)(k + 2) / 2
};

/// "linear", "interactions", "quadratic".  @throws std::invalid_argument for another word (nearest named)
SurfaceOrder       surface_order(const std::string &word);
const std::string &order_word(SurfaceOrder order);

/// Constant, linear terms, squares, products, each by ascending variables.
std::vector<SurfaceTerm> surface_terms(int n_variables, SurfaceOrder order);

/// X [runs x terms] of coded points [runs x variables].
Eigen::MatrixXd model_matrix(const Eigen::MatrixXd &coded, const std::vector<SurfaceTerm> &terms);

} // namespace gestell::apps
