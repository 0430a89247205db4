#include "coupling/integration/system/error_scale.h"
#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

void ErrorScale::exchange(StateArchive &archive)
{
  const auto excursions = [&](Excursions &of) { archive(of.q, of.v, of.u, of.u_rate, of.end_q, of.end_v); };
  for (Virtual &coordinate : virtual_)
    archive(coordinate.by_u, coordinate.by_rate);
  archive(q_begin_, v_begin_, u_begin_, rate_begin_, t_, expected_until_, loads_way_, loads_speed_);
  for (Excursions *of : {&accepted_, &reached_, &expected_, &scale_})
    excursions(*of);
  archive(way_, speed_, size_, rate_, inverse_q_, inverse_v_, inverse_u_, inverse_rate_);
  archive(noise_, joint_noise_, noise_of_groups_);
}

} // namespace gestell::coupling
