// SPDX-License-Identifier: BSD-3-Clause
// libmpi_cxx.so.40 of a package without MPI inside. Debian's NETGEN and the headers of Open MPI 4
// name these functions of the C++ bindings, and call none. Many Open MPI 4 are built without the
// bindings, and Open MPI 5 has none.
#include <cstdlib>

namespace MPI {

struct Comm {
  Comm();
};

struct Datatype {
  virtual void Free();
};

struct Win {
  virtual void Free();
};

Comm::Comm() { std::abort(); }
void Datatype::Free() { std::abort(); }
void Win::Free() { std::abort(); }

}  // namespace MPI

extern "C" {
void ompi_mpi_cxx_op_intercept() { std::abort(); }
void ompi_op_set_cxx_callback() { std::abort(); }
}
