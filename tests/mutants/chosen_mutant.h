#pragma once

#include <cstdlib>

/// Whether the environment chooses that mutant (tests/mutants/run), GESTELL_MUTANT=N; 0 and nothing choose none.
inline bool gestell_mutant(int number)
{
  static const int chosen = []
  {
    const char *const text = std::getenv("GESTELL_MUTANT");
    return text ? std::atoi(text) : 0;
  }();
  return chosen == number;
}
