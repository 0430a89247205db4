#include "coupling/integration/propagation/modal_blocks.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

[[noreturn]] void refuse(const std::string &reason)
{
  throw std::invalid_argument("exact propagation: " + reason);
}

/// Null space of the symmetric C [n x n_r], found with C scaled to unit diagonal.
MatrixXd motions_without_stiffness(const MatrixXd &C)
{
  const auto                 n = C.rows();
  const VectorXd             d = C.diagonal().unaryExpr([](double c) { return c > 0. ? 1. / std::sqrt(c) : 1.; });
  const SymmetricEigenSolver modes(d.asDiagonal() * C * d.asDiagonal());
  Eigen::Index               n_r = 0;
  // eigenvalue of C scaled to unit diagonal, per coordinate, that counts as zero
  constexpr double no_stiffness = 1e-13;
  constexpr double negative     = 1e-8; // likewise, below zero: more than rounding
  if (n > 0 && modes.eigenvalues()[0] < -negative)
    refuse("the stiffness matrix of the base is not positive semidefinite; model negative stiffness as an element");
  while (n_r < n && modes.eigenvalues()[n_r] < no_stiffness * double(n))
    ++n_r;
  return d.asDiagonal() * modes.eigenvectors().leftCols(n_r);
}

/// Columns of R made M-orthonormal.
MatrixXd orthonormal(const MatrixXd &R, const MatrixXd &M)
{
  if (R.cols() == 0)
    return R;
  const Eigen::LLT<MatrixXd> gram(R.transpose() * M * R);
  return gram.matrixL().solve(R.transpose()).transpose();
}

/// Undamped modes: without stiffness first, Phi^T M Phi = E, omega of the others ascending.
struct RealModes
{
  int      n_free; ///< without stiffness
  MatrixXd Phi;    // [n x n]
  VectorXd omega;  // [n], zero for the first n_free
};

RealModes real_modes(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C,
                     const std::function<std::string(int)> &coordinate_name)
{
  const Eigen::LLT<MatrixXd> cholesky(M);
  const VectorXd             pivots = cholesky.matrixLLT().diagonal();
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    if (!(M(i, i) > 0.) || !(pivots[i] * pivots[i] > 1e-14 * M(i, i)))
      refuse("the mass matrix is singular at " + coordinate_name(int(i)) + "; give it mass, or use the method bdf");
  if (cholesky.info() != Eigen::Success)
    refuse("the mass matrix is not positive definite; use the method bdf");

  RealModes                   modes;
  const SymmetricPencilSolver solver(C, M);
  MatrixXd                    R = orthonormal(motions_without_stiffness(C), M);
  if (R.cols() > 1) // separates undamped motions from damped ones
    R = R * SymmetricEigenSolver(R.transpose() * B * R).eigenvectors();
  modes.n_free = int(R.cols());
  modes.Phi    = solver.eigenvectors();
  modes.omega  = solver.eigenvalues().unaryExpr([](double x) { return std::sqrt(std::max(0., x)); });
  if (R.cols() == 0)
    return modes;
  modes.omega.head(R.cols()).setZero();
  modes.Phi.leftCols(R.cols()) = R;
  auto rest                    = modes.Phi.rightCols(M.rows() - R.cols());
  rest -= R * (R.transpose() * M * rest);
  return modes;
}

/// Collects blocks with their columns of the state y = (q, q') and rows of its inverse.
struct Assembly
{
  std::vector<ModalBlock> blocks;
  MatrixXd                Q, V, from_q, from_v;
  Eigen::Index            n, used = 0;

  explicit Assembly(Eigen::Index size)
      : Q(MatrixXd::Zero(size, 2 * size)), V(Q), from_q(MatrixXd::Zero(2 * size, size)), from_v(from_q), n(size)
  {
  }
};

