#include "apps/fmu/fmu_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr char state_head[] = "gestell fmu state 2\n";

void put(const double *values, std::size_t n, std::string &bytes)
{
  const std::uint64_t size = n;
  bytes.append(reinterpret_cast<const char *>(&size), sizeof size);
  bytes.append(reinterpret_cast<const char *>(values), n * sizeof(double));
}

void put(const std::string &text, std::string &bytes)
{
  const std::uint64_t size = text.size();
  bytes.append(reinterpret_cast<const char *>(&size), sizeof size);
  bytes += text;
}

/// Takes back what put() wrote.
class StateReader
{
public:
  explicit StateReader(const std::string &bytes) : bytes_(bytes), at_(sizeof state_head - 1) {}

  std::vector<double> numbers()
  {
    std::vector<double> values(size_of(sizeof(double)));
    take(values.data(), values.size() * sizeof(double));
    return values;
  }

  std::vector<double> finite_numbers()
  {
    const std::vector<double> values = numbers();
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
      throw std::invalid_argument("the state contains numbers that are not finite; its bytes are damaged");
    return values;
  }

  std::string text()
  {
    std::string text(size_of(1), '\0');
    take(text.data(), text.size());
    return text;
  }

  bool at_end() const { return at_ == bytes_.size(); }

  [[noreturn]] static void fail()
  {
    throw std::invalid_argument("these bytes are not a state of an FMU of Gestell, or only a part of one");
  }

private:
  /// Number of following items, each of `item` bytes.
  std::size_t size_of(std::size_t item)
  {
    std::uint64_t size = 0;
    take(&size, sizeof size);
    if (size > (bytes_.size() - at_) / item)
      fail();
    return size;
  }

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
  put(guid, bytes);
  for (const auto *values : {&parameters, &inputs, &rates, &since})
    put(values->data(), values->size(), bytes);
  if (!motion)
    return bytes;
  put(&motion->t, 1, bytes);
  for (const Eigen::VectorXd *values : {&motion->q, &motion->v, &motion->history})
    put(values->data(), std::size_t(values->size()), bytes);
  put(motion->ended, bytes);
  return bytes;
}

FmuState FmuState::of_bytes(const std::string &bytes)
{
  if (bytes.compare(0, sizeof state_head - 1, state_head) != 0)
    StateReader::fail();
  StateReader reader(bytes);
  FmuState    state;
  state.guid = reader.text();
  for (auto *values : {&state.parameters, &state.inputs, &state.rates, &state.since})
    *values = reader.finite_numbers();
  if (reader.at_end())
    return state;
  const auto             t = reader.finite_numbers();
  coupling::SteppedState motion;
  motion.t = t.size() == 1 ? t[0] : (StateReader::fail(), 0.);
  for (Eigen::VectorXd *values : {&motion.q, &motion.v})
    *values = vector_of(reader.finite_numbers());
  motion.history = vector_of(reader.numbers()); // NaN: has not yet happened
  motion.ended   = reader.text();
  if (!reader.at_end())
    StateReader::fail();
  state.motion = motion;
  return state;
}

} // namespace gestell::apps
