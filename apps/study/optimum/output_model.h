#pragma once

#include "apps/study/surface/response_surface.h"

#include <functional>
#include <map>
#include <mutex>
#include <vector>

namespace gestell::apps
{

enum class Derivatives
{
  none,
  wanted
};

/// Outputs at a point, and their derivatives where they are known.
struct OutputPoint
{
  Eigen::VectorXd values{};      ///< [outputs]; nan where a run failed
  Eigen::MatrixXd derivatives{}; ///< [outputs x variables] by coded variables; empty: not known
};

/// Outputs of a point in coded variables: a surface or a run.
using OutputModel = std::function<OutputPoint(const Eigen::VectorXd &xi, Derivatives)>;

/// The outputs of surfaces, in their order.
OutputModel model_of(std::vector<ResponseSurface> surfaces);

/// A model that computes each point once, however often it is asked: runs are dear.  Points within 1e-9 are the same.
class RememberedModel
{
public:
  explicit RememberedModel(OutputModel model) : model_(std::move(model)) {}

  /// Threads may ask side by side.
  /// @param is_new  becomes whether the model was asked; may be null
  OutputPoint at(const Eigen::VectorXd &xi, Derivatives derivatives, bool *is_new = nullptr);
  int         n_evaluations() const { return n_evaluations_; }
  int         n_failed() const { return n_failed_; } ///< points with a value that is not finite

private:
  using PointKey = std::vector<long long>;
  static PointKey key_of(const Eigen::VectorXd &xi);

  OutputModel                     model_;
  std::mutex                      mutex_;
  std::map<PointKey, OutputPoint> known_;
  int                             n_evaluations_ = 0, n_failed_ = 0;
};

} // namespace gestell::apps
