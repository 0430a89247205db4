#pragma once

#include "tests/support/browser.h"

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

/// Where element `selector` stands in the window after it is scrolled to: x, y, width, height.
inline std::vector<double> place_of(Browser &page, const std::string &selector)
{
  return page.value("(() => { const e = document.querySelector(" + nlohmann::json(selector).dump() +
                    "); e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect();"
                    " return [r.x, r.y, r.width, r.height]; })()");
}

} // namespace gestell::tests
