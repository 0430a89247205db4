#pragma once

#include "tests/support/browser.h"
#include "tests/support/test.h"

/// A browser is a dependency of the tests: without one they fail and say what to install.
#define GESTELL_NEEDS_BROWSER()                                                                                        \
  ASSERT_FALSE(gestell::tests::Browser::program().empty()) << "no Chromium: install Debian's package chromium"

namespace gestell::tests
{

inline std::string texts(const std::vector<std::string> &lines)
{
  std::string all;
  for (const std::string &line : lines)
    all += line + "\n";
  return all;
}

/// Seconds from the start of the navigation to the first picture of the machine.
inline double seconds_to_the_machine(Browser &page)
{
  return page.value("new Promise(done => { const look = () => gestell.machine && gestell.machine.frames > 0"
                    " ? done(performance.now() / 1000) : setTimeout(look, 10); look(); })");
}

/// How fast the view plays.
struct Pace
{
  double pictures_per_second = 0., cpu_per_picture = 0.; ///< processor time of all of the browser [s]
};

/// Over so many seconds of playing; the first one, in which the view finds its pace, is left out.
inline Pace pace(Browser &page, int seconds)
{
  page.value("new Promise(done => { document.querySelector('.machine').scrollIntoView();"
             " gestell.machine.set_playing(true); setTimeout(done, 1000); })");
  const double before = page.cpu_seconds();
  const auto   played = page.value(
        "new Promise(done => { const first = gestell.machine.frames, begin = performance.now();"
          "  setTimeout(() => done([gestell.machine.frames - first, (performance.now() - begin) / 1000]), 1000 * " +
        std::to_string(seconds) + "); })");
  const double pictures = played[0].get<double>();
  Pace         found{pictures / played[1].get<double>(), (page.cpu_seconds() - before) / pictures};
  page.value("gestell.machine.set_playing(false)");
  return found;
}

/// Where element `selector` stands in the window after it is scrolled to: x, y, width, height.
inline std::vector<double> place_of(Browser &page, const std::string &selector)
{
  return page.value("(() => { const e = document.querySelector(" + nlohmann::json(selector).dump() +
                    "); e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect();"
                    " return [r.x, r.y, r.width, r.height]; })()");
}

} // namespace gestell::tests
