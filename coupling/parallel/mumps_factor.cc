#include "coupling/parallel/mumps_factor.h"

#include "fem/parallel/ranks.h"

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>

namespace gestell::coupling
{

namespace
{

// Jobs and controls by the numbers of the MUMPS users' guide, 5.5.
enum Job
{
  begin     = -1,
  end       = -2,
  analysis  = 1,
  factorise = 2,
  solution  = 3
};
constexpr int use_first         = 1;   // par: rank 0 takes part in the factor
constexpr int singular          = -10; // INFOG(1)
constexpr int not_definite      = -40; // of the dense root
constexpr int room_short[]      = {-8, -9, -11, -12, -14, -15, -17, -20};
constexpr int most_enlargements = 4;
constexpr int block_width       = 32; // right-hand sides that pass the factor together

} // namespace

struct MumpsFactor::Instance
{
  DMUMPS_STRUC_C         id{};
  bool                   failed          = false; // of the factorisation, as what follows
  int                    negative_pivots = 0;
  double                 largest_memory = 0., whole_memory = 0.;
  int                    first_row = 0, n_rows = 0; // of this rank
  std::vector<int>       row, column, places;       // counted from 1
  std::vector<double>    value;
  std::vector<int>       rhs_row, solution_row;
  std::vector<double>    rhs, solution_part;
  PetscOwned<Vec>        solution_view;
  PetscOwned<VecScatter> to_rows;

  Instance()                            = default;
  Instance(const Instance &)            = delete;
  Instance &operator=(const Instance &) = delete;
  ~Instance()
  {
    if (id.job != 0)
      run(end);
  }

  int &icntl(int i) { return id.icntl[i - 1]; }
  int  infog(int i) const { return id.infog[i - 1]; }

