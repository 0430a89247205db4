#include "coupling/periodic/raised_damping.h"

namespace gestell::coupling
{

class RaisedDamping::Base final : public LinearSystem
{
public:
  Base(const LinearSystem &base, double beta) : base_(base), beta_(beta), product_(base.size()) {}

  int  size() const override { return base_.size(); }
  void mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override { base_.mass_times(x, y); }
  void damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override
  {
    base_.damping_times(x, y);
    base_.stiffness_times(x, product_);
    y += beta_ * product_;
  }
  void stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override { base_.stiffness_times(x, y); }
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override
  {
    return base_.factorise(w_M, w_B, w_C + beta_ * w_B);
  }
  std::vector<SpectrumLine> spectrum() const override
  {
    std::vector<SpectrumLine> lines = base_.spectrum();
    for (SpectrumLine &line : lines)
      line.zeta += 0.5 * beta_ * line.omega;
    return lines;
  }
  const Excitation &excitation() const override { return base_.excitation(); }
  bool              dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const override
  {
    const bool dense = base_.dense_matrices(M, B, C);
    if (dense)
      B += beta_ * C;
    return dense;
  }
  bool sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                       Eigen::SparseMatrix<double> &C) const override
  {
    const bool sparse = base_.sparse_matrices(M, B, C);
    if (sparse)
      B += beta_ * C;
    return sparse;
  }
  const std::vector<int> &virtual_coordinates() const override { return base_.virtual_coordinates(); }
  std::string             coordinate_name(int i) const override { return base_.coordinate_name(i); }

private:
  const LinearSystem     &base_;
  double                  beta_;
  mutable Eigen::VectorXd product_;
};

RaisedDamping::RaisedDamping(SecondOrderSystem &system, double beta)
    : system_(system), base_(std::make_unique<Base>(system.linear(), beta))
{
}

RaisedDamping::~RaisedDamping() = default;

const LinearSystem &RaisedDamping::linear() const
{
  return *base_;
}

} // namespace gestell::coupling
