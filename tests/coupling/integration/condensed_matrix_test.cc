// Newton's matrix condensed to the scalars of elements and the equations of joints, against the one of all measures.

#include "coupling/integration/step/condensed_matrix.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

struct BlocksOfJoints : IdealJoints
{
  const std::vector<ConstraintBlock> &blocks() const override { return all; }
  std::vector<ConstraintBlock>        all;
};

/// A frame of six coupled coordinates and bodies of six each; elements of 1, 12, 2, 7, ... measures, after the first of
/// them a joint of nine.
class RandomMechanism : public SmallSystem
{
public:
  RandomMechanism(unsigned seed, int n_bodies, int n_elements, int n_joints,
                  const std::array<int, 4> &n_measures = {1, 12, 2, 7})
      : SmallSystem(Matrix::Identity(6 + 6 * n_bodies, 6 + 6 * n_bodies), {}, {}), engine(seed)
  {
    const Matrix frame = random(6, 6);
    M.topLeftCorner(6, 6) += frame * frame.transpose();
    for (int e = 0; e < n_elements; ++e)
    {
      const int k = n_measures[std::size_t(e % 4)];
      elements.push_back({n_u_, k});
      add_measures(k);
      if (e >= n_joints)
        continue;
      own_joints.all.push_back({own_joints.n_rows(), 1 + e % 3, n_u_, 9, 1.});
      add_measures(9);
    }
    W.resize(M.rows(), n_u_);
    W.setFromTriplets(columns_.begin(), columns_.end());
  }

  const IdealJoints      &joints() const override { return own_joints; }
  std::vector<ForceBlock> blocks() const override { return elements; }

  double number() { return std::uniform_real_distribution<double>(-1., 1.)(engine); }
  Matrix random(Eigen::Index rows, Eigen::Index columns)
  {
    return Matrix::NullaryExpr(rows, columns, [this] { return number(); });
  }

  std::mt19937            engine;
  std::vector<ForceBlock> elements;
  BlocksOfJoints          own_joints;

private:
  int  coordinate() { return std::uniform_int_distribution<int>(0, int(M.rows()) - 1)(engine); }
  void add_measures(int k)
  {
    for (const int end = n_u_ + k; n_u_ < end; ++n_u_)
      for (int i = 0; i < 1 + n_u_ % 2; ++i)
        columns_.emplace_back(coordinate(), n_u_, number());
  }

  int                                 n_u_ = 0;
  std::vector<Eigen::Triplet<double>> columns_;
};

/// S from M^-1, p' with few scalars per element, and G.
struct Linearised
{
  explicit Linearised(RandomMechanism &mechanism, int rank)
      : loaded(std::make_shared<const LoadedCoordinates>(mechanism.W)), G(mechanism.own_joints.all),
        tangent(tangent_size(mechanism.elements)), dense(Matrix::Zero(mechanism.W.cols(), mechanism.W.cols()))
  {
    const Matrix inverse = mechanism.M.inverse();
    Matrix       Y(inverse.rows(), loaded->size());
    for (int i = 0; i < loaded->size(); ++i)
      Y.col(i) = inverse * loaded->unit_force(i);
    S                  = Compliance(loaded, Y);
    dense_S            = mechanism.W.transpose() * inverse * mechanism.W;
    Eigen::Index first = 0;
    for (const auto &[measure, k, size] : mechanism.elements)
    {
      const Matrix p = mechanism.random(k, std::min(rank, k)) * mechanism.random(std::min(rank, k), k);
      dense.block(measure, measure, k, k) = p;
      tangent.segment(first, k * k)       = p.reshaped();
      first += k * k;
    }
    for (std::size_t i = 0; i < mechanism.own_joints.all.size(); ++i)
      G[i] = mechanism.random(G[i].rows(), G[i].cols());
  }

  std::shared_ptr<const LoadedCoordinates> loaded;
  Compliance                               S;
  ConstraintJacobian                       G;
  Vector                                   tangent;
  Matrix                                   dense, dense_S;
};

/// delta (the change of the force where a measure sticks) and dlambda of the bordered matrix of all measures.
Vector dense_solution(const Linearised &at, const std::vector<HeldMeasure> &held, const Vector &r, const Vector &g)
{
  const auto n_u = r.size(), n_c = g.size();
  Matrix     G = Matrix::Zero(n_c, n_u), K = Matrix::Zero(n_u + n_c, n_u + n_c);
  for (std::size_t i = 0; i < at.G.blocks().size(); ++i)
  {
    const ConstraintBlock &b                                      = at.G.blocks()[i];
    G.block(b.first_row, b.first_measure, b.n_rows, b.n_measures) = at.G[i];
  }
  Matrix forces = at.dense, moved = Matrix::Identity(n_u, n_u);
  for (const HeldMeasure &h : held)
  {
    forces(h.measure, h.measure) = 1.;
    moved(h.measure, h.measure)  = 0.;
  }
  K.topLeftCorner(n_u, n_u)    = moved - at.dense_S * forces;
  K.topRightCorner(n_u, n_c)   = -at.dense_S * G.transpose();
  K.bottomLeftCorner(n_c, n_u) = G;
  Vector sides(n_u + n_c);
  sides << r, -g;
  return K.fullPivLu().solve(sides);
}

