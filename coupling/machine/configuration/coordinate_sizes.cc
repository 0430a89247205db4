#include "coupling/machine/configuration/coordinate_sizes.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// The smallest box along the axes of space around points.
class Extent
{
public:
  void add(const Vector3 &x)
  {
    for (int d = 0; d < 3; ++d)
    {
      low_[d]  = any_ ? std::min(low_[d], x[d]) : x[d];
      high_[d] = any_ ? std::max(high_[d], x[d]) : x[d];
    }
    any_ = true;
  }
  double largest() const { return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]}); }

private:
  Vector3 low_{}, high_{};
  bool    any_ = false;
};

const std::vector<fem::Interface> &interfaces_of(const MachineModel &model)
{
  static const std::vector<fem::Interface> none;
  return model.reduced_frame() ? model.reduced_frame()->interfaces
         : model.full_frame()  ? model.full_frame()->interfaces
                               : none;
}

} // namespace

double machine_length(const MachineModel &model)
{
  Extent extent;
  for (const Body &body : model.bodies())
  {
    extent.add(body.position);
    for (const Vector3 &point : body.points)
      extent.add(point);
  }
  for (const fem::Interface &interface : interfaces_of(model))
    extent.add(interface.position);
  return extent.largest() > 0. ? extent.largest() : 1.;
}

int n_displacements(BodyKind kind)
{
  return kind == BodyKind::rotor ? 0 : kind == BodyKind::slider ? 1 : kind == BodyKind::planar ? 2 : 3;
}

Eigen::VectorXd coordinate_sizes(const Machine &machine)
{
  const MachineModel &model  = machine.model();
  const double        length = machine_length(model);
  Eigen::VectorXd     sizes  = Eigen::VectorXd::Ones(machine.size());
  sizes.head(model.n_frame()).setConstant(length);
  for (const fem::Interface &interface : interfaces_of(model))
    for (int d = 3; d < 6; ++d)
      if (interface.coordinate[std::size_t(d)] >= 0)
        sizes[interface.coordinate[std::size_t(d)]] = 1.;
  for (const Body &body : model.bodies())
    sizes.segment(body.coordinate, n_displacements(body.kind)).setConstant(length);
  return sizes;
}

double measure_size(const MachineModel &model, const ElementPlacement &placement)
{
  return placement.kind == MeasureKind::displacement ? machine_length(model) : 1.;
}

double relative_speed(const Machine &machine, const Eigen::VectorXd &v)
{
  return v.size() > 0 ? v.cwiseQuotient(coordinate_sizes(machine)).cwiseAbs().maxCoeff() : 0.;
}

} // namespace gestell::coupling
