// Tetrahedra, hexahedra and prisms, alone and beside each other.

#include "fem/assembly/elasticity.h"
#include "fem/assembly/raised_degree.h"
#include "fem/assembly/reference_cell.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesher.h"
#include "fem/recovery/discretisation.h"
#include "fem/values/vector3.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/cad_samples.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using fem::CellKind;
using fem::operator+;
using fem::operator-;
using fem::operator*;

const fem::Material          steel = free_steel().material;
const std::array<double, 3> &size()
{
  static const std::array<double, 3> all = {1., 2., 0.75};
  return all;
}

struct Mixture
{
  std::string name;
  fem::Mesh   mesh;
  double      volume; // [m^3]
};

/// Of one kind each; tetrahedra upon prisms, hexahedra beside them.
std::vector<Mixture> mixtures()
{
  using Kind        = std::optional<CellKind>;
  const auto nearby = [](int i, int, int) { return Kind(i < 2 ? CellKind::hexahedron : CellKind::prism); };
  const auto upon   = [](int, int, int k) { return Kind(k < 2 ? CellKind::prism : CellKind::tetrahedron); };
  const auto all    = [](int i, int, int k) {
    return k < 2 ? Kind(i < 2 ? CellKind::hexahedron : CellKind::prism) : i < 2 ? Kind() : Kind(CellKind::tetrahedron);
  };
  const double box = size()[0] * size()[1] * size()[2];
  return {{"tetrahedra", box_mesh({3, 3, 3}, size(), 0.25), box},
          {"hexahedra", brick_mesh({3, 3, 3}, size(), 0.25), box},
          {"prisms", prism_mesh({3, 3, 3}, size(), 0.2), box},
          {"prisms beside hexahedra", filled_mesh({4, 3, 3}, size(), nearby, 0.2), box},
          {"tetrahedra upon prisms", filled_mesh({3, 3, 4}, size(), upon, 0.2), box},
          {"all three", filled_mesh({4, 3, 4}, size(), all), 0.75 * box}};
}

fem::CellMaterials all_of(const fem::QuadraticMesh &mesh)
{
  return {{steel}, std::vector<int>(mesh.n_cells(), 0)};
}

/// Without supports and ties.
struct FreeCells
{
  explicit FreeCells(const fem::QuadraticMesh &mesh)
      : materials(all_of(mesh)), affine((fem::MultipointConstraints(mesh.n_nodes())))
  {
    fem::MatrixSums sums = fem::assemble(mesh, materials, affine, fem::whole(mesh, affine));
    C                    = std::move(sums.C);
    M                    = std::move(sums.M);
  }
  fem::CellMaterials     materials;
  fem::AffineConstraints affine;
  fem::SparseMatrix      C, M;
};

std::set<int> outer_nodes(const fem::QuadraticMesh &mesh)
{
  std::set<int> nodes;
  for (const auto &face : mesh.skin)
    nodes.insert(face.begin(), face.end());
  for (const auto &face : mesh.skin_quads)
    nodes.insert(face.begin(), face.end());
  return nodes;
}

Eigen::VectorXd linear_field(const fem::QuadraticMesh &mesh, const Eigen::Matrix3d &H)
{
  Eigen::VectorXd u(3 * mesh.n_nodes());
  for (int i = 0; i < mesh.n_nodes(); ++i)
    u.segment<3>(3 * i) = H * Eigen::Map<const Eigen::Vector3d>(mesh.points[i].data());
  return u;
}

TEST(ReferenceCells, CarryLinearValuesFromStressPointsToTheirCorners)
{
  for (const CellKind kind : {CellKind::tetrahedron, CellKind::hexahedron, CellKind::prism})
  {
    const fem::ReferenceCell &cell    = fem::reference_cell(kind);
    const Eigen::Matrix3Xd    corners = cell.nodes.leftCols(cell.n_corners);
    EXPECT_LT((cell.samples * cell.to_corners - corners).norm(), 1e-12);
  }
}

TEST(MixedMeshes, AreNumberedWithOneNodeAPlace)
{
  for (const auto &[name, mesh, volume] : mixtures())
  {
    const fem::QuadraticMesh quadratic = fem::quadratic_mesh(mesh);
    std::set<int>            used_points, used;
    for (int cell = 0; cell < mesh.n_cells(); ++cell)
    {
      const fem::ReferenceCell &reference = fem::reference_cell(mesh.kind(cell));
      const int                *nodes     = quadratic.nodes(cell);
      used.insert(nodes, nodes + reference.n_nodes);
      used_points.insert(mesh.corners(cell), mesh.corners(cell) + reference.n_corners);
      for (int a = 0; a < reference.n_nodes; ++a)
      {
        fem::Point3 middle{};
        for (const int corner : reference.between[a])
          middle = middle + (1. / static_cast<double>(reference.between[a].size())) * quadratic.points[nodes[corner]];
        EXPECT_LT(fem::norm(middle - quadratic.points[nodes[a]]), 1e-12) << name << ", cell " << cell << ", node " << a;
      }
    }
    const int unused = static_cast<int>(mesh.points.size() - used_points.size());
    EXPECT_EQ(quadratic.n_nodes(), static_cast<int>(used.size())) << name;
    EXPECT_EQ(quadratic.n_nodes(), fem::number_of_nodes(mesh) - unused) << name << ": each edge and face counted once";
  }
}