/// Largest difference from the dense solution, relative to the largest number of it.
double difference(RandomMechanism &mechanism, const Linearised &at, const std::vector<HeldMeasure> &held,
                  CondensedMatrix &matrix)
{
  Vector       r = mechanism.random(mechanism.W.cols(), 1), g = mechanism.random(at.G.n_rows(), 1);
  const Vector expected = dense_solution(at, held, r, g);
  matrix.set_joints(at.S, at.G);
  if (!matrix.factorise(at.S, at.tangent, held))
    return std::numeric_limits<double>::infinity();
  matrix.solve_in_place(at.S, at.G, r, g);
  Vector solution(expected.size());
  solution << r, g;
  return (solution - expected).lpNorm<Eigen::Infinity>() / expected.lpNorm<Eigen::Infinity>();
}

TEST(CondensedMatrix, GivesTheSolutionOfTheDenseMatrixOfAllMeasures)
{
  int by_measures = 0, by_coordinates = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    RandomMechanism mechanism(seed, 1 + int(seed % 4), 1 + int(seed % 9), int(seed % 3));
    CondensedMatrix matrix(mechanism, LoadedCoordinates(mechanism.W));
    for (const int rank : {0, 1, 2, 12})
    {
      const Linearised at(mechanism, rank);
      (at.loaded->are_measures() ? by_measures : by_coordinates) += 1;
      // Condition numbers of random matrices are below 1e4; the largest of 160 may be one of a hundred times that.
      EXPECT_LT(difference(mechanism, at, {}, matrix), 1e-11) << "seed " << seed << ", rank " << rank;
    }
  }
  EXPECT_GT(by_measures, 20);
  EXPECT_GT(by_coordinates, 20);
}

TEST(CondensedMatrix, AMeasureThatSticksHasItsForceAsUnknown)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    RandomMechanism   mechanism(seed, 3, 6, 2);
    Linearised        at(mechanism, 1);
    const ForceBlock &sticks                             = mechanism.elements[4]; // of one measure
    at.dense(sticks.first_measure, sticks.first_measure) = 0.;
    Eigen::Index first                                   = 0;
    for (int e = 0; e < 4; ++e)
      first += mechanism.elements[std::size_t(e)].n_measures * mechanism.elements[std::size_t(e)].n_measures;
    at.tangent[first] = 0.;
    CondensedMatrix matrix(mechanism, *at.loaded);
    EXPECT_LT(difference(mechanism, at, {{sticks.first_measure, 0.}}, matrix), 1e-11) << "seed " << seed;
  }
}

/// Elements of few measures without joints: PlainMatrix.
TEST(CondensedMatrix, FewMeasuresWithoutJointsHaveTheSolutionOfTheDenseMatrix)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    RandomMechanism mechanism(seed, 2, 1 + int(seed % 5), 0, {1, 3, 1, 2});
    CondensedMatrix matrix(mechanism, LoadedCoordinates(mechanism.W));
    for (const int rank : {0, 1, 3})
      EXPECT_LT(difference(mechanism, Linearised(mechanism, rank), {}, matrix), 1e-11) << seed << ", rank " << rank;
    if (seed % 5 < 2)
      continue;
    Linearised at(mechanism, 2); // the third element, of one measure, sticks
    const int  sticks                   = mechanism.elements[2].first_measure;
    at.dense(sticks, sticks)            = 0.;
    at.tangent[1 * 1 + 3 * 3]           = 0.;
    const std::vector<HeldMeasure> held = {{sticks, 0.}};
    EXPECT_LT(difference(mechanism, at, held, matrix), 1e-11) << "seed " << seed << ", sticking";
  }
}

TEST(CondensedMatrix, AnElementCountsByTheScalarsItSees)
{
  RandomMechanism mechanism(7, 3, 4, 1); // of 1, 12, 2 and 7 measures
  CondensedMatrix matrix(mechanism, LoadedCoordinates(mechanism.W));
  const auto      n_scalars = [&](int rank)
  {
    EXPECT_LT(difference(mechanism, Linearised(mechanism, rank), {}, matrix), 1e-11);
    return matrix.n_scalars();
  };
  EXPECT_EQ(n_scalars(0), 0) << "open contacts cost nothing";
  EXPECT_EQ(n_scalars(1), 1 + 1 + 2 + 1) << "up to three measures are used as they are";
  EXPECT_EQ(n_scalars(2), 1 + 2 + 2 + 2);
  EXPECT_EQ(n_scalars(12), 1 + 12 + 2 + 7);
}

