#include "coupling/substructures/part_union.h"

#include "coupling/substructures/rigid_node.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd shifted_row(const VectorXd &row, Index first, Index n)
{
  VectorXd all                   = VectorXd::Zero(n);
  all.segment(first, row.size()) = row;
  return all;
}

void add_names(PartUnion &all, const ReducedFrame &part, Index first)
{
  for (fem::Interface interface : part.interfaces)
  {
    interface.renumber([first](int i) { return i + int(first); });
    all.interfaces.push_back(std::move(interface));
  }
  for (fem::FrameOutput output : part.outputs)
  {
    for (VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = shifted_row(*row, first, all.size());
    all.outputs.push_back(std::move(output));
  }
}

} // namespace

const fem::Interface &PartUnion::at(const JointEnd &end) const
{
  const auto found = std::find_if(interfaces.begin(), interfaces.end(),
                                  [&](const fem::Interface &interface) { return interface.name == end.name(); });
  if (found == interfaces.end())
    throw std::invalid_argument("there is no interface '" + end.name() + "'");
  return *found;
}

PartUnion beside_each_other(const std::vector<ReducedFrame> &parts)
{
  PartUnion all;
  Index     n = 0;
  for (const ReducedFrame &part : parts)
  {
    all.first.push_back(n);
    n += part.M.rows();
  }
  all.M = all.B = all.C = MatrixXd::Zero(n, n);
  all.translations_load = MatrixXd::Zero(n, 3);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const Index first = all.first[i], k = parts[i].M.rows();
    all.M.block(first, first, k, k)            = parts[i].M;
    all.B.block(first, first, k, k)            = parts[i].B;
    all.C.block(first, first, k, k)            = parts[i].C;
    all.translations_load.middleRows(first, k) = parts[i].translations_load;
    add_names(all, parts[i], first);
  }
  return all;
}

MatrixXd motions_of(const fem::Interface &interface, Index n)
{
  MatrixXd H = MatrixXd::Zero(6, n);
  for (int i = 0; i < 6; ++i)
    if (interface.coordinate[i] >= 0)
      H(i, interface.coordinate[i]) = interface.sign[i];
  return H;
}

MatrixXd all_motions_of(const fem::Interface &interface, Index n)
{
  const auto &fields = interface.face.coordinate;
  MatrixXd    H      = MatrixXd::Zero(6 + Index(fields.size()), n);
  H.topRows(6)       = motions_of(interface, n);
  for (std::size_t k = 0; k < fields.size(); ++k)
    H(6 + Index(k), fields[k]) = 1.;
  return H;
}

Eigen::Vector3d position_of(const fem::Interface &interface)
{
  return Eigen::Map<const Eigen::Vector3d>(interface.position.data());
}

MatrixXd rigid_motions_of(const PartUnion &parts, const Eigen::Vector3d &centre)
{
  MatrixXd R = MatrixXd::Zero(parts.size(), 6);
  for (const fem::Interface &interface : parts.interfaces)
    R += motions_of(interface, parts.size()).transpose() * carried(centre, position_of(interface));
  return R;
}

} // namespace gestell::coupling
