#include "fem/assembly/sparse_sum.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace gestell::fem
{

void add(SparseMatrix &A, const Eigen::SparseMatrix<double> &S)
{
  if (!A.isCompressed() || !S.isCompressed())
    throw std::logic_error("sparse_sum: the matrices must be compressed");
  std::vector<int> place; // in A of every entry of S
  place.reserve(S.nonZeros());
  const int *rows = A.innerIndexPtr();
  for (int j = 0; j < S.outerSize(); ++j)
  {
    const int *begin = rows + A.outerIndexPtr()[j], *end = rows + A.outerIndexPtr()[j + 1];
    for (Eigen::SparseMatrix<double>::InnerIterator s(S, j); s; ++s)
    {
      begin = std::lower_bound(begin, end, int(s.row()));
      if (begin == end || *begin != s.row())
      {
        A = SparseMatrix::Base(A + S);
        return;
      }
      place.push_back(int(begin - rows));
    }
  }
  for (std::size_t k = 0; k < place.size(); ++k)
    A.valuePtr()[place[k]] += S.valuePtr()[k];
}

} // namespace gestell::fem
