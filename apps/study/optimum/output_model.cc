#include "apps/study/optimum/output_model.h"

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

const OutputPoint &RememberedModel::at(const Eigen::VectorXd &xi, Derivatives derivatives)
{
  const std::vector<double> key(xi.data(), xi.data() + xi.size());
  const auto                found = known_.find(key);
  if (found != known_.end() && (derivatives == Derivatives::none || found->second.derivatives.size() > 0))
    return found->second;

  OutputPoint &point = known_[key];
  point              = model_(xi, derivatives);
  ++n_evaluations_;
  n_failed_ += !point.values.allFinite();
  return point;
}

} // namespace gestell::apps
