// What clang's libFuzzer calls: gestell_fuzz --target=NAME CORPUS -runs=2000000 ...

#include "tests/fuzz/target.h"

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>

namespace
{

const gestell::fuzz::Target *fed = nullptr;

} // namespace

extern "C" __attribute__((visibility("default"))) int LLVMFuzzerInitialize(int *count, char ***arguments)
{
  const std::string option = "--target=";
  for (int i = 1; i < *count; ++i)
    if (const std::string argument = (*arguments)[i]; argument.rfind(option, 0) == 0)
      fed = &gestell::fuzz::target(argument.substr(option.size()));
    else if (argument == "--targets")
    {
      for (const auto &target : gestell::fuzz::targets())
        std::cout << target.name << '\n';
      std::cout.flush();
      std::_Exit(0);
    }
  if (!fed)
  {
    std::cerr << "gestell_fuzz --target=NAME; --targets lists them\n";
    std::_Exit(2);
  }
  return 0;
}

extern "C" __attribute__((visibility("default"))) int LLVMFuzzerTestOneInput(const std::uint8_t *bytes,
                                                                             std::size_t         size)
{
  gestell::fuzz::feed(*fed, std::string(reinterpret_cast<const char *>(bytes), size));
  return 0;
}