TEST(MixedMeshes, PassThePatchTest)
{
  // A linear displacement has constant stress: no force on inner nodes, and the energy V eps : C : eps.
  Eigen::Matrix3d H;
  H << 1., 0.4, -0.2, 0.1, -0.5, 0.3, 0.6, 0.2, 0.8;
  const Eigen::Matrix3d eps    = 0.5 * (H + H.transpose());
  const double          lambda = steel.E * steel.nu / ((1. + steel.nu) * (1. - 2. * steel.nu));
  const double          mu     = steel.E / (2. * (1. + steel.nu));
  for (const auto &[name, mesh, volume] : mixtures())
  {
    const auto            quadratic = fem::quadratic_mesh(mesh);
    const auto            C         = FreeCells(quadratic).C;
    const Eigen::VectorXd u = linear_field(quadratic, H), f = C * u;
    const std::set<int>   outer = outer_nodes(quadratic);
    EXPECT_LT(static_cast<int>(outer.size()), quadratic.n_nodes());
    for (int i = 0; i < quadratic.n_nodes(); ++i)
      if (outer.count(i) == 0)
      {
        EXPECT_LT(f.segment<3>(3 * i).norm(), 1e-10 * f.cwiseAbs().maxCoeff()) << name;
      }
    const double energy = volume * (lambda * eps.trace() * eps.trace() + 2. * mu * eps.squaredNorm());
    EXPECT_NEAR(u.dot(f), energy, 1e-10 * energy) << name;
  }
}

TEST(MixedMeshes, LetRigidMotionsPassWithoutEnergyAndWeighWhatTheyShould)
{
  for (const auto &[name, mesh, volume] : mixtures())
  {
    const auto quadratic                 = fem::quadratic_mesh(mesh);
    const auto [materials, affine, C, M] = FreeCells(quadratic);
    const Eigen::MatrixXd R              = fem::rigid_displacements(quadratic, Eigen::Vector3d::Zero());
    EXPECT_LT((R.transpose() * (C * R)).norm(), 1e-10 * C.diagonal().maxCoeff()) << name;
    const double mass = steel.rho * volume, a = size()[0], b = size()[1];
    EXPECT_NEAR(R.col(0).dot(M * R.col(0)), mass, 1e-9 * mass) << name;
    if (name != "all three") // a whole box: about z through the origin (a^2 + b^2)/3 per mass
    {
      EXPECT_NEAR(R.col(5).dot(M * R.col(5)), mass * (a * a + b * b) / 3., 1e-9 * mass) << name;
    }
    EXPECT_EQ((C - Eigen::SparseMatrix<double>(C.transpose())).norm(), 0.) << "symmetric to the last bit";
    const auto   pieces = fem::tetrahedra_of(mesh);
    const double measured =
        std::accumulate(pieces.begin(), pieces.end(), 0.,
                        [&m = mesh](double sum, const auto &piece)
                        {
                          const auto at = [&](int k) { return m.points[piece[k]] - m.points[piece[0]]; };
                          return sum + fem::dot(fem::cross(at(1), at(2)), at(3)) / 6.;
                        });
    EXPECT_NEAR(measured, volume, 0.02 * volume) << name << ": quadrilaterals of distorted cells are not plane";
  }
}

