// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>
#include <list>
#include <thread>
#include <utility>

#include "tessera/comm/communicator.hpp"

#include "comm/pieces.hpp"

namespace tessera::comm {
namespace {

constexpr int kTagSize = 2;
constexpr int kTagPiece = 3;

// One message on its way: its size, which is sent first, and then the bytes in pieces. Pinned,
// since MPI reads both until the sends are done.
class Sending {
 public:
  Sending(Message message, std::size_t max_count, MPI_Comm handle)
      : message_(std::move(message)), size_(message_.bytes.size())
  {
    // Synchronous: done only when received, which is what the barrier below relies on. The pieces
    // may be ordinary sends, for whoever received the size waits for the pieces.
    MPI_Issend(&size_, 1, MPI_UINT64_T, message_.rank, kTagSize, handle, &requests_.emplace_back());
    for_each_piece(std::span<std::byte>(message_.bytes), max_count,
                   [&](std::byte* first, int count) {
                     MPI_Isend(first, count, MPI_BYTE, message_.rank, kTagPiece, handle,
                               &requests_.emplace_back());
                   });
  }

  [[nodiscard]] bool done()
  {
    int all_done = 0;
    MPI_Testall(to_mpi_count(requests_.size()), requests_.data(), &all_done, MPI_STATUSES_IGNORE);
    return all_done != 0;
  }

 private:
  Message message_;
  std::uint64_t size_;
  std::vector<MPI_Request> requests_{};
};

bool receive_one(std::vector<Message>& received, std::size_t max_count, MPI_Comm handle)
{
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kTagSize, handle, &there, &status);
  if (there == 0) return false;

  Message message{.rank = status.MPI_SOURCE};
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, message.rank, kTagSize, handle, MPI_STATUS_IGNORE);
  message.bytes.resize(static_cast<std::size_t>(size));
  for_each_piece(std::span<std::byte>(message.bytes), max_count, [&](std::byte* first, int count) {
    MPI_Recv(first, count, MPI_BYTE, message.rank, kTagPiece, handle, MPI_STATUS_IGNORE);
  });
  received.push_back(std::move(message));
  return true;
}

}  // namespace

std::vector<Message> Communicator::exchange(std::vector<Message> messages) const
{
  std::vector<Message> received;
  std::list<Sending> sendings;
  for (Message& message : messages) {
    if (message.rank == rank_)
      received.push_back(std::move(message));
    else
      sendings.emplace_back(std::move(message), max_count_, handle_);
  }
  if (size_ == 1) return received;  // Each look for a message would give the processor away.

  MPI_Request barrier = MPI_REQUEST_NULL;
  bool in_barrier = false;
  for (int all_done = 0; all_done == 0;) {
    while (receive_one(received, max_count_, handle_)) {
    }
    sendings.remove_if([](Sending& sending) { return sending.done(); });
    if (!in_barrier && sendings.empty()) {
      MPI_Ibarrier(handle_, &barrier);
      in_barrier = true;
    }
    if (in_barrier) MPI_Test(&barrier, &all_done, MPI_STATUS_IGNORE);
    // What is waited for may be done by a rank that has no core of its own.
    if (all_done == 0) std::this_thread::yield();
  }
  // A rank that learns early that the barrier is complete must not start another exchange while a
  // later one still looks for messages of this one.
  MPI_Barrier(handle_);

  std::stable_sort(received.begin(), received.end(),
                   [](const Message& a, const Message& b) { return a.rank < b.rank; });
  return received;
}

}  // namespace tessera::comm
