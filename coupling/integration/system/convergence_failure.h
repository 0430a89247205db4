#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::coupling
{

/// A numerical method failed: where, and by how much.
class ConvergenceFailure : public std::runtime_error
{
public:
  /// @param id     of the kind of failure, as that of a finding; "" where there is no name for it
  /// @param place  element or joint that it is about; "": the machine as a whole
  explicit ConvergenceFailure(const std::string &text, std::string id = "", std::string place = "")
      : std::runtime_error(text), id_(std::move(id)), place_(std::move(place))
  {
  }
  const std::string &id() const { return id_; }
  const std::string &place() const { return place_; }

private:
  std::string id_, place_;
};

} // namespace gestell::coupling
