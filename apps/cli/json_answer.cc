#include "apps/cli/json_answer.h"

#include "apps/output/text/json.h"

#include <iostream>
#include <regex>
#include <streambuf>
#include <vector>

namespace gestell::apps
{

namespace
{

bool        wanted_by_anyone = false;
std::string given, early_end;

const std::string warning_begins = "gestell: warning: ";

std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  std::istringstream       in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

/// A long message without its middle: std::regex takes some of the stack for each letter, and whoever gives an option
/// of a megabyte reads it in the message.
std::string judged_part(const std::string &message)
{
  constexpr std::size_t end = 1000; // letters: std::regex takes some of the stack for each
  return message.size() <= 2 * end ? message : message.substr(0, end) + " ... " + message.substr(message.size() - end);
}

/// Splits "scene.toml:12: body.crank.mass: needs a mass above zero, got 0; give ..." into its parts, if they exist.
Json parts_of_error(const std::string &message, int exit_code)
{
  static const std::regex place(R"(^(?:--[^ ]+ [^:]*: )?([^:\n]+):([0-9]+): )"),
      key(R"(^([A-Za-z_][\w\-]*(?:\.[\w."\- ]*)?): )"), value(R"(, got ([^;(\n]+))"),
      needed(R"(\b(?:needs|must be|valid:) ([^;\n]+?)(?=, got |;|\n|$))"), way_out(R"(; ([^;]+)$)");
  Json        error = {{"exit_code", exit_code}, {"message", message}};
  std::smatch found;
  std::string rest = judged_part(message);
  if (std::regex_search(rest, found, place))
  {
    error["place"] = {{"file", found[1].str()}, {"line", std::stoi(found[2].str().substr(0, 9))}};
    rest           = found.suffix();
  }
  if (std::regex_search(rest, found, key))
  {
    error["key"] = found[1].str();
    rest         = found.suffix();
  }
  for (const auto &[name, pattern] :
       {std::pair("value", &value), std::pair("needed", &needed), std::pair("way_out", &way_out)})
    if (std::regex_search(rest, found, *pattern))
      error[name] = found[1].str();
  return error;
}

} // namespace

/// Passes on what is written to standard error, and keeps it.
class JsonAnswer::Listener : public std::streambuf
{
public:
  explicit Listener(std::ostream &stream) : stream_(stream), to_(stream.rdbuf(this)) {}
  ~Listener() override { stream_.rdbuf(to_); }

  std::vector<std::string> warnings() const
  {
    std::vector<std::string> found;
    for (const std::string &line : lines_of(heard_))
      if (line.compare(0, warning_begins.size(), warning_begins) == 0)
        found.push_back(line.substr(warning_begins.size()));
    return found;
  }

protected:
  int overflow(int c) override
  {
    if (c == traits_type::eof())
      return traits_type::not_eof(c);
    heard_ += traits_type::to_char_type(c);
    return to_->sputc(traits_type::to_char_type(c));
  }
  std::streamsize xsputn(const char *text, std::streamsize n) override
  {
    heard_.append(text, std::size_t(n));
    return to_->sputn(text, n);
  }
  int sync() override { return to_->pubsync(); }

private:
  std::ostream   &stream_;
  std::streambuf *to_;
  std::string     heard_;
};

JsonAnswer::JsonAnswer(bool wanted) : wanted_(wanted)
{
  wanted_by_anyone = wanted;
  given.clear();
  early_end.clear();
  if (!wanted_)
    return;
  cout_ = std::cout.rdbuf(text_.rdbuf());
  cerr_ = std::make_unique<Listener>(std::cerr);
}

JsonAnswer::~JsonAnswer()
{
  if (cout_)
    std::cout.rdbuf(cout_);
}

void JsonAnswer::finish(const std::string &command, int exit_code)
{
  if (!wanted_)
    return;
  std::cout.rdbuf(cout_);
  cout_         = nullptr;
  Json document = {{"command", command}, {"exit_code", exit_code}};
  if (const std::string &message = failure_.empty() ? early_end : failure_; !message.empty())
    document["error"] = parts_of_error(message, exit_code);
  document["answer"]   = given.empty() ? Json() : Json::parse(given);
  document["warnings"] = cerr_->warnings();
  document["text"]     = lines_of(text_.str());
  cerr_.reset();
  std::cout << json_text(document) << std::flush;
}

bool answers_in_json()
{
  return wanted_by_anyone;
}

void answer_with(const std::string &json)
{
  given = json;
}

void error_in_json(const std::string &message)
{
  early_end = message;
}

} // namespace gestell::apps
