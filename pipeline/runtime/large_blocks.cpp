// SPDX-License-Identifier: BSD-3-Clause
// Replaces the program's operator new, so that large arrays stand on huge pages.
//
// Fresh memory is handed over page by page, each when it is first touched. With pages of 4 KiB that
// takes longer than what most passes over a mesh do with them: to list the triangles of 840,000
// tets took 1.2 s, and takes 0.3 s on huge pages (on a virtual machine, where that is dear). Where
// an array has room to grow, its next 2 MiB are there before they are needed: peaks of ranks rose
// by 3 to 5 % (shaft.geo, 6.9 M tets). The last part of a block is on small pages. All is a matter
// of speed only, so nothing is done about a refusal.
#include <cstddef>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kLeast = 2 * kHugePage;  // Smaller ones would have few.

void* allocate(std::size_t size) noexcept
{
  if (size < kLeast) return std::malloc(size > 0 ? size : 1);
  void* block = nullptr;
  if (::posix_memalign(&block, kHugePage, size) != 0) return nullptr;
  ::madvise(block, size & ~(kHugePage - 1), MADV_HUGEPAGE);
  return block;
}

}  // namespace

void* operator new(std::size_t size)
{
  while (true) {
    if (void* const block = allocate(size)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t /*size*/) noexcept { std::free(block); }
