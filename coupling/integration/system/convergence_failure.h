#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gestell::coupling
{

/// Failure of a numerical method, with location and residual.
class ConvergenceFailure : public std::runtime_error
{
public:
  /// @param id     kind of the failure, as for a finding; "" if it has no name
  /// @param place  element or joint concerned; "": the whole machine
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
