#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace gestell::fem
{

enum class ChildMessage : int
{
  progress,
  out_of_memory, ///< an allocation failed, regardless of the consequences
  result,
  invalid_argument,
  bad_alloc,
  runtime_error
};

/// Precedes the text of each message.
struct MessageHead
{
  ChildMessage kind;
  std::size_t  length; ///< of the text
};

struct TextMessage
{
  ChildMessage kind;
  std::string  text;
};

/// Writes into a pipe.
class MessageWriter
{
public:
  explicit MessageWriter(int pipe) : pipe_(pipe) {}

  void send(ChildMessage kind, const std::string &text);
  void send_progress(const std::string &phase, double share);

private:
  void write(const void *bytes, std::size_t n);

  int pipe_;
};

/// Share and phase from the text of a progress message.
std::pair<double, std::string> progress_in(const std::string &text);

/// Reads from a pipe.
class MessageReader
{
public:
  /// Reads the available bytes; false at the end.
  bool read_some(int pipe);

  /// The next complete message, if there is one.
  std::optional<TextMessage> next();

private:
  std::string bytes_;
  std::size_t at_ = 0;
};

} // namespace gestell::fem
