#include "fem/process/child_messages.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace gestell::fem
{

void MessageWriter::write(const void *bytes, std::size_t n)
{
  for (const char *from = static_cast<const char *>(bytes); n > 0;)
  {
    const ssize_t written = ::write(pipe_, from, n);
    if (written < 0 && errno != EINTR)
      ::_exit(1); // the reader is gone
    if (written > 0)
    {
      from += written;
      n -= static_cast<std::size_t>(written);
    }
  }
}

void MessageWriter::send(ChildMessage kind, const std::string &text)
{
  MessageHead head = {};
  head.kind        = kind;
  head.length      = text.size();
  write(&head, sizeof head);
  write(text.data(), text.size());
}

void MessageWriter::send_progress(const std::string &phase, double share)
{
  send(ChildMessage::progress, std::string(reinterpret_cast<const char *>(&share), sizeof share) + phase);
}

std::pair<double, std::string> progress_in(const std::string &text)
{
  double share = -1.;
  if (text.size() < sizeof share)
    return {share, ""};
  std::memcpy(&share, text.data(), sizeof share);
  return {share, text.substr(sizeof share)};
}

bool MessageReader::read_some(int pipe)
{
  constexpr std::size_t once = 1 << 16; // bytes: the capacity of a pipe in Linux
  if (at_ > 0 && at_ == bytes_.size())
  {
    bytes_.clear();
    at_ = 0;
  }
  const std::size_t before = bytes_.size();
  bytes_.resize(before + once);
  const ssize_t n     = ::read(pipe, bytes_.data() + before, once);
  const int     error = errno;
  bytes_.resize(before + (n > 0 ? static_cast<std::size_t>(n) : 0));
  return n > 0 || (n < 0 && error == EINTR);
}

std::optional<TextMessage> MessageReader::next()
{
  MessageHead head;
  if (bytes_.size() - at_ < sizeof head)
    return std::nullopt;
  std::memcpy(&head, bytes_.data() + at_, sizeof head);
  if (bytes_.size() - at_ - sizeof head < head.length)
    return std::nullopt;
  TextMessage message{head.kind, bytes_.substr(at_ + sizeof head, head.length)};
  at_ += sizeof head + head.length;
  return message;
}

} // namespace gestell::fem
