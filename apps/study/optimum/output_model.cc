#include "apps/study/optimum/output_model.h"

#include <cmath>

namespace gestell::apps
{
OutputModel model_of(std::vector<ResponseSurface> surfaces)
{
  return [surfaces = std::move(surfaces)](const Eigen::VectorXd &xi, Derivatives derivatives)
  {
    OutputPoint point;
    point.values.resize(static_cast<Eigen::Index>(surfaces.size()));
    if (derivatives == Derivatives::wanted)
      point.derivatives.resize(point.values.size(), xi.size());
    for (Eigen::Index i = 0; i < point.values.size(); ++i)
    {
      point.values(i) = surfaces[i].value(xi);
      if (derivatives == Derivatives::wanted)
        point.derivatives.row(i) = surfaces[i].gradient(xi).transpose();
    }
    return point;
  };
}

RememberedModel::PointKey RememberedModel::key_of(const Eigen::VectorXd &xi)
{
  PointKey key;
  for (const double x : xi)
    key.push_back(std::llround(x / same_level));
  return key;
}

OutputPoint RememberedModel::at(const Eigen::VectorXd &xi, Derivatives derivatives, bool *is_new)
{
  const PointKey key = key_of(xi);
  {
    const std::lock_guard<std::mutex> alone(mutex_);
    const auto                        found = known_.find(key);
    const bool                        known =
        found != known_.end() && (derivatives == Derivatives::none || found->second.derivatives.size() > 0);
    if (is_new)
      *is_new = !known;
    if (known)
      return found->second;
  }
  const OutputPoint                 point = model_(xi, derivatives);
  const std::lock_guard<std::mutex> alone(mutex_);
  known_[key] = point;
  ++n_evaluations_;
  n_failed_ += !point.values.allFinite();
  return point;
}

} // namespace gestell::apps
