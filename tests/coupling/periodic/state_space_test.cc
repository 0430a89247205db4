// x' = A x + B u, y = C x + D u against the frequency response of the same machine.

#include "coupling/periodic/response/state_space.h"
#include "tests/support/linear_machine.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// One quantity of each kind, and all of them together.
std::vector<LinearAnswer> answers_of(const LinearMachine &machine)
{
  const Eigen::Index        n = machine.M.rows(), n_u = machine.W.cols(), n_c = machine.G.rows();
  std::vector<LinearAnswer> answers(4);
  answers[0].q = VectorXd::LinSpaced(n, 1., 2.);
  answers[1].v = VectorXd::LinSpaced(n, -1., 1.);
  answers[2].a = VectorXd::LinSpaced(n, 3., 1.);
  answers[3].p = VectorXd::LinSpaced(n_u, 1., -2.);
  answers.push_back({answers[0].q, answers[1].v, answers[2].a, answers[3].p, VectorXd::LinSpaced(n_c, 1., 2.)});
  return answers;
}

/// C (i w E - A)^-1 B + D is what the whole equations answer, for elements with stiffness, dampers and masses.
void expect_response(const LinearMachine &machine)
{
  const LinearResponse            response = response_of(machine);
  const Eigen::MatrixXd           F        = Eigen::MatrixXd::Identity(machine.M.rows(), 3);
  const std::vector<LinearAnswer> answers  = answers_of(machine);
  const StateSpace                system   = state_space(response, F, answers);
  for (const double omega : {7., 31., 104., 4100.})
  {
    const Vibration x  = response.at(omega, F);
    const MatrixXcd iw = Complex(0., omega) * MatrixXcd::Identity(system.A.rows(), system.A.cols());
    const MatrixXcd H =
        system.C * (iw - system.A).partialPivLu().solve(MatrixXcd(system.B.cast<Complex>())) + system.D.cast<Complex>();
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      double size = 0., off = 0.; // rounding of A^-1 by entries from 1 to 1e6
      for (Eigen::Index column = 0; column < F.cols(); ++column)
      {
        const Complex expected = answers[i].of(x, column);
        size                   = std::max(size, std::abs(expected));
        off                    = std::max(off, std::abs(H(Eigen::Index(i), column) - expected));
      }
      EXPECT_LT(off, 1e-7 * size) << "answer " << i << " at " << omega;
    }
  }
}

TEST(StateSpace, HasTheFrequencyResponseOfItsMachine)
{
  for (const unsigned seed : {1u, 2u})
    expect_response(random_machine(seed));
}

TEST(StateSpace, HasTheFrequencyResponseOfAMachineInJoints)
{
  std::mt19937  dice(6);
  LinearMachine machine = random_machine(6);
  machine.G             = random_matrix(2, 4, dice);
  machine.finish();
  expect_response(machine);
}

} // namespace
} // namespace gestell::tests