// Pure bending with nu = 0 is a quadratic field that meets the clamped end: cells of degree two hold it exactly on any
// mesh.  The moment on the node enters as the linear traction of that field: theta = M l/(E I), w = M l^2/(2 E I).
TEST(MixedMeshes, BendExactlyUnderAnEndMomentWithoutPoissonsEffect)
{
  constexpr double length = 2., width = 0.2, height = 0.25, moment = 1e5;
  auto             specification = free_steel();
  specification.material.nu      = 0.;
  specification.supports         = {clamped("wall", {"x0"})};
  specification.interfaces       = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  specification.cuts             = {{"middle", {0.9, 0., 0.}, {1., 0., 0.}, ""}};
  const auto mixed               = [](int i, int, int) { return i < 2 ? CellKind::prism : CellKind::hexahedron; };
  const auto plies               = [](int, int, int k) { return k < 1 ? CellKind::prism : CellKind::tetrahedron; };
  for (const fem::Mesh &mesh :
       {box_mesh({3, 2, 2}, {length, width, height}), brick_mesh({4, 1, 1}, {length, width, height}),
        prism_mesh({4, 1, 1}, {length, width, height}), filled_mesh({4, 1, 1}, {length, width, height}, mixed),
        filled_mesh({4, 1, 2}, {length, width, height}, plies)})
  {
    const auto            frame = fem::discretise(mesh, specification);
    const auto           &tip   = frame.interfaces[0].coordinate;
    const double          EI    = 210e9 * width * std::pow(height, 3) / 12.;
    const Eigen::VectorXd q     = statics(frame, moment * Eigen::VectorXd::Unit(frame.C.rows(), tip[fem::ry]));
    EXPECT_NEAR(q[tip[fem::ry]], moment * length / EI, 1e-9 * moment * length / EI);
    EXPECT_NEAR(q[tip[fem::uz]], -moment * length * length / (2. * EI), 1e-9 * moment * length * length / (2. * EI));
    const Eigen::VectorXd pull = statics(frame, 1000. * Eigen::VectorXd::Unit(frame.C.rows(), tip[fem::ux]));
    EXPECT_NEAR(output(frame, "cut.middle").on_q.dot(pull), 1000., 1e-6);
  }
}

fem::FrameMatrices cantilever_of(const fem::Mesh &mesh)
{
  auto specification     = free_steel();
  specification.supports = {clamped("wall", {"x0"})};
  return fem::discretise(mesh, specification);
}

TEST(Prisms, ACantileversFrequencyFallsToThatOfFineHexahedra)
{
  const std::array<double, 3> beam  = {1., 0.1, 0.1};
  const double                truth = lowest_modes(cantilever_of(brick_mesh({24, 3, 3}, beam)), 1).frequency_hz[0];
  const auto                  error = [&](int n) {
    return lowest_modes(cantilever_of(prism_mesh({4 * n, n, n}, beam)), 1).frequency_hz[0] / truth - 1.;
  };
  const double coarse = error(1), fine = error(2);
  EXPECT_GT(fine, 0.);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, 0.4 * coarse) << "the corners at the wall leave no more than the first order or so";
}

/// A plate of 10 x 10 x 1 m with hard supports at its sides.
fem::FrameMatrices thick_plate(const fem::Mesh &mesh)
{
  fem::FrameSpecification specification;
  specification.material = {200e9, 0.3, 8000., "plate"};
  specification.supports = {clamped("x sides", {"x0", "x1"}, {{false, true, true}}),
                            clamped("y sides", {"y0", "y1"}, {{true, false, true}})};
  return fem::discretise(mesh, specification);
}

TEST(FlatCells, OneLayerOfHexahedraGivesAPlateItsFrequency)
{
  // 45.897 Hz after three-dimensional elasticity; cells 2.5 times as wide as thick.
  const double f = lowest_modes(thick_plate(brick_mesh({4, 4, 1}, {10., 10., 1.})), 1).frequency_hz[0];
  EXPECT_GT(f, 45.897);
  EXPECT_LT(f, 1.01 * 45.897);
}

TEST(FlatCells, FrequenciesFallWithTheFourthPowerOfTheCellSize)
{
  const double exact = std::sqrt(200e9 / 2.6 / 8000.) / 20.; // shear in the plane, the second mode
  const auto   error = [&](const fem::Mesh &mesh)
  {
    const Eigen::ArrayXd off = lowest_modes(thick_plate(mesh), 6).frequency_hz.array() / exact - 1.;
    Eigen::Index         nearest;
    off.abs().minCoeff(&nearest);
    return off[nearest];
  };
  for (const auto &[mesh, n] : {std::pair{brick_mesh, 2}, std::pair{prism_mesh, 3}})
  {
    const double coarse = error(mesh({n, n, 1}, {10., 10., 1.}, 0.)),
                 fine   = error(mesh({2 * n, 2 * n, 1}, {10., 10., 1.}, 0.));
    EXPECT_GT(fine, 0.) << n;
    EXPECT_NEAR(std::log2(coarse / fine), 4., 0.35) << n;
  }
}