/// A small second scalar beside a large one is not rounding: entries are compared with their own terms.
TEST(CondensedMatrix, KeepsAScalarOfAnotherUnit)
{
  RandomMechanism mechanism(3, 2, 2, 0);
  Linearised      at(mechanism, 0);
  for (int i = 0; i < 6; ++i) // the measures 0 to 5 of the second element, then the other six in a unit of 1e-14
    for (int j = 0; j < 6; ++j)
    {
      at.dense(1 + i, 1 + j) = at.tangent[1 + i + 12 * j] = 0.1 * (1 + i) * (1 + j);
      at.dense(7 + i, 7 + j) = at.tangent[1 + 6 + i + 12 * (6 + j)] = 1e-17 * (1 + i) * (6 - j);
    }
  CondensedMatrix matrix(mechanism, *at.loaded);
  EXPECT_LT(difference(mechanism, at, {}, matrix), 1e-11);
  EXPECT_EQ(matrix.n_scalars(), 2);
}

/// The contraction that old factors leave is not bounded by the change of p' where forces do not resist the motion (an
/// unbalance pushes by accelerations).
TEST(CondensedMatrix, KeepsFactorsOfTheSameTangentOnly)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    RandomMechanism mechanism(seed, 3, 6, 2);
    Linearised      at(mechanism, 1);
    CondensedMatrix matrix(mechanism, *at.loaded);
    ASSERT_LT(difference(mechanism, at, {}, matrix), 1e-11);
    const Vector      r = mechanism.random(mechanism.W.cols(), 1), g = mechanism.random(at.G.n_rows(), 1);
    const ForceBlock &element = mechanism.elements[seed % 6];
    Eigen::Index      first   = 0;
    for (std::size_t e = 0; e < seed % 6; ++e)
      first += mechanism.elements[e].n_measures * mechanism.elements[e].n_measures;
    for (const double change : {0., 1e-10, 1e-6, 1e-2})
    {
      at.tangent[first] += change;
      at.dense(element.first_measure, element.first_measure) += change;
      ASSERT_TRUE(matrix.factorise(at.S, at.tangent, {}));
      Vector now = r, of_joints = g;
      matrix.solve_in_place(at.S, at.G, now, of_joints);
      const Vector exact = dense_solution(at, {}, r, g).head(now.size());
      EXPECT_LT((now - exact).norm(), 1e-11 * exact.norm()) << "seed " << seed << ", change " << change;
    }
  }
}

/// A consistent start solves linear equations once.
TEST(CondensedMatrix, KeepsNoFactorsOfForcesThatAreGone)
{
  RandomMechanism mechanism(5, 3, 4, 1);
  Linearised      at(mechanism, 0);
  CondensedMatrix matrix(mechanism, *at.loaded);
  at.tangent[0] = at.dense(0, 0) = -1e-9;
  ASSERT_LT(difference(mechanism, at, {}, matrix), 1e-11);
  ASSERT_EQ(matrix.n_scalars(), 1);
  at.tangent[0] = at.dense(0, 0) = 0.;
  EXPECT_LT(difference(mechanism, at, {}, matrix), 1e-11);
  EXPECT_EQ(matrix.n_scalars(), 0);
}

TEST(Compliance, ActsAsTheMatrixOfAllMeasures)
{
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    RandomMechanism  mechanism(seed, 1 + int(seed % 4), 1 + int(seed), 2);
    const Linearised at(mechanism, 1);
    const Vector     p = mechanism.random(mechanism.W.cols(), 1), start = mechanism.random(mechanism.W.cols(), 1);
    Vector           u = start;
    at.S.add_times(p, u);
    const double size = at.dense_S.cwiseAbs().maxCoeff();
    EXPECT_LT((u - start - at.dense_S * p).lpNorm<Eigen::Infinity>(), 1e-13 * size * double(p.size()));
    EXPECT_LT((at.S.matrix() - at.dense_S).lpNorm<Eigen::Infinity>(), 1e-13 * size * double(p.size()));
    const Vector terms = at.dense_S.cwiseAbs() * p.cwiseAbs(), &bounds = at.S.magnitudes(p);
    for (Eigen::Index j = 0; j < p.size(); ++j)
    {
      EXPECT_NEAR(at.S.own(int(j)), at.dense_S(j, j), 1e-13 * size);
      EXPECT_GE(bounds[j], terms[j] * (1. - 1e-13));
    }
  }
}

} // namespace
} // namespace gestell::tests
