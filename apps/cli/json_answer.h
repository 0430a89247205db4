#pragma once

#include <iosfwd>
#include <memory>
#include <sstream>
#include <string>

namespace gestell::apps
{

/**
 * One JSON document on standard output in place of what a command prints, with `--json` (docs/json.md).
 *
 * While it lives, what is written to std::cout is kept, and warnings that pass std::cerr are noted.  A command that
 * has its answer as a value gives it to answer_with(); lines of text are in the document in any case, so that no
 * command needs more.
 */
class JsonAnswer
{
public:
  explicit JsonAnswer(bool wanted); ///< false: nothing is changed
  ~JsonAnswer();
  JsonAnswer(const JsonAnswer &)            = delete;
  JsonAnswer &operator=(const JsonAnswer &) = delete;

  bool wanted() const { return wanted_; }
  /// Why there is no answer, as printed in the terminal.
  void failed(const std::string &message) { failure_ = message; }
  /// Writes the document, and nothing more.
  void finish(const std::string &command, int exit_code);

private:
  class Listener;

  bool                      wanted_;
  std::ostringstream        text_;
  std::streambuf           *cout_ = nullptr;
  std::unique_ptr<Listener> cerr_;
  std::string               failure_;
};

/// What a command answers, as JSON text, made only on request; the last one is used.
bool answers_in_json();
void answer_with(const std::string &json);
/// Why an answer ends early, as printed in the terminal.
void error_in_json(const std::string &message);

} // namespace gestell::apps
