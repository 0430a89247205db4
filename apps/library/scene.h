#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#define GESTELL_SHOWN __attribute__((visibility("default")))

namespace gestell
{

/// Extremes of a signal with their times [s].
struct Peak
{
  std::string unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

/// A law changes its branch: time [s], name of the element, what happens.
struct Event
{
  double      t = 0.;
  std::string name, kind;
};

/// What a run tells.  Copies share it.
class GESTELL_SHOWN Run
{
public:
  const std::map<std::string, Peak> &peaks() const;
  const std::vector<Event>          &events() const;
  const std::vector<std::string>    &warnings() const;
  /// Why the run stopped early; empty: it did not.  What was computed until then is there.
  const std::string &failure() const;

  const std::vector<double> &times() const; ///< [s] of the history
  /// History of a signal in SI, one value a time.
  /// @throws std::invalid_argument for a name that is none, with the nearest one
  std::vector<double> history(const std::string &signal) const;

  /// Writes report.html, history.csv and all other files of a result.
  /// @throws std::invalid_argument, std::runtime_error if they cannot be written
  void save(const std::string &folder) const;

  struct Parts;
  explicit Run(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

private:
  std::shared_ptr<const Parts> parts_;
};

/// Natural modes of the coupled machine.
struct Modes
{
  std::vector<double>              frequencies_hz, damping_ratios;
  std::vector<std::string>         coordinates;
  std::vector<std::vector<double>> shapes; ///< by mode, then by coordinate; mass normalised
};

/**
 * A scene as data: entries are set by their path, then computed.  Frames are reduced once and kept in the cache.
 *
 *     gestell::Scene scene("press_minimal.toml");
 *     scene.set("parameters.c_P", "950 kN/mm");
 *     const gestell::Run run = scene.run();
 *
 * Wrong input throws std::invalid_argument with place, value and way out; what cannot be computed std::runtime_error.
 */
class GESTELL_SHOWN Scene
{
public:
  explicit Scene(const std::string &file);
  /// A scene of a TOML text.
  /// @param folder  relative paths start here
  static Scene of_text(const std::string &text, const std::string &folder = ".");

  /// The value as in `--set`: a number in SI, or text with its unit.
  Scene &set(const std::string &key, const std::string &value);
  Scene &set(const std::string &key, double value);

  Run   run() const;
  Modes modes() const;

  struct Parts;

private:
  explicit Scene(std::shared_ptr<Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_; ///< replaced by set(), so that copies stay as they are
};

} // namespace gestell
