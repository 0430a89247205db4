#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::tests
{

/**
 * A page in headless Chromium without GPU, driven over its debugging pipe: file descriptors 3 and 4, messages of JSON
 * ended by a zero byte.  As root it needs --no-sandbox, which is always given: pages are our own.
 */
class Browser
{
public:
  /// Whether this machine has one; its path.
  static std::string program();

  /// Opens a page and waits until it is loaded.  @throws std::runtime_error after half a minute without an answer
  explicit Browser(const std::filesystem::path &page);
  ~Browser();
  Browser(const Browser &)            = delete;
  Browser &operator=(const Browser &) = delete;

  /// Value of an expression of JavaScript, after its promise.  @throws std::runtime_error with what it throws
  nlohmann::json value(const std::string &expression);

  /// Presses the left button at the first place, in pixels of the window, and lets it go at the second.
  void drag(double x0, double y0, double x1, double y1);
  void press_key(const std::string &key);
  void resize(int width, int height); ///< of the page, in pixels

  /// Processor time of the browser and all processes it has started [s].
  double cpu_seconds() const;

  double load_seconds() const { return load_seconds_; }                  ///< from the request to the load event
  double load_cpu_seconds() const { return load_cpu_seconds_; }          ///< what it took of the processors
  const std::vector<std::string> &errors() const { return errors_; }     ///< of the console, and exceptions
  const std::vector<std::string> &requests() const { return requests_; } ///< addresses asked for, but the page's own

private:
  nlohmann::json call(const std::string &method, nlohmann::json parameters = nlohmann::json::object());
  nlohmann::json next_message();
  void           note(const nlohmann::json &event);
  void           mouse(const char *type, double x, double y);

  int                      process_ = -1, to_ = -1, from_ = -1, id_ = 0;
  std::string              session_, buffer_, address_;
  bool                     loaded_       = false;
  double                   load_seconds_ = 0., load_cpu_seconds_ = 0.;
  std::vector<std::string> errors_, requests_;
  std::filesystem::path    profile_;
};

} // namespace gestell::tests
