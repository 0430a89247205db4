#include "coupling/equilibrium/small_motions.h"

#include "coupling/algebra/circulatory_modes.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/machine/configuration/local_stiffness.h"
#include "fem/values/two_pi.h"

#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

SmallMotions small_motions(StaticBalance &balance, const MatrixXd &C)
{
  const Machine    &machine = balance.machine();
  const LocalState &local   = balance.local();
  SmallMotions      motions;
  motions.circulatory = is_circulatory(machine, local, VectorXd::Ones(local.u.size()));
  motions.Z           = free_motions(machine, local, machine.linear().virtual_coordinates());
  motions.K           = motions.Z.transpose() * C * motions.Z;
  if (!motions.circulatory)
    motions.K = 0.5 * (motions.K + motions.K.transpose()).eval();
  return motions;
}

std::string Growth::text(const Machine &machine) const
{
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  std::ostringstream text;
  text << std::setprecision(3) << "the motion of " << machine.coordinate_name(int(most)) << " grows by exp(" << rate
       << " t/s)";
  if (hz > 0.)
    text << " while vibrating at " << hz << " Hz";
  return text.str();
}

Growth fastest_growth(const SmallMotions &motions, const MatrixXd &M)
{
  const auto &[Z, K, circulatory] = motions;
  Growth growth;
  if (Z.cols() == 0)
    return growth;
  try
  {
    const MatrixXd   own     = Z.transpose() * M * Z;
    const DenseModes modes   = circulatory ? circulatory_modes(K, own).modes : dense_modes(K, own);
    Eigen::Index     fastest = -1;
    for (Eigen::Index j = 0; j < modes.growth.size(); ++j)
    {
      const bool falls = modes.omega[j] == 0., others = fastest >= 0 && modes.omega[fastest] == 0.;
      if (modes.growth[j] > 0. &&
          (fastest < 0 || (falls && !others) || (falls == others && modes.growth[j] > modes.growth[fastest])))
        fastest = j;
    }
    if (fastest >= 0)
      growth = {modes.growth[fastest], modes.omega[fastest] / two_pi, Z * modes.V.col(fastest)};
  }
  catch (const std::invalid_argument &)
  {
    // neither mass nor stiffness: the motion does not grow
  }
  return growth;
}

} // namespace gestell::coupling
