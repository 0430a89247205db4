#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Writes one JSON value (RFC 8259), indented, members in the order they are given.
 *
 * Numbers are the shortest text that reads back exactly; nan and infinities, which JSON lacks, become null.  Text is
 * UTF-8; bytes that are not are replaced by U+FFFD.  Inside an object every call names its member, inside an array
 * the name is empty.
 */
class JsonWriter
{
public:
  void begin_object(const std::string &name = "") { open(name, '{'); }
  void end_object() { close('}'); }
  void begin_array(const std::string &name = "") { open(name, '['); }
  void end_array() { close(']'); }

  void number(const std::string &name, double x);
  void integer(const std::string &name, long long x);
  void text(const std::string &name, const std::string &x);
  void boolean(const std::string &name, bool x);
  void null(const std::string &name);

  /// The whole document; valid once every begin has met its end.
  const std::string &document() const { return document_; }

private:
  void open(const std::string &name, char bracket);
  void close(char bracket);
  void start_member(const std::string &name);

  std::string       document_;
  std::vector<bool> has_members_; // one per open bracket
};

/// x as a JSON string with its quotes.
std::string json_quoted(const std::string &x);

} // namespace gestell::apps