TEST(MixedMeshes, InDegreeThreeKeepRigidMotionsFreeAndLinearFieldsAsTheyAre)
{
  for (const auto &[name, mesh, volume] : mixtures())
  {
    const auto quadratic                 = fem::quadratic_mesh(mesh);
    const auto [materials, affine, C, M] = FreeCells(quadratic);
    const auto raised                    = fem::raise_degree(quadratic, materials, affine, C, M);
    EXPECT_GT(raised.C.rows(), C.rows()) << name;
    const Eigen::MatrixXd R        = fem::rigid_displacements(quadratic, Eigen::Vector3d::Zero());
    Eigen::MatrixXd       R_raised = Eigen::MatrixXd::Zero(raised.C.rows(), 6);
    for (Eigen::Index i = 0; i < R.rows(); ++i)
      R_raised.row(raised.place[i]) = R.row(i);
    EXPECT_LT((raised.C * R_raised).cwiseAbs().maxCoeff(), 1e-9 * C.diagonal().maxCoeff())
        << name << ": no force on any function, quadratic or cubic";

    // Linear fields are those of the quadratics: the cubics feel no force inside.
    Eigen::Matrix3d H;
    H << 1., 0.4, -0.2, 0.1, -0.5, 0.3, 0.6, 0.2, 0.8;
    const Eigen::VectorXd u        = linear_field(quadratic, H);
    Eigen::VectorXd       u_raised = Eigen::VectorXd::Zero(raised.C.rows());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u_raised[raised.place[i]] = u[i];
    EXPECT_NEAR(u_raised.dot(raised.C * u_raised), u.dot(C * u), 1e-9 * u.dot(C * u)) << name;
  }
}

TEST(Hexahedra, CarryTheirWeightIntoAFoundation)
{
  auto specification          = free_steel();
  specification.supports      = {foundation("floor", {"z0"}, {1e8, 1e8, 2e8}, {1e4, 1e4, 3e4})};
  const auto            frame = fem::discretise(brick_mesh({2, 2, 2}, {1., 1., 1.}), specification);
  const Eigen::VectorXd q     = statics(frame, -9.81 * frame.acceleration_load.col(2));
  EXPECT_NEAR(output(frame, "support.floor.z").on_q.dot(q), 9.81 * 7850., 1e-6 * 9.81 * 7850.);
  EXPECT_NEAR(frame.translations.col(2).dot(frame.B * frame.translations.col(2)), 3e4, 1e-6);
}

TEST(MixedMeshes, OfCellsThatFoldAreRefused)
{
  for (auto mesh : {brick_mesh({1, 1, 1}, {1., 1., 1.}), prism_mesh({1, 1, 1}, {1., 1., 1.})})
  {
    mesh.points[7] = {-1., -1., -1.};
    expect_refusal([&] { fem::quadratic_mesh(mesh); }, "folds");
  }
}

/// A plate of hexahedra, with prisms around and under a boss of tetrahedra, in the order of gmsh.
fem::Mesh plate_with_boss()
{
  const std::string script = fem::test::write_text("boss.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-0.3, -0.2, 0, 0.6, 0.4}; Rectangle(2) = {0, -0.05, 0, 0.2, 0.2}; Disk(3) = {0.1, 0.05, 0, 0.055};
all() = BooleanFragments{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
plate() = Surface In BoundingBox{-0.4, -0.3, -0.01, 0.4, 0.3, 0.01};
inner() = Surface In BoundingBox{-0.01, -0.06, -0.01, 0.21, 0.16, 0.01};
plate() -= inner();
Recombine Surface{plate()};
Extrude {0, 0, 0.015} { Surface{all()}; Layers{1}; Recombine; }
disc() = Surface In BoundingBox{0.04, -0.01, 0.014, 0.16, 0.11, 0.016};
Extrude {0, 0, 0.08} { Surface{disc()}; }
Mesh.MeshSizeMax = 0.06;
Mesh 3;
)");
  return fem::make_mesh(fem::test::specification(script, 0.06));
}

TEST(MixedMeshes, OfGmshHaveOneNodeAtEachPlaceOfTheirCells)
{
  const fem::Mesh mesh = plate_with_boss();
  ASSERT_TRUE(!mesh.cells.empty() && !mesh.hexahedra.empty() && !mesh.prisms.empty());
  const fem::QuadraticMesh      quadratic = fem::quadratic_mesh(mesh);
  std::set<int>                 used;
  std::set<std::array<long, 3>> places; // in micrometres
  for (int cell = 0; cell < quadratic.n_cells(); ++cell)
  {
    const fem::ReferenceCell &reference = fem::reference_cell(quadratic.kind(cell));
    for (int a = 0; a < reference.n_nodes; ++a)
    {
      fem::Vector3 middle{};
      for (const int corner : reference.between[a])
        middle = middle + 1. / double(reference.between[a].size()) * quadratic.points[quadratic.nodes(cell)[corner]];
      ASSERT_NEAR(fem::norm(middle - quadratic.points[quadratic.nodes(cell)[a]]), 0., 1e-12) << "cell " << cell;
      used.insert(quadratic.nodes(cell)[a]);
    }
  }
  for (const auto &[x, y, z] : quadratic.points)
    places.insert({std::lround(1e6 * x), std::lround(1e6 * y), std::lround(1e6 * z)});
  EXPECT_EQ(int(used.size()), quadratic.n_nodes());
  EXPECT_EQ(int(places.size()), quadratic.n_nodes());
}

} // namespace
} // namespace gestell::test
