#include "fem/assembly/rigid_body_modes.h"

#include "fem/assembly/rigid_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>
#include <sstream>

namespace gestell::fem
{

namespace
{

const char *const axis_names[3] = {"x", "y", "z"};

// Directions closer than this to an axis bear the name of the axis.
constexpr double alike = 1e-3;

std::string triple(const Eigen::Vector3d &v)
{
  std::ostringstream text;
  text.precision(3);
  text << "(";
  for (int d = 0; d < 3; ++d)
    text << (std::abs(v[d]) < 1e-9 ? 0. : v[d]) << (d < 2 ? ", " : ")");
  return text.str();
}

std::string direction_name(const Eigen::Vector3d &direction)
{
  for (int d = 0; d < 3; ++d)
    if (std::abs(std::abs(direction[d]) - 1.) < alike)
      return axis_names[d];
  return triple(direction);
}

/// sum_ij |z_i| |C_ij| |z_j| for every column z: the energies that cancel in a free motion.
Eigen::VectorXd cancelling_energy(const Eigen::SparseMatrix<double> &C, const Eigen::MatrixXd &Z)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(Z.cols());
  for (int column = 0; column < C.outerSize(); ++column)
  {
    Eigen::VectorXd partners = Eigen::VectorXd::Zero(Z.cols());
    for (Eigen::SparseMatrix<double>::InnerIterator entry(C, column); entry; ++entry)
      partners += std::abs(entry.value()) * Z.row(entry.row()).cwiseAbs().transpose();
    sum += partners.cwiseProduct(Z.row(column).cwiseAbs().transpose());
  }
  return sum;
}

/// Groups of coordinates that the pattern of C connects while others are fixed.
std::vector<std::vector<int>> connected_parts(const Eigen::SparseMatrix<double> &C, const std::vector<int> &held)
{
  std::vector<char> done(C.rows(), 0);
  for (const int i : held)
    done[i] = 1;
  std::vector<std::vector<int>> parts;
  for (int start = 0; start < C.rows(); ++start)
  {
    if (done[start])
      continue;
    done[start]           = 1;
    std::vector<int> part = {start};
    for (std::size_t next = 0; next < part.size(); ++next)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(C, part[next]); entry; ++entry)
        if (!done[entry.row()])
        {
          done[entry.row()] = 1;
          part.push_back(static_cast<int>(entry.row()));
        }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Mean position of the coordinates that are displacements. The rotations about the centre of the frame give y and z of
/// a displacement along x.
Eigen::Vector3d middle_of(const FrameMatrices &frame, const std::vector<int> &part)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), count = Eigen::Vector3d::Constant(1e-300);
  for (const int i : part)
    for (int d = 0; d < 3; ++d)
    {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      if ((frame.rigid_motions.row(i).head<3>() - Eigen::RowVector3d::Unit(d)).norm() > 0.)
        continue;
      sum[e] -= frame.rigid_motions(i, 3 + f);
      sum[f] += frame.rigid_motions(i, 3 + e);
      count[e] += 1.;
      count[f] += 1.;
    }
  return Eigen::Map<const Eigen::Vector3d>(frame.centre.data()) + sum.cwiseQuotient(count);
}

/// Free motions of a part as columns (u0, theta L), orthonormal [6 x k].
Eigen::MatrixXd free_space(const FrameMatrices &frame, const std::vector<int> &part, double length)
{
  Eigen::MatrixXd Z   = Eigen::MatrixXd::Zero(frame.C.rows(), 6);
  Z(part, Eigen::all) = frame.rigid_motions(part, Eigen::all);
  Z.rightCols(3) /= length;
  const Eigen::MatrixXd energy = Z.transpose() * (frame.C * Z);
  Eigen::MatrixXd       size   = Z.transpose() * Z;
  size.diagonal().array() += 1e-12 * size.trace(); // a motion of fixed coordinates only has size zero
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> candidates(energy, size);

  const Eigen::MatrixXd motions = Z * candidates.eigenvectors();
  const Eigen::VectorXd scale   = cancelling_energy(frame.C, motions);
  const Eigen::VectorXd value   = motions.cwiseProduct(frame.C * motions).colwise().sum();
  Eigen::MatrixXd       result(6, 0);
  // A motion is free when its energy is rounding: this share of the energies that cancel in it.
  constexpr double free_share = 1e-13;
  for (int k = 0; k < 6; ++k)
    if (!(value[k] > free_share * scale[k]))
    {
      result.conservativeResize(6, result.cols() + 1);
      result.rightCols(1) = candidates.eigenvectors().col(k);
    }
  if (result.cols() == 0)
    return result;
  return Eigen::HouseholderQR<Eigen::MatrixXd>(result).householderQ() * Eigen::MatrixXd::Identity(6, result.cols());
}

