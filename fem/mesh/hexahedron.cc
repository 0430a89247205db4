#include "fem/mesh/hexahedron.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::fem::hexahedron
{

namespace
{

/// Quadratic of the node at -1, 0 or 1, and its slope.
double quadratic(int node, double x)
{
  return node == 0 ? 0.5 * x * (x - 1.) : node == 1 ? 1. - x * x : 0.5 * x * (x + 1.);
}
double slope(int node, double x)
{
  return node == 0 ? x - 0.5 : node == 1 ? -2. * x : x + 0.5;
}

struct Gauss
{
  std::vector<double> points, weights;
};

Gauss gauss(int n)
{
  if (n == 2)
    return {{-std::sqrt(1. / 3.), std::sqrt(1. / 3.)}, {1., 1.}};
  if (n == 4)
  {
    const double near  = std::sqrt(3. / 7. - 2. / 7. * std::sqrt(1.2)),
                 far   = std::sqrt(3. / 7. + 2. / 7. * std::sqrt(1.2));
    const double heavy = 0.5 + std::sqrt(30.) / 36., light = 0.5 - std::sqrt(30.) / 36.;
    return {{-far, -near, near, far}, {light, heavy, heavy, light}};
  }
  return {{-std::sqrt(0.6), 0., std::sqrt(0.6)}, {5. / 9., 8. / 9., 5. / 9.}};
}

std::vector<QuadraturePoint> rule(int n)
{
  const Gauss                  line = gauss(n);
  std::vector<QuadraturePoint> result;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const Eigen::Vector3d xi(line.points[i], line.points[j], line.points[k]);
        result.push_back({xi, line.weights[i] * line.weights[j] * line.weights[k], values(xi), gradients(xi)});
      }
  return result;
}

} // namespace

Values values(const Eigen::Vector3d &xi)
{
  Values N;
  for (int a = 0; a < n_nodes; ++a)
    N[a] = quadratic(a % 3, xi[0]) * quadratic(a / 3 % 3, xi[1]) * quadratic(a / 9, xi[2]);
  return N;
}

Gradients gradients(const Eigen::Vector3d &xi)
{
  Gradients dN;
  for (int a = 0; a < n_nodes; ++a)
  {
    const int i = a % 3, j = a / 3 % 3, k = a / 9;
    dN(a, 0) = slope(i, xi[0]) * quadratic(j, xi[1]) * quadratic(k, xi[2]);
    dN(a, 1) = quadratic(i, xi[0]) * slope(j, xi[1]) * quadratic(k, xi[2]);
    dN(a, 2) = quadratic(i, xi[0]) * quadratic(j, xi[1]) * slope(k, xi[2]);
  }
  return dN;
}

const std::vector<QuadraturePoint> &quadrature(int n)
{
  static const std::vector<QuadraturePoint> two = rule(2), three = rule(3), four = rule(4);
  return n == 2 ? two : n == 3 ? three : four;
}

Eigen::Vector3d node_position(int node)
{
  return {node % 3 - 1., node / 3 % 3 - 1., node / 9 - 1.};
}

Eigen::Matrix<double, 9, 9> face_mass(const Eigen::Matrix<double, 3, 9> &X)
{
  const Gauss                 line   = gauss(3);
  Eigen::Matrix<double, 9, 9> result = Eigen::Matrix<double, 9, 9>::Zero();
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
    {
      const double                x = line.points[i], y = line.points[j];
      Eigen::Matrix<double, 9, 1> N, along_x, along_y;
      for (int a = 0; a < 9; ++a)
      {
        N[a]       = quadratic(a % 3, x) * quadratic(a / 3, y);
        along_x[a] = slope(a % 3, x) * quadratic(a / 3, y);
        along_y[a] = quadratic(a % 3, x) * slope(a / 3, y);
      }
      const Eigen::Vector3d tx = X * along_x, ty = X * along_y;
      result += line.weights[i] * line.weights[j] * tx.cross(ty).norm() * N * N.transpose();
    }
  return 0.5 * (result + result.transpose());
}

} // namespace gestell::fem::hexahedron
