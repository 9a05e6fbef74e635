// SPDX-License-Identifier: BSD-3-Clause
// For the bench `scale`: preloaded into the program (LD_PRELOAD), it writes down every call of MPI
// in src/comm that moves data. At MPI_Finalize each rank writes DIR/mpi_RANK.tsv, with DIR from
// TESSERA_MPI_COUNTS:
//   call  entered  left  bytes sent  bytes received
// Times are seconds of the machine's clock. Bytes are those of the caller's own buffers: what MPI
// passes on for other ranks, as in the tree of a broadcast, is not known here.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <mpi.h>

namespace {

struct Event {
  const char* call;
  double entered;
  double left;
  long long sent;
  long long received;
};

std::vector<Event>& events()
{
  static std::vector<Event> all;
  return all;
}

double now()
{
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

long long bytes_of(int count, MPI_Datatype type)
{
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<long long>(count) * size;
}

int rank_in(MPI_Comm comm)
{
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank;
}

int size_of(MPI_Comm comm)
{
  int size = 1;
  PMPI_Comm_size(comm, &size);
  return size;
}

template <class Call>
int noted(const char* name, long long sent, long long received, const Call& call)
{
  const double entered = now();
  const int code = call();
  events().push_back({name, entered, now(), sent, received});
  return code;
}

void write_events(const char* folder)
{
  const std::string file =
      std::string(folder) + "/mpi_" + std::to_string(rank_in(MPI_COMM_WORLD)) + ".tsv";
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) return;
  for (const Event& event : events()) {
    std::fprintf(out, "%s\t%.6f\t%.6f\t%lld\t%lld\n", event.call, event.entered, event.left,
                 event.sent, event.received);
  }
  std::fclose(out);
}

}  // namespace

extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  return noted("send", bytes_of(count, type), 0,
               [&] { return PMPI_Send(data, count, type, to, tag, comm); });
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request)
{
  return noted("send", bytes_of(count, type), 0,
               [&] { return PMPI_Isend(data, count, type, to, tag, comm, request); });
}

int MPI_Issend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request)
{
  return noted("send", bytes_of(count, type), 0,
               [&] { return PMPI_Issend(data, count, type, to, tag, comm, request); });
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status)
{
  return noted("receive", 0, bytes_of(count, type),
               [&] { return PMPI_Recv(data, count, type, from, tag, comm, status); });
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm)
{
  const long long bytes = bytes_of(count, type);
  const bool is_root = rank_in(comm) == root;
  return noted("broadcast", is_root ? bytes : 0, is_root ? 0 : bytes,
               [&] { return PMPI_Bcast(data, count, type, root, comm); });
}

int MPI_Gather(const void* data, int count, MPI_Datatype type, void* all, int one,
               MPI_Datatype all_type, int root, MPI_Comm comm)
{
  const long long received =
      rank_in(comm) == root ? bytes_of(one, all_type) * (size_of(comm) - 1) : 0;
  return noted("gather", bytes_of(count, type), received,
               [&] { return PMPI_Gather(data, count, type, all, one, all_type, root, comm); });
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm)
{
  const long long bytes = bytes_of(count, type);
  return noted("reduce", bytes, bytes,
               [&] { return PMPI_Allreduce(data, result, count, type, operation, comm); });
}

int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
               int root, MPI_Comm comm)
{
  const long long bytes = bytes_of(count, type);
  const bool is_root = rank_in(comm) == root;
  return noted("reduce", is_root ? 0 : bytes, is_root ? bytes : 0,
               [&] { return PMPI_Reduce(data, result, count, type, operation, root, comm); });
}

int MPI_Exscan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm)
{
  const long long bytes = bytes_of(count, type);
  return noted("reduce", bytes, bytes,
               [&] { return PMPI_Exscan(data, result, count, type, operation, comm); });
}

int MPI_Barrier(MPI_Comm comm)
{
  return noted("barrier", 0, 0, [&] { return PMPI_Barrier(comm); });
}

int MPI_Finalize()
{
  if (const char* folder = std::getenv("TESSERA_MPI_COUNTS")) write_events(folder);
  return PMPI_Finalize();
}

}  // extern "C"
