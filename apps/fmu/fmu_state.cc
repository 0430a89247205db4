#include "apps/fmu/fmu_model.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr char state_head[] = "gestell fmu state 1\n";

void put(const double *values, std::size_t n, std::string &bytes)
{
  const std::uint64_t size = n;
  bytes.append(reinterpret_cast<const char *>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char *>(values), n * sizeof(double));
}

/// Takes back what put() wrote.
class StateReader
{
public:
  explicit StateReader(const std::string &bytes) : bytes_(bytes), at_(sizeof state_head - 1) {}

  std::vector<double> numbers()
  {
    std::uint64_t size = 0;
    take(&size, sizeof size);
    if (size > (bytes_.size() - at_) / sizeof(double))
      fail();
    std::vector<double> values(size);
    take(values.data(), size * sizeof(double));
    return values;
  }

  bool at_end() const { return at_ == bytes_.size(); }

  [[noreturn]] static void fail()
  {
    throw std::invalid_argument("these bytes are no state of an FMU of Gestell, or only a part of one");
  }

private:
  void take(void *to, std::size_t n)
  {
    if (n > bytes_.size() - at_)
      fail();
    if (n > 0)
      std::memcpy(to, bytes_.data() + at_, n);
    at_ += n;
  }

  const std::string &bytes_;
  std::size_t        at_;
};

Eigen::VectorXd vector_of(const std::vector<double> &values)
{
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

} // namespace

std::string FmuState::bytes() const
{
  std::string bytes = state_head;
  for (const auto *values : {&parameters, &inputs, &rates, &since})
    put(values->data(), values->size(), bytes);
  if (!motion)
    return bytes;
  put(&motion->t, 1, bytes);
  for (const Eigen::VectorXd *values : {&motion->q, &motion->v, &motion->history})
    put(values->data(), std::size_t(values->size()), bytes);
  return bytes;
}

FmuState FmuState::of_bytes(const std::string &bytes)
{
  if (bytes.compare(0, sizeof state_head - 1, state_head) != 0)
    StateReader::fail();
  StateReader reader(bytes);
  FmuState    state;
  for (auto *values : {&state.parameters, &state.inputs, &state.rates, &state.since})
    *values = reader.numbers();
  if (reader.at_end())
    return state;
  const auto            t = reader.numbers();
  coupling::MotionState motion;
  motion.t = t.size() == 1 ? t[0] : (StateReader::fail(), 0.);
  for (Eigen::VectorXd *values : {&motion.q, &motion.v, &motion.history})
    *values = vector_of(reader.numbers());
  if (!reader.at_end())
    StateReader::fail();
  state.motion = motion;
  return state;
}

} // namespace gestell::apps