/// Modes that no damping couples: eta'' + 2 delta eta' + omega^2 eta = phi^T f.
void add_real_mode(const VectorXd &phi, const VectorXd &M_phi, double omega, double two_delta, Assembly &to)
{
  const auto column = to.used;
  to.used += 2;
  double delta = 0.5 * two_delta;
  if (omega == 0. && delta == 0.)
  {
    to.blocks.push_back({ModalBlock::free, 0., 0.});
    to.Q.col(column)          = phi;
    to.V.col(column + 1)      = phi;
    to.from_q.row(column)     = M_phi;
    to.from_v.row(column + 1) = M_phi;
    return;
  }
  constexpr double critical_ratio = 1e-12; // distance kept from critical damping, where two eigenvectors coincide
  if (omega > 0. && std::abs(delta - omega) < critical_ratio * omega)
    delta = omega * (1. - critical_ratio);
  if (delta < omega)
  {
    // eta = x_1, eta' = -delta x_1 - w x_2
    const double w = omega * std::sqrt((1. - delta / omega) * (1. + delta / omega));
    to.blocks.push_back({ModalBlock::oscillating, -delta, w});
    to.Q.col(column)          = phi;
    to.V.col(column)          = -delta * phi;
    to.V.col(column + 1)      = -w * phi;
    to.from_q.row(column)     = M_phi;
    to.from_q.row(column + 1) = (-delta / w) * M_phi;
    to.from_v.row(column + 1) = (-1. / w) * M_phi;
    return;
  }
  // Two real eigenvalues a > b:  eta = x_1 + x_2, eta' = a x_1 + b x_2
  const double root = std::sqrt((delta - omega) * (delta + omega));
  const double b = -delta - root, a = omega > 0. ? omega * omega / b : 0., inverse = 1. / (a - b);
  to.blocks.push_back({ModalBlock::decaying, a, b});
  to.Q.col(column)          = phi;
  to.Q.col(column + 1)      = phi;
  to.V.col(column)          = a * phi;
  to.V.col(column + 1)      = b * phi;
  to.from_q.row(column)     = (-b * inverse) * M_phi;
  to.from_v.row(column)     = inverse * M_phi;
  to.from_q.row(column + 1) = (a * inverse) * M_phi;
  to.from_v.row(column + 1) = -inverse * M_phi;
}

/**
 * Modes coupled by damping, by the eigenvectors of the state matrix of  y = (Omega_s eta_s, eta'); motions without
 * stiffness but with damping have only their velocity in y, their displacement is added as a zero eigenvalue.
 */
class CoupledModes
{
public:
  CoupledModes(const VectorXd &omega, const MatrixXd &D) : omega_(omega), n_(D.rows())
  {
    while (n_0_ < n_ && omega[n_0_] == 0.)
      ++n_0_;
    find_eigenvectors(state_matrix(D));
    inverse_                    = X_.partialPivLu().inverse();
    constexpr double coinciding = 1e10; // condition of the eigenvectors: beyond it six digits are left of 16
    if (!inverse_.allFinite() || !(X_.norm() * inverse_.norm() < coinciding * double(X_.rows())))
      refuse("two modes of the damped system coincide in frequency, damping and shape (critical damping across modes); "
             "change a damper slightly, or use the method bdf");
    find_displacements();
  }

  void add(const MatrixXd &Phi, const MatrixXd &M_Phi, Assembly &to) const;

private:
  Eigen::Index n_stiff() const { return n_ - n_0_; }

  MatrixXd state_matrix(const MatrixXd &D) const
  {
    const auto n_s = n_stiff(), size = n_s + n_;
    MatrixXd   A                = MatrixXd::Zero(size, size);
    A.bottomRightCorner(n_, n_) = -D;
    for (Eigen::Index i = 0; i < n_s; ++i)
    {
      A(i, n_s + n_0_ + i) = omega_[n_0_ + i];
      A(n_s + n_0_ + i, i) = -omega_[n_0_ + i];
    }
    return A;
  }

