#include "coupling/frame/reduced_stress_file.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXi;

MatrixXi column(const std::vector<int> &values)
{
  return Eigen::Map<const Eigen::VectorXi>(values.data(), Eigen::Index(values.size()));
}

std::vector<int> values(const MatrixXi &A)
{
  return {A.data(), A.data() + A.size()};
}

bool all_within(const std::vector<int> &indices, int first, int end)
{
  return std::all_of(indices.begin(), indices.end(), [&](int i) { return i >= first && i < end; });
}

} // namespace

void write_stress(Hdf5File &file, const ReducedStress &stress)
{
  if (stress.empty())
    return;
  MatrixXi triangles(3, Eigen::Index(stress.triangles.size()));
  for (std::size_t t = 0; t < stress.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      triangles(k, Eigen::Index(t)) = stress.triangles[t][k];
  file.write("stress/point", column(stress.point));
  file.write("stress/beside", column(stress.nearby));
  file.write("stress/triangles", triangles);
  file.write("stress/mean", stress.mean);
  file.write("stress/deviation", stress.deviation);
  for (std::size_t i = 0; i < stress.rigid.size(); ++i)
    file.write("stress/rigid/" + std::to_string(i), stress.rigid[i]);
}

ReducedStress read_stress(const Hdf5File &file, int n_points, int n)
{
  ReducedStress stress;
  if (!file.has("stress"))
    return stress;
  stress.point     = values(file.read_integers("stress/point"));
  stress.nearby    = values(file.read_integers("stress/beside"));
  stress.mean      = file.read_floats("stress/mean");
  stress.deviation = file.read_floats("stress/deviation");
  for (int i = 0; file.has("stress/rigid") && file.has("stress/rigid/" + std::to_string(i)); ++i)
    stress.rigid.push_back(file.read_text("stress/rigid/" + std::to_string(i)));
  const MatrixXi triangles = file.read_integers("stress/triangles");

  const Eigen::Index rows  = fem::stress_components * Eigen::Index(stress.point.size());
  const auto         shape = [&](const Eigen::MatrixXf &A) { return A.rows() == rows && A.cols() == n + 3; };
  if (!shape(stress.mean) || !shape(stress.deviation) || stress.nearby.size() != stress.point.size() ||
      triangles.rows() != 3 || !all_within(stress.point, 0, n_points) ||
      !all_within(stress.nearby, -1, int(stress.rigid.size())) || !all_within(values(triangles), 0, stress.n_points()))
    throw std::runtime_error("'stress' does not match the matrices");
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    stress.triangles.push_back({triangles(0, t), triangles(1, t), triangles(2, t)});
  return stress;
}

} // namespace gestell::coupling
