// How fast a report opens and plays in a browser without graphics: gestell_page_bench REPORT.html

#include "tests/apps/pages/page_measures.h"

#include <iostream>

using gestell::tests::Browser;

namespace
{

constexpr double played_s = 4.;

/// Pictures in played_s of playing, the first second left out, in which the view finds its pace, and the seconds they took.
nlohmann::json pictures(Browser &page)
{
  page.value("new Promise(done => { document.querySelector('.machine').scrollIntoView();"
             " gestell.machine.set_playing(true); setTimeout(done, 1000); })");
  return page.value("new Promise(done => { const first = gestell.machine.frames, begin = performance.now();"
                    "  setTimeout(() => done([gestell.machine.frames - first, (performance.now() - begin) / 1000]), " +
                    std::to_string(1000. * played_s) + "); })");
}

} // namespace

int main(int argc, char **argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: gestell_page_bench REPORT.html\n";
    return 1;
  }
  Browser      page(argv[1]);
  const double seen = gestell::tests::seconds_to_the_machine(page), before = page.cpu_seconds();
  const auto   played = pictures(page);
  const double count = played[0].get<double>(), took = page.cpu_seconds() - before;
  std::cout << "opened in " << page.load_seconds() << " s with " << page.load_cpu_seconds()
            << " s of processors, machine seen after " << seen << " s, " << count / played[1].get<double>()
            << " pictures a second, " << took / count << " s of processors each\n";
}
