#pragma once

#include <iosfwd>
#include <memory>
#include <sstream>
#include <string>

namespace gestell::apps
{

/**
 * With `--json`: one JSON document on standard output instead of the printed text (docs/reference/json.md).
 *
 * During its lifetime output to std::cout is captured, and warnings to std::cerr are recorded.  A command with a
 * structured answer passes it to answer_with(); the captured text is always in the document, so that this is optional.
 */
class JsonAnswer
{
public:
  explicit JsonAnswer(bool wanted); ///< false: no effect
  ~JsonAnswer();
  JsonAnswer(const JsonAnswer &)            = delete;
  JsonAnswer &operator=(const JsonAnswer &) = delete;

  bool wanted() const { return wanted_; }
  /// Reason why there is no answer, as printed in the terminal.
  void failed(const std::string &message) { failure_ = message; }
  /// Writes only the document.
  void finish(const std::string &command, int exit_code);

private:
  class Listener;

  bool                      wanted_;
  std::ostringstream        text_;
  std::streambuf           *cout_ = nullptr;
  std::unique_ptr<Listener> cerr_;
  std::string               failure_;
};

/// Answer of a command as JSON text, computed only on request; the last one is used.
bool answers_in_json();
void answer_with(const std::string &json);
/// Reason for an early end of an answer, as printed in the terminal.
void error_in_json(const std::string &message);

} // namespace gestell::apps
