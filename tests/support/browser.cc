#include "tests/support/browser.h"

#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace gestell::tests
{

using Json = nlohmann::json;

namespace
{

constexpr int patience_ms = 30000;

double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// In the child: the pipes' ends as 3 and 4, all else silent; does not return.
[[noreturn]] void become_browser(int in, int out, const std::string &profile)
{
  const int saved_in = fcntl(in, F_DUPFD, 10), saved_out = fcntl(out, F_DUPFD, 10), silence = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2})
    dup2(silence, stream);
  dup2(saved_in, 3);
  dup2(saved_out, 4);
  for (int i = 5; i < 64; ++i)
    close(i);
  const std::string program = Browser::program(), folder = "--user-data-dir=" + profile;
  execl(program.c_str(), program.c_str(), "--headless=new", "--no-sandbox", "--disable-gpu",
        "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking",
        "--remote-debugging-pipe", "--window-size=1200,900", folder.c_str(), "about:blank",
        static_cast<char *>(nullptr));
  _exit(127);
}

} // namespace

std::string Browser::program()
{
  for (const char *path : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"})
    if (access(path, X_OK) == 0)
      return path;
  return "";
}

Browser::Browser(const std::filesystem::path &page)
    : address_("file://" + page.string()),
      profile_(std::filesystem::temp_directory_path() / ("gestell_browser_" + std::to_string(getpid())))
{
  std::array<int, 2> down{}, up{};
  if (pipe(down.data()) != 0 || pipe(up.data()) != 0)
    throw std::runtime_error("no pipe to the browser");
  process_ = fork();
  if (process_ == 0)
  {
    setpgid(0, 0);
    become_browser(down[0], up[1], profile_.string());
  }
  close(down[0]);
  close(up[1]);
  to_ = down[1], from_ = up[0];
  std::signal(SIGPIPE, SIG_IGN);

  const Json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_          = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
  for (const char *domain : {"Runtime.enable", "Log.enable", "Page.enable", "Network.enable"})
    call(domain);
  const double requested = now(), cpu = cpu_seconds();
  call("Page.navigate", {{"url", address_}});
  while (!loaded_)
    note(next_message());
  load_seconds_     = now() - requested;
  load_cpu_seconds_ = cpu_seconds() - cpu;
}

Browser::~Browser()
{
  close(to_);
  close(from_);
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove_all(profile_, ignored);
}

Json Browser::next_message()
{
  for (std::size_t end = buffer_.find('\0'); end == std::string::npos; end = buffer_.find('\0'))
  {
    pollfd wait{from_, POLLIN, 0};
    if (poll(&wait, 1, patience_ms) <= 0)
      throw std::runtime_error("the browser does not answer");
    std::array<char, 65536> bytes;
    const auto              n = read(from_, bytes.data(), bytes.size());
    if (n <= 0)
      throw std::runtime_error("the browser has ended");
    buffer_.append(bytes.data(), static_cast<std::size_t>(n));
  }
  const std::size_t end     = buffer_.find('\0');
  const Json        message = Json::parse(buffer_.substr(0, end));
  buffer_.erase(0, end + 1);
  return message;
}

void Browser::note(const Json &event)
{
  const std::string method = event.value("method", "");
  if (method == "Page.loadEventFired")
    loaded_ = true;
  else if (method == "Runtime.exceptionThrown")
    errors_.push_back(event["params"]["exceptionDetails"].dump());
  else if (method == "Runtime.consoleAPICalled" && event["params"]["type"] == "error")
    errors_.push_back(event["params"]["args"].dump());
  else if (method == "Log.entryAdded" && event["params"]["entry"]["level"] == "error")
    errors_.push_back(event["params"]["entry"]["text"]);
  else if (method == "Network.requestWillBeSent")
    if (const std::string url = event["params"]["request"]["url"]; url != address_)
      requests_.push_back(url);
}

Json Browser::call(const std::string &method, Json parameters)
{
  Json message = {{"id", ++id_}, {"method", method}, {"params", std::move(parameters)}};
  if (!session_.empty())
    message["sessionId"] = session_;
  const std::string text = message.dump() + '\0';
  if (write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    throw std::runtime_error("the browser takes no orders");
  for (;;)
  {
    const Json answer = next_message();
    if (answer.value("id", 0) != id_)
    {
      note(answer);
      continue;
    }
    if (answer.contains("error"))
      throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer["result"];
  }
}

Json Browser::value(const std::string &expression)
{
  const Json result =
      call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (result.contains("exceptionDetails"))
    throw std::runtime_error(result["exceptionDetails"].dump());
  return result["result"].value("value", Json());
}

double Browser::cpu_seconds() const
{
  std::map<int, std::pair<int, double>> processes; // number: its parent, its time
  for (const auto &entry : std::filesystem::directory_iterator("/proc"))
  {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos)
      continue;
    std::ifstream file(entry.path() / "stat");
    std::string   text;
    if (!std::getline(file, text) || text.find(')') == std::string::npos)
      continue; // it has ended meanwhile
    std::istringstream     fields(text.substr(text.rfind(')') + 1));
    std::string            field;
    std::array<double, 14> number{};
    fields >> field; // state, then from the parent on: proc(5)
    for (std::size_t i = 0; i < 12 && fields >> number[i];)
      ++i;
    processes[std::stoi(name)] = {static_cast<int>(number[0]),
                                  (number[10] + number[11]) / static_cast<double>(sysconf(_SC_CLK_TCK))};
  }
  double sum = 0.;
  for (const auto &[id, of] : processes)
  {
    int ancestor = id;
    while (ancestor > 1 && ancestor != process_)
      ancestor = processes.count(ancestor) ? processes[ancestor].first : 0;
    sum += ancestor == process_ ? of.second : 0.;
  }
  return sum;
}

void Browser::mouse(const char *type, double x, double y)
{
  call("Input.dispatchMouseEvent",
       {{"type", type}, {"x", x}, {"y", y}, {"button", "left"}, {"buttons", 1}, {"clickCount", 1}});
}

void Browser::drag(double x0, double y0, double x1, double y1)
{
  mouse("mousePressed", x0, y0);
  for (const double share : {0.25, 0.5, 0.75, 1.})
    mouse("mouseMoved", x0 + share * (x1 - x0), y0 + share * (y1 - y0));
  mouse("mouseReleased", x1, y1);
}

void Browser::resize(int width, int height)
{
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::press_key(const std::string &key)
{
  call("Input.dispatchKeyEvent", {{"type", "keyDown"}, {"key", key}, {"text", key.size() == 1 ? key : ""}});
  call("Input.dispatchKeyEvent", {{"type", "keyUp"}, {"key", key}});
}

} // namespace gestell::tests