  /// Real basis X of the state space, two columns for a complex pair; decaying eigenvalues are paired as they come.
  void find_eigenvectors(const MatrixXd &A)
  {
    const GeneralEigenSolver solver(A);
    if (!solver.converged())
      refuse("the eigenvalues of the damped system were not found");
    std::vector<VectorXd> real_vectors;
    Eigen::Index          column = 0;
    X_.resize(A.rows(), A.cols());
    for (Eigen::Index i = 0; i < A.cols(); ++i)
    {
      const std::complex<double> lambda = solver.eigenvalues()[i];
      const Eigen::VectorXcd     vector = solver.eigenvectors().col(i);
      if (lambda.imag() == 0.)
      {
        real_.push_back(lambda.real());
        real_vectors.push_back(vector.real() / vector.real().norm());
      }
      else if (lambda.imag() > 0.)
      {
        // state = Re(vector (x_1 + i x_2))
        X_.col(column++) = vector.real();
        X_.col(column++) = -vector.imag();
        oscillating_.push_back({ModalBlock::oscillating, lambda.real(), lambda.imag()});
      }
    }
    for (const VectorXd &vector : real_vectors)
      X_.col(column++) = vector;
  }

  /// Displacements without stiffness: eta_0 = integral of eta_0' = L Lambda^-1 x + x_zero.
  void find_displacements()
  {
    velocity_ = X_.bottomRows(n_);
    displacement_.resize(n_, X_.cols());
    for (Eigen::Index i = 0; i < n_stiff(); ++i)
      displacement_.row(n_0_ + i) = X_.row(i) / omega_[n_0_ + i];
    for (std::size_t b = 0; b < oscillating_.size(); ++b)
    {
      // columns (c_1, c_2) of eta_0 with (c_1, c_2) Lambda = (v_1, v_2)
      const double s = oscillating_[b].s, w = oscillating_[b].w, square = s * s + w * w;
      for (Eigen::Index i = 0; i < n_0_; ++i)
      {
        const double v_1 = velocity_(i, 2 * b), v_2 = velocity_(i, 2 * b + 1);
        displacement_(i, 2 * b)     = (s * v_1 - w * v_2) / square;
        displacement_(i, 2 * b + 1) = (w * v_1 + s * v_2) / square;
      }
    }
    const auto n_complex = Eigen::Index(2 * oscillating_.size());
    for (std::size_t i = 0; i < real_.size(); ++i)
      for (Eigen::Index j = 0; j < n_0_; ++j)
        displacement_(j, n_complex + Eigen::Index(i)) = velocity_(j, n_complex + Eigen::Index(i)) / real_[i];
  }

  const VectorXd         &omega_;
  Eigen::Index            n_, n_0_ = 0; ///< n_0 without stiffness, first
  MatrixXd                X_, inverse_, velocity_, displacement_;
  std::vector<ModalBlock> oscillating_;
  std::vector<double>     real_; ///< decaying eigenvalues
};

/// All columns, the zero eigenvalues last.
void CoupledModes::add(const MatrixXd &Phi, const MatrixXd &M_Phi, Assembly &to) const
{
  const auto size = X_.cols(), total = size + n_0_;
  MatrixXd   all_eta = MatrixXd::Zero(n_, total), all_rate = MatrixXd::Zero(n_, total);
  all_eta.leftCols(size) = displacement_;
  all_eta.topRightCorner(n_0_, n_0_).setIdentity();
  all_rate.leftCols(size) = velocity_;
  MatrixXd from_eta = MatrixXd::Zero(total, n_), from_rate = MatrixXd::Zero(total, n_);
  for (Eigen::Index i = 0; i < n_stiff(); ++i)
    from_eta.col(n_0_ + i).head(size) = inverse_.col(i) * omega_[n_0_ + i];
  from_rate.topRows(size) = inverse_.rightCols(n_);
  // x_zero = eta_0 - (displacement of the other states)_0
  from_eta.bottomRows(n_0_)  = -displacement_.topRows(n_0_) * from_eta.topRows(size);
  from_rate.bottomRows(n_0_) = -displacement_.topRows(n_0_) * from_rate.topRows(size);
  from_eta.bottomLeftCorner(n_0_, n_0_) += MatrixXd::Identity(n_0_, n_0_);

  std::vector<double> decaying = real_;
  decaying.insert(decaying.end(), std::size_t(n_0_), 0.);
  to.Q.middleCols(to.used, total)      = Phi * all_eta;
  to.V.middleCols(to.used, total)      = Phi * all_rate;
  to.from_q.middleRows(to.used, total) = from_eta * M_Phi.transpose();
  to.from_v.middleRows(to.used, total) = from_rate * M_Phi.transpose();
  to.used += total;
  to.blocks.insert(to.blocks.end(), oscillating_.begin(), oscillating_.end());
  for (std::size_t i = 0; i + 1 < decaying.size(); i += 2)
    to.blocks.push_back({ModalBlock::decaying, decaying[i], decaying[i + 1]});
}

