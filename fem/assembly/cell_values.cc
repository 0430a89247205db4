#include "fem/assembly/cell_values.h"

#include "fem/assembly/finite_elements.h"

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <algorithm>

namespace gestell::fem
{

namespace
{

dealii::Quadrature<3> points_of(CellKind kind, CellPoints points)
{
  if (points != CellPoints::nodes)
    return quadrature(kind, points == CellPoints::samples ? 2 : points == CellPoints::rule ? 3 : 4);
  const std::vector<dealii::Point<3>> &nodes = finite_element(kind).get_unit_support_points();
  return {nodes, std::vector<double>(nodes.size(), 1.)};
}

} // namespace

/// Supported by the nodes of the cells.  MappingFEField does the same for meshes of one kind of cells.
class CellValues::NodalMapping : public dealii::MappingFE<3>
{
public:
  NodalMapping(const QuadraticMesh &mesh, CellKind kind)
      : dealii::MappingFE<3>(finite_element(kind)), mesh_(mesh), n_nodes_(finite_element(kind).n_dofs_per_cell())
  {
  }

private:
  std::vector<dealii::Point<3>>
  compute_mapping_support_points(const dealii::Triangulation<3>::cell_iterator &cell) const override
  {
    std::vector<dealii::Point<3>> points(n_nodes_);
    const int                    *nodes = mesh_.nodes(cell->index());
    std::transform(nodes, nodes + n_nodes_, points.begin(),
                   [&](int node)
                   {
                     const Point3 &x = mesh_.points[node];
                     return dealii::Point<3>(x[0], x[1], x[2]);
                   });
    return points;
  }

  const QuadraticMesh &mesh_;
  unsigned int         n_nodes_;
};

struct CellValues::OfKind
{
  NodalMapping        mapping;
  dealii::FEValues<3> values;
  PointValues         result;

  OfKind(const QuadraticMesh &mesh, CellKind kind, CellPoints points)
      : mapping(mesh, kind), values(mapping, finite_element(kind), points_of(kind, points),
                                    dealii::update_values | dealii::update_gradients | dealii::update_JxW_values)
  {
    const auto n = Eigen::Index(values.dofs_per_cell), n_points = Eigen::Index(values.n_quadrature_points);
    result.weight.resize(n_points);
    result.N.resize(n, n_points);
    result.dN.resize(n, 3 * n_points);
  }
};

CellValues::CellValues(const QuadraticMesh &mesh, CellPoints points) : mesh_(mesh), points_(points) {}

CellValues::~CellValues() = default;

const PointValues &CellValues::of(int cell)
{
  const CellKind           kind = mesh_.kind(cell);
  std::unique_ptr<OfKind> &own  = of_kind_[std::size_t(kind)];
  if (!own)
    own = std::make_unique<OfKind>(mesh_, kind, points_);
  auto &[mapping, values, result] = *own;
  values.reinit(dealii::Triangulation<3>::cell_iterator(&mesh_.grid->cells, 0, cell));
  for (const unsigned int k : values.quadrature_point_indices())
  {
    result.weight[k] = values.JxW(k);
    for (const unsigned int a : values.dof_indices())
    {
      result.N(a, k)       = values.shape_value(a, k);
      const auto &gradient = values.shape_grad(a, k);
      for (unsigned int d = 0; d < 3; ++d)
        result.dN(a, 3 * k + d) = gradient[d];
    }
  }
  return result;
}

} // namespace gestell::fem
