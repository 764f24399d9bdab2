// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded, it counts what a rank sends, and the CPU time that it spends inside and outside of MPI: a rank
// that waits spins, which on fewer cores than ranks would count as work.  At the end it writes one JSON
// object to $MPI_CENSUS/RANK.json.
#define OMPI_SKIP_MPICXX 1  // of the old C++ interface, which would have to be linked
#include <mpi.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <unordered_map>

namespace {

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Census {
  double seconds_inside = 0.0, bytes = 0.0;
  long messages = 0, collectives = 0;
} census;

/// A call of MPI, while it lasts.
struct Inside {
  double start = thread_seconds();
  ~Inside() { census.seconds_inside += thread_seconds() - start; }
};

void add_bytes(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  census.bytes += static_cast<double>(count) * size;
}

void message(int count, MPI_Datatype type) {
  ++census.messages;
  add_bytes(count, type);
}

void collective(int count, MPI_Datatype type) {
  ++census.collectives;
  add_bytes(count, type);
}

/// Messages that are sent again and again, by what they are started with; what is received is not among them.
std::unordered_map<MPI_Request, double> persistent;

void start(int count, const MPI_Request* requests) {
  for (int i = 0; i < count; ++i)
    if (const auto found = persistent.find(requests[i]); found != persistent.end()) {
      ++census.messages;
      census.bytes += found->second;
    }
}

/// One message to each rank that gets anything.
void messages(const int* counts, MPI_Datatype type, int ranks) {
  for (int rank = 0; rank < ranks; ++rank)
    if (counts[rank] > 0) message(counts[rank], type);
}

int ranks_of(MPI_Comm comm) {
  int ranks = 0;
  PMPI_Comm_size(comm, &ranks);
  return ranks;
}

void write_census() {
  const char* folder = std::getenv("MPI_CENSUS");
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  char path[4096];
  std::snprintf(path, sizeof path, "%s/%d.json", folder ? folder : ".", rank);
  if (std::FILE* file = std::fopen(path, "w")) {
    std::fprintf(file,
                 "{\"cpu\": %.6f, \"inside_mpi\": %.6f, \"messages\": %ld, \"collectives\": %ld, "
                 "\"bytes\": %.0f, \"peak_bytes\": %.0f}\n",
                 thread_seconds(), census.seconds_inside, census.messages, census.collectives, census.bytes,
                 1024.0 * static_cast<double>(usage.ru_maxrss));
    std::fclose(file);
  }
}

}  // namespace

// A function of MPI: its parameters, what is counted, and its arguments.
#define WRAP(name, parameters, count, arguments) \
  extern "C" int MPI_##name parameters {         \
    const Inside inside;                         \
    count;                                       \
    return PMPI_##name arguments;                \
  }

WRAP(Send, (const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c), message(n, t),
     (b, n, t, to, tag, c))
WRAP(Isend, (const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c, MPI_Request* r),
     message(n, t), (b, n, t, to, tag, c, r))
WRAP(Rsend, (const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c), message(n, t),
     (b, n, t, to, tag, c))
WRAP(Sendrecv,
     (const void* b, int n, MPI_Datatype t, int to, int tag, void* in, int m, MPI_Datatype u, int from,
      int tag_in, MPI_Comm c, MPI_Status* s),
     message(n, t), (b, n, t, to, tag, in, m, u, from, tag_in, c, s))
WRAP(Recv, (void* b, int n, MPI_Datatype t, int from, int tag, MPI_Comm c, MPI_Status* s), {},
     (b, n, t, from, tag, c, s))
WRAP(Wait, (MPI_Request * r, MPI_Status* s), {}, (r, s))
WRAP(Waitall, (int n, MPI_Request r[], MPI_Status s[]), {}, (n, r, s))
WRAP(Waitany, (int n, MPI_Request r[], int* i, MPI_Status* s), {}, (n, r, i, s))
WRAP(Start, (MPI_Request * r), start(1, r), (r))
WRAP(Startall, (int n, MPI_Request r[]), start(n, r), (n, r))
WRAP(Barrier, (MPI_Comm c), ++census.collectives, (c))
WRAP(Bcast, (void* b, int n, MPI_Datatype t, int root, MPI_Comm c), collective(n, t), (b, n, t, root, c))
WRAP(Reduce, (const void* b, void* o, int n, MPI_Datatype t, MPI_Op op, int root, MPI_Comm c),
     collective(n, t), (b, o, n, t, op, root, c))
WRAP(Allreduce, (const void* b, void* o, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c), collective(n, t),
     (b, o, n, t, op, c))
WRAP(Scan, (const void* b, void* o, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c), collective(n, t),
     (b, o, n, t, op, c))
WRAP(Allgather, (const void* b, int n, MPI_Datatype t, void* o, int m, MPI_Datatype u, MPI_Comm c),
     collective(n, t), (b, n, t, o, m, u, c))
WRAP(Allgatherv,
     (const void* b, int n, MPI_Datatype t, void* o, const int m[], const int at[], MPI_Datatype u,
      MPI_Comm c),
     collective(n, t), (b, n, t, o, m, at, u, c))
WRAP(Gather, (const void* b, int n, MPI_Datatype t, void* o, int m, MPI_Datatype u, int root, MPI_Comm c),
     collective(n, t), (b, n, t, o, m, u, root, c))
WRAP(Alltoall, (const void* b, int n, MPI_Datatype t, void* o, int m, MPI_Datatype u, MPI_Comm c),
     collective(n* ranks_of(c), t), (b, n, t, o, m, u, c))
WRAP(Alltoallv,
     (const void* b, const int n[], const int from[], MPI_Datatype t, void* o, const int m[], const int at[],
      MPI_Datatype u, MPI_Comm c),
     (++census.collectives, messages(n, t, ranks_of(c))), (b, n, from, t, o, m, at, u, c))

extern "C" int MPI_Send_init(const void* b, int n, MPI_Datatype t, int to, int tag, MPI_Comm c,
                             MPI_Request* r) {
  int size = 0;
  PMPI_Type_size(t, &size);
  const int result = PMPI_Send_init(b, n, t, to, tag, c, r);
  persistent[*r] = static_cast<double>(n) * size;
  return result;
}

extern "C" int MPI_Finalize() {
  write_census();
  return PMPI_Finalize();
}