  /// @returns INFOG(1)
  int run(int job)
  {
    id.job = job;
    dmumps_c(&id);
    return infog(1);
  }
  void require_success(const char *what) const
  {
    if (infog(1) < 0)
      throw fem::AgreedFailure(fem::AgreedFailure::Kind::method,
                               std::string("MUMPS failed in the ") + what + " with INFOG(1) = " +
                                   std::to_string(infog(1)) + ", INFOG(2) = " + std::to_string(infog(2)) +
                                   (infog(1) == -13 || infog(1) == -19 ? ": memory is short; start more ranks" : ""));
  }
};

namespace
{

/// Calls visit(row, column, value) for the lower triangle of A on this rank, of held rows the diagonal alone.
template <typename Visit>
void along_lower_triangle(Mat A, const std::vector<int> &held, const Visit &visit)
{
  const auto is_held = [&](int i) { return std::binary_search(held.begin(), held.end(), i); };
  for_each_own_row(A, "MumpsFactor",
                   [&](PetscInt i, PetscInt count, const PetscInt *columns, const PetscScalar *values)
                   {
                     for (PetscInt k = 0; k < count; ++k)
                       if (columns[k] == i)
                         visit(i, i, is_held(i) ? std::max(std::abs(values[k]), 1e-300) : values[k]);
                       else if (columns[k] < i && !is_held(i) && !is_held(columns[k]))
                         visit(i, columns[k], values[k]);
                   });
}

/// Rows of this rank, lower triangle, counted from 1; MUMPS adds entries at the same place.
void read_lower_triangle(const MumpsFactor::Shifted &A, const std::vector<int> &held, std::vector<int> &row,
                         std::vector<int> &column, std::vector<double> &value)
{
  std::size_t size = 0; // counted first: vectors that grow would take twice the memory
  for (Mat part : {A.A, A.B})
    if (part)
      along_lower_triangle(part, held, [&](int, int, double) { ++size; });
  row.reserve(size), column.reserve(size), value.reserve(size);
  const auto add = [&](int i, int j, double a)
  {
    row.push_back(i + 1);
    column.push_back(j + 1);
    value.push_back(a);
  };
  along_lower_triangle(A.A, held, add);
  if (A.B)
    along_lower_triangle(A.B, held,
                         [&](int i, int j, double b)
                         { add(i, j, std::binary_search(held.begin(), held.end(), i) ? 0. : A.factor * b); });
}

} // namespace

MumpsFactor::MumpsFactor(const Shifted &A, const std::vector<int> &held, const std::vector<int> &places, Sign sign)
    : instance_(std::make_unique<Instance>())
{
  Instance        &m = *instance_;
  const fem::Ranks ranks;
  int              last = 0, n = 0;
  MatGetSize(A.A, &n, nullptr);
  MatGetOwnershipRange(A.A, &m.first_row, &last);
  m.n_rows = last - m.first_row;
  ranks.agree(
      [&]
      {
        read_lower_triangle(A, held, m.row, m.column, m.value);
        for (const int place : places)
          m.places.push_back(place + 1);
        for (int i = m.first_row; i < last; ++i)
          m.rhs_row.push_back(i + 1);
        m.rhs.resize(m.n_rows + 1);
      });

  m.id.comm_fortran = MPI_Comm_c2f(fem::Ranks::comm());
  m.id.par          = use_first;
  m.id.sym          = sign == Sign::positive ? 1 : 2;
  m.run(begin);
  m.require_success("start");
  for (const int stream : {1, 2, 3})
    m.icntl(stream) = -1; // silent
  m.icntl(4)  = 0;
  m.icntl(5)  = 0;                              // assembled,
  m.icntl(18) = 3;                              // each rank its entries
  m.icntl(28) = 1;                              // analysis on rank 0
  m.icntl(7)  = 1;                              // in the order given:
  m.icntl(12) = 1;                              // no other graph for indefinite matrices
  m.icntl(13) = sign == Sign::positive ? 0 : 1; // ScaLAPACK's root does not count negative pivots
  m.icntl(14) = 30;                             // % of room beyond the estimate
  m.icntl(27) = block_width;

  m.id.n       = n;
  m.id.nnz_loc = std::int64_t(m.value.size());
  m.id.irn_loc = m.row.data();
  m.id.jcn_loc = m.column.data();
  m.id.a_loc   = m.value.data();
  m.id.perm_in = m.places.data();
  m.run(analysis);
  m.require_success("analysis");
  const auto is_short = [&](int code)
  { return std::find(std::begin(room_short), std::end(room_short), code) != std::end(room_short); };
  for (int enlargement = 0; is_short(m.run(factorise)) && enlargement < most_enlargements; ++enlargement)
    m.icntl(14) *= 2;
  m.failed = m.infog(1) == singular || m.infog(1) == not_definite;
  if (!m.failed)
    m.require_success("factorisation");
  m.negative_pivots = m.infog(12);
  m.largest_memory  = m.infog(21);
  m.whole_memory    = m.infog(22);
  m.id.irn_loc = m.id.jcn_loc = nullptr; // the entries are not needed any more: new vectors, for clear() keeps memory
  m.id.a_loc                  = nullptr;
  m.row                       = std::vector<int>();
  m.column                    = std::vector<int>();
  m.value                     = std::vector<double>();
}

MumpsFactor::~MumpsFactor() = default;

bool MumpsFactor::failed() const
{
  return instance_->failed;
}

int MumpsFactor::negative_pivots() const
{
  return instance_->negative_pivots;
}

void MumpsFactor::solve_on_first(double *X, int columns)
{
  Instance &m = *instance_;
  m.icntl(20) = 0; // right-hand sides and
  m.icntl(21) = 0; // solutions on rank 0, in the same place
  m.id.nrhs   = columns;
  m.id.lrhs   = m.id.n;
  m.id.rhs    = X;
  m.run(solution);
  m.require_success("solution");
}

void MumpsFactor::solve(Vec f, Vec x)
{
  Instance          &m    = *instance_;
  const PetscScalar *from = nullptr;
  require_petsc(VecGetArrayRead(f, &from), "MumpsFactor");
  std::copy_n(from, m.n_rows, m.rhs.begin());
  require_petsc(VecRestoreArrayRead(f, &from), "MumpsFactor");

  const int  part       = m.id.info[23 - 1]; // pivots of this rank
  const bool first_time = !m.to_rows;
  if (first_time)
  {
    m.solution_row.resize(part + 1);
    m.solution_part.resize(part + 1);
  }
  m.icntl(20)   = 10; // right-hand side by the rows of each rank,
  m.icntl(21)   = 1;  // solution by the pivots of each
  m.id.nrhs     = 1;
  m.id.nloc_rhs = m.n_rows;
  m.id.lrhs_loc = m.n_rows + 1;
  m.id.irhs_loc = m.rhs_row.data();
  m.id.rhs_loc  = m.rhs.data();
  m.id.lsol_loc = part + 1;
  m.id.sol_loc  = m.solution_part.data();
  m.id.isol_loc = m.solution_row.data();
  m.run(solution);
  m.require_success("solution");

  if (first_time)
  {
    Vec view = nullptr;
    require_petsc(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, part, m.solution_part.data(), &view), "MumpsFactor");
    m.solution_view.reset(view);
    std::vector<int> rows(m.solution_row.begin(), m.solution_row.begin() + part);
    for (int &row : rows)
      --row;
    IS to = nullptr;
    require_petsc(ISCreateGeneral(PETSC_COMM_SELF, part, rows.data(), PETSC_COPY_VALUES, &to), "MumpsFactor");
    const PetscOwned<IS> owned(to);
    VecScatter           scatter = nullptr;
    require_petsc(VecScatterCreate(view, nullptr, x, to, &scatter), "MumpsFactor");
    m.to_rows.reset(scatter);
  }
  require_petsc(VecScatterBegin(m.to_rows.get(), m.solution_view.get(), x, INSERT_VALUES, SCATTER_FORWARD),
                "MumpsFactor");
  require_petsc(VecScatterEnd(m.to_rows.get(), m.solution_view.get(), x, INSERT_VALUES, SCATTER_FORWARD),
                "MumpsFactor");
}

double MumpsFactor::largest_memory() const
{
  return instance_->largest_memory;
}

double MumpsFactor::whole_memory() const
{
  return instance_->whole_memory;
}

} // namespace gestell::coupling
