// The unit of tests/benchmarks/side_by_side: y = A x of 200 x 200 numbers in plain loops, in microseconds of CPU time.
#include <cstdio>
#include <ctime>
#include <vector>

int main()
{
  const int           n = 200, repetitions = 100000;
  std::vector<double> A(n * n), x(n, 1.), y(n);
  for (int i = 0; i < n * n; ++i)
    A[i] = 1. / (1. + i % 17);
  const std::clock_t start = std::clock();
  for (int k = 0; k < repetitions; ++k)
  {
    for (int i = 0; i < n; ++i)
      y[i] = 0.;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        y[i] += A[j * n + i] * x[j];
    x[k % n] = y[k % n] / y[0];
  }
  std::printf("%.4f\n", 1e6 * double(std::clock() - start) / CLOCKS_PER_SEC / repetitions);
  return y[0] > 0. ? 0 : 1;
}