/// Removes the unit motion e_i from the space if it is contained in it.
bool take_out(Eigen::MatrixXd &space, int i)
{
  const Eigen::VectorXd along = space.row(i).transpose();
  if ((space * along - Eigen::VectorXd::Unit(6, i)).norm() > alike)
    return false;
  const Eigen::MatrixXd full = Eigen::HouseholderQR<Eigen::MatrixXd>(along).householderQ();
  space                      = (space * full).rightCols(space.cols() - 1).eval();
  return true;
}

std::string rotation_name(const Eigen::VectorXd &motion, const Eigen::Vector3d &centre, double length)
{
  const Eigen::Vector3d u0 = motion.head<3>(), theta = motion.tail<3>() / length;
  const Eigen::Vector3d axis  = theta.normalized();
  const Eigen::Vector3d point = centre + theta.cross(u0) / theta.squaredNorm();
  std::string           text  = "rotation about " + direction_name(axis) + " through " + triple(point) + " m";
  if (std::abs(axis.dot(u0)) > alike * length * theta.norm())
    text += " with a screw along it";
  return text;
}

/// Names of the motions in a space of them.
std::vector<std::string> names_of(Eigen::MatrixXd space, const Eigen::Vector3d &centre, double length)
{
  std::vector<std::string> names;
  for (int i = 0; i < 6 && space.cols() > 0; ++i)
    if (take_out(space, i))
      names.push_back((i < 3 ? "translation along " : "rotation about ") + std::string(axis_names[i % 3]));
  if (space.cols() == 0)
    return names;

  // The remaining motions are oblique: translations first.
  const Eigen::MatrixXd                   rotations = space.bottomRows(3);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rotations, Eigen::ComputeFullV);
  for (int k = static_cast<int>(space.cols()) - 1; k >= 0; --k)
  {
    const Eigen::VectorXd motion = space * svd.matrixV().col(k);
    if (motion.tail<3>().norm() < alike)
      names.push_back("translation along " + direction_name(motion.head<3>().normalized()));
    else
      names.push_back(rotation_name(motion, centre, length));
  }
  return names;
}

/// Length that makes rotations comparable with displacements [m].
double length_of(const FrameMatrices &frame)
{
  return std::sqrt(frame.rigid_motions.rightCols(3).squaredNorm() /
                   std::max(frame.rigid_motions.leftCols(3).squaredNorm(), 1e-300));
}

} // namespace

Eigen::MatrixXd free_displacements(const FrameMatrices &frame)
{
  Eigen::MatrixXd result(frame.C.rows(), 0);
  if (frame.rigid_motions.cols() != 6)
    return result;
  const double length = length_of(frame);
  for (const std::vector<int> &part : connected_parts(frame.C, {}))
  {
    const Eigen::MatrixXd space = free_space(frame, part, length);
    Eigen::MatrixXd       Z     = frame.rigid_motions(part, Eigen::all);
    Z.rightCols(3) /= length;
    result.conservativeResize(Eigen::NoChange, result.cols() + space.cols());
    result.rightCols(space.cols()).setZero();
    for (Eigen::Index k = 0; k < space.cols(); ++k)
      result.col(result.cols() - space.cols() + k)(part) = Z * space.col(k);
  }
  return result;
}

std::vector<std::string> free_motions(const FrameMatrices &frame, const std::vector<int> &held)
{
  if (frame.rigid_motions.cols() != 6)
    return {};
  const double                        length = length_of(frame);
  const std::vector<std::vector<int>> parts  = connected_parts(frame.C, held);
  std::vector<std::string>            names;
  // Number of parts whose motions are named; with more parts, the cells of the mesh are not connected.
  constexpr std::size_t most_parts = 20;
  for (std::size_t part = 0; part < std::min(parts.size(), most_parts); ++part)
    for (std::string &name : names_of(free_space(frame, parts[part], length),
                                      Eigen::Map<const Eigen::Vector3d>(frame.centre.data()), length))
    {
      if (parts.size() > 1)
        name += " of part " + std::to_string(part + 1) + " of " + std::to_string(parts.size()) + ", near " +
                triple(middle_of(frame, parts[part])) + " m";
      names.push_back(std::move(name));
    }
  return names;
}

} // namespace gestell::fem