/// Forced motion x_p = Re((i Omega - Lambda)^-1 G F e^(i Omega t)) of one harmonic: columns for cos and sin.
void add_harmonic(const Excitation::Harmonic &harmonic, ModalBlocks &to, Eigen::Index column)
{
  const double omega  = harmonic.omega;
  VectorXd     cosine = VectorXd::Zero(to.G.rows()), sine = cosine;
  for (const Excitation::Entry &entry : harmonic.load)
  {
    cosine += entry.cosine * to.G.col(entry.coordinate);
    sine += entry.sine * to.G.col(entry.coordinate);
  }
  // x = c cos + s sin:  -Omega c = Lambda s + sine,  Omega s = Lambda c + cosine, so (Lambda^2 + Omega^2) c = -Lambda
  // cosine - Omega sine, s = (Lambda c + cosine)/Omega.
  VectorXd c(to.G.rows()), s(to.G.rows());
  for (int b = 0; b < to.n_modal; ++b)
  {
    const ModalBlock &block = to.blocks[b];
    Eigen::Matrix2d   Lambda;
    if (block.kind == ModalBlock::oscillating)
      Lambda << block.s, -block.w, block.w, block.s;
    else if (block.kind == ModalBlock::decaying)
      Lambda << block.s, 0., 0., block.w;
    else
      Lambda << 0., 1., 0., 0.;
    const double distance =
        block.kind == ModalBlock::oscillating ? std::hypot(block.s, std::abs(block.w) - omega) : omega;
    // |i Omega - lambda| / Omega below which the forced motion has no digits left
    constexpr double resonance = 1e-8;
    if (distance < resonance * omega)
    {
      std::ostringstream message;
      message
          << "an undamped mode at " << omega / 6.283185307179586
          << " Hz is excited at its own frequency, so no steady response exists; add damping, or use another method";
      refuse(message.str());
    }
    const Eigen::Matrix2d K   = Lambda * Lambda + omega * omega * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d f_c = cosine.segment<2>(2 * b), f_s = sine.segment<2>(2 * b);
    c.segment<2>(2 * b) = K.fullPivLu().solve(-Lambda * f_c - omega * f_s);
    s.segment<2>(2 * b) = (Lambda * c.segment<2>(2 * b) + f_c) / omega;
  }
  const auto modal     = to.G.rows();
  to.Q.col(column)     = to.Q.leftCols(modal) * c;
  to.Q.col(column + 1) = to.Q.leftCols(modal) * s;
  to.V.col(column)     = omega * to.Q.col(column + 1);
  to.V.col(column + 1) = -omega * to.Q.col(column);
}

bool same_matrix(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

} // namespace

Eigen::VectorXd ModalBlocks::state(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) const
{
  VectorXd   x(2 * Eigen::Index(blocks.size()));
  const auto modal = G.rows();
  turn_harmonics(t, x);
  const VectorXd rest_q = q - Q.rightCols(x.size() - modal) * x.tail(x.size() - modal);
  const VectorXd rest_v = v - V.rightCols(x.size() - modal) * x.tail(x.size() - modal);
  x.head(modal)         = from_q * rest_q + from_v * rest_v;
  return x;
}

void ModalBlocks::turn_harmonics(double t, Eigen::VectorXd &x) const
{
  for (std::size_t j = 0; j < harmonics.size(); ++j)
  {
    x[G.rows() + 2 * Eigen::Index(j)]     = std::cos(harmonics[j] * t);
    x[G.rows() + 2 * Eigen::Index(j) + 1] = std::sin(harmonics[j] * t);
  }
}

