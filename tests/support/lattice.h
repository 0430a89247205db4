#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace gestell::test
{

/// A block of nx x ny x nz points joined by rods along edges and diagonals, three coordinates each: a frame made by
/// hand, positive definite once supported, with rigid motions known.
struct Lattice
{
  int    nx = 5, ny = 3, nz = 6;
  double stiffness  = 1e7; ///< of a rod of unit length [N/m]
  double point_mass = 2.;  ///< [kg]
  double foundation = 3e6; ///< [N/m] at each lowest point, in x, y and z; 0: the block floats
  double damper     = 2e3; ///< [N s/m] there

  int  point(int i, int j, int k) const { return (k * ny + j) * nx + i; }
  int  n_points() const { return nx * ny * nz; }
  auto position(int p) const { return Eigen::Vector3d(p % nx, 1.1 * (p / nx % ny), 0.9 * (p / (nx * ny))); }
};

inline void add_rod(std::vector<Eigen::Triplet<double>> &C, const Lattice &lattice, int p, int r)
{
  const Eigen::Vector3d along = lattice.position(r) - lattice.position(p), d = along.normalized();
  // stiffness differs from rod to rod, so that no two frequencies agree
  const double          k     = lattice.stiffness / along.norm() * (1. + 0.2 * std::sin(3. * p + 5. * r));
  const Eigen::Matrix3d block = k * d * d.transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      C.emplace_back(3 * p + i, 3 * p + j, block(i, j));
      C.emplace_back(3 * r + i, 3 * r + j, block(i, j));
      C.emplace_back(3 * p + i, 3 * r + j, -block(i, j));
      C.emplace_back(3 * r + i, 3 * p + j, -block(i, j));
    }
}

/// One interface of six coordinates at the points given: three displacements of each of two points.
inline fem::Interface interface_at(const std::string &name, int p, int r)
{
  return {name, {}, {3 * p, 3 * p + 1, 3 * p + 2, 3 * r, 3 * r + 1, 3 * r + 2}, {1., 1., 1., 1., 1., 1.}};
}

inline fem::FrameMatrices frame_of(const Lattice &lattice)
{
  std::vector<Eigen::Triplet<double>> M, B, C;
  for (int k = 0; k < lattice.nz; ++k)
    for (int j = 0; j < lattice.ny; ++j)
      for (int i = 0; i < lattice.nx; ++i)
        for (int dk = 0; dk < 2; ++dk)
          for (int dj = -dk; dj < 2; ++dj)
            for (int di = -(dk + std::abs(dj) > 0); di < 2; ++di)
              if ((di || dj || dk) && (dk || dj > 0 || (dj == 0 && di > 0)) && i + di >= 0 && i + di < lattice.nx &&
                  j + dj >= 0 && j + dj < lattice.ny && k + dk < lattice.nz)
                add_rod(C, lattice, lattice.point(i, j, k), lattice.point(i + di, j + dj, k + dk));

  const int          n = 3 * lattice.n_points();
  fem::FrameMatrices frame;
  for (int p = 0; p < lattice.n_points(); ++p)
    for (int d = 0; d < 3; ++d)
    {
      M.emplace_back(3 * p + d, 3 * p + d, lattice.point_mass * (1. + 0.1 * std::sin(7. * p)));
      if (p >= lattice.nx * lattice.ny)
        continue;
      C.emplace_back(3 * p + d, 3 * p + d, lattice.foundation);
      B.emplace_back(3 * p + d, 3 * p + d, lattice.damper);
    }
  for (auto [A, entries] : {std::pair(&frame.M, &M), std::pair(&frame.B, &B), std::pair(&frame.C, &C)})
  {
    A->resize(n, n);
    A->setFromTriplets(entries->begin(), entries->end());
  }

  const int top    = lattice.nz - 1;
  frame.interfaces = {interface_at("crown", lattice.point(0, 0, top), lattice.point(2, 1, top)),
                      interface_at("table", lattice.point(1, 1, 1), lattice.point(3, 2, 2))};
  frame.rigid_motions.resize(n, 6);
  frame.picture.displacement.resize(n, n);
  frame.picture.displacement.setIdentity();
  for (int p = 0; p < lattice.n_points(); ++p)
  {
    const Eigen::Vector3d x = lattice.position(p);
    frame.picture.points.push_back({x(0), x(1), x(2)});
    for (int d = 0; d < 3; ++d)
    {
      frame.rigid_motions.block<3, 1>(3 * p, d)     = Eigen::Vector3d::Unit(d);
      frame.rigid_motions.block<3, 1>(3 * p, 3 + d) = Eigen::Vector3d::Unit(d).cross(x);
    }
  }
  frame.translations = frame.rigid_motions.leftCols(3);
  frame.mass         = frame.translations.col(0).dot(frame.M * frame.translations.col(0));

  fem::FrameOutput support{"support.feet.z", "N", Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  for (int p = 0; p < lattice.nx * lattice.ny; ++p)
  {
    support.on_q(3 * p + 2) = lattice.foundation;
    support.on_v(3 * p + 2) = lattice.damper;
  }
  frame.outputs = {support};
  return frame;
}

} // namespace gestell::test