ModalBlocks modal_blocks(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C,
                         const std::function<std::string(int)> &coordinate_name)
{
  const auto      n     = M.rows();
  const RealModes modes = real_modes(M, B, C, coordinate_name);
  const MatrixXd  M_Phi = M * modes.Phi, D = modes.Phi.transpose() * B * modes.Phi;

  // Modes whose damping couples them to none are kept real.
  const double     size_of_D = D.cwiseAbs().maxCoeff();
  std::vector<int> alone, coupled;
  constexpr double no_damping = 1e-13; // modal damping against the largest
  for (Eigen::Index i = 0; i < n; ++i)
  {
    double           off         = 0.;
    constexpr double no_coupling = 1e-13; // off-diagonal of the modal damping against its diagonals
    for (Eigen::Index j = 0; j < n; ++j)
      if (j != i)
        off = std::max(off, std::abs(D(i, j)) - no_coupling * std::sqrt(std::abs(D(i, i) * D(j, j))));
    (off <= no_damping * size_of_D ? alone : coupled).push_back(int(i));
  }
  Assembly assembly(n);
  for (const int i : alone)
  {
    const bool none = std::abs(D(i, i)) <= no_damping * size_of_D;
    add_real_mode(modes.Phi.col(i), M_Phi.col(i), modes.omega[i], none ? 0. : D(i, i), assembly);
  }
  if (!coupled.empty())
  {
    const VectorXd omega = modes.omega(coupled);
    CoupledModes(omega, D(coupled, coupled)).add(modes.Phi(Eigen::all, coupled), M_Phi(Eigen::all, coupled), assembly);
  }

  ModalBlocks result;
  result.blocks  = assembly.blocks;
  result.n_modal = int(n);
  result.Q       = assembly.Q;
  result.V       = assembly.V;
  result.from_q  = assembly.from_q;
  result.from_v  = assembly.from_v;
  // G = from_v M^-1
  result.G = M.llt().solve(assembly.from_v.transpose()).transpose();
  return result;
}

const ModalBlocks &SharedModes::of(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                                   const std::function<std::string(int)> &coordinate_name)
{
  if (found_ > 0 && same_matrix(M, M_) && same_matrix(B, B_) && same_matrix(C, C_))
    return blocks_;
  blocks_ = modal_blocks(M, B, C, coordinate_name);
  M_      = M;
  B_      = B;
  C_      = C;
  ++found_;
  return blocks_;
}

ModalBlocks modal_blocks(const SecondOrderSystem &system, SharedModes *shared)
{
  MatrixXd M, B, C;
  if (!system.linear().dense_matrices(M, B, C))
    refuse("it needs all modes of the base system, too many for an unreduced frame; reduce the frame, or use the "
           "method bdf");
  if (system.linear().excitation().has_rest())
    refuse("the load is not a sum of harmonics; use the method bdf");
  if (system.joints().n_rows() > 0)
    refuse("ideal joints are not supported; use compliant ones");
  const auto  name      = [&](int i) { return system.linear().coordinate_name(i); };
  ModalBlocks result    = shared ? shared->of(M, B, C, name) : modal_blocks(M, B, C, name);
  const auto &harmonics = system.linear().excitation().harmonics();
  const auto  n = M.rows(), n_x = 2 * (n + Eigen::Index(harmonics.size()));
  result.Q.conservativeResize(n, n_x);
  result.V.conservativeResize(n, n_x);
  for (std::size_t j = 0; j < harmonics.size(); ++j)
  {
    add_harmonic(harmonics[j], result, 2 * (n + Eigen::Index(j)));
    // cos, sin satisfy x' = [0 -w; w 0] x
    result.blocks.push_back({ModalBlock::oscillating, 0., harmonics[j].omega});
    result.harmonics.push_back(harmonics[j].omega);
  }
  return result;
}

} // namespace gestell::coupling
