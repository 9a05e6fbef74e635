// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/shared_bytes.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/file_descriptor.hpp"

namespace tessera {
namespace {

[[noreturn]] void fail(const char* what, int error)
{
  throw Error(std::string("shared memory: ") + what + ": " + std::strerror(error));
}

// Unmapped when it goes.
class MappedMemory {
 public:
  MappedMemory(int descriptor, std::size_t size, int protection, int flags)
      : place_(::mmap(nullptr, size, protection, flags, descriptor, 0)), size_(size)
  {
    if (place_ == MAP_FAILED) fail("mmap", errno);
  }
  ~MappedMemory() { ::munmap(place_, size_); }
  MappedMemory(const MappedMemory&) = delete;
  MappedMemory& operator=(const MappedMemory&) = delete;

  [[nodiscard]] std::span<std::byte> bytes() const
  {
    return {static_cast<std::byte*>(place_), size_};
  }

 private:
  void* place_;
  std::size_t size_;
};

// Without this a write beyond what there is would be a SIGBUS.
void reserve(int descriptor, std::size_t size)
{
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor, 0, static_cast<off_t>(size));
  if (error != 0) fail("not enough of it", error);
}

// In a container of its own, another process may have that number, and anything open.
constexpr int kHarmless = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

SegmentName name_of(int descriptor)
{
  struct stat found {};
  if (::fstat(descriptor, &found) != 0) fail("fstat", errno);
  return {.process = ::getpid(),
          .descriptor = descriptor,
          .device = found.st_dev,
          .inode = found.st_ino,
          .size = static_cast<std::uint64_t>(found.st_size)};
}

}  // namespace

class SharedBytes::Mapping {
 public:
  // Kernels before 6.7 refuse MAP_SHARED of what is sealed against writes. Nobody writes, so the
  // pages are the segment's all the same.
  Mapping(FileDescriptor file, const SegmentName& name)
      : file_(std::move(file)),
        name_(name),
        memory_(file_.get(), name_.size, PROT_READ, MAP_PRIVATE)
  {
  }

  [[nodiscard]] const SegmentName& name() const { return name_; }
  [[nodiscard]] std::span<const std::byte> bytes() const { return memory_.bytes(); }

 private:
  FileDescriptor file_;  // Stays open: by that of its maker others find the segment.
  SegmentName name_;
  MappedMemory memory_;
};

SharedBytes::SharedBytes(Bytes bytes)
{
  const auto kept = std::make_shared<const Bytes>(std::move(bytes));
  bytes_ = *kept;
  keeper_ = kept;
}

SharedBytes::SharedBytes(std::shared_ptr<const Mapping> mapping)
    : bytes_(mapping->bytes()), keeper_(mapping), segment_(mapping->name())
{
}

SharedBytes SharedBytes::make_segment(std::size_t size,
                                      const std::function<void(std::span<std::byte>)>& fill)
{
  FileDescriptor file(::memfd_create("tessera", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (file.get() < 0) fail("memfd_create", errno);
  reserve(file.get(), size);
  fill(MappedMemory(file.get(), size, PROT_READ | PROT_WRITE, MAP_SHARED).bytes());
  if (::fcntl(file.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL)
      != 0) {
    fail("it cannot be sealed", errno);
  }
  const SegmentName name = name_of(file.get());
  return SharedBytes(std::make_shared<const Mapping>(std::move(file), name));
}

SharedBytes SharedBytes::map_segment(const SegmentName& name)
{
  const std::string path =
      "/proc/" + std::to_string(name.process) + "/fd/" + std::to_string(name.descriptor);
  FileDescriptor file(::open(path.c_str(), kHarmless));
  if (file.get() < 0) fail(path.c_str(), errno);
  const SegmentName found = name_of(file.get());
  if (found.device != name.device || found.inode != name.inode || found.size != name.size) {
    throw Error("shared memory: " + path + " is another segment");
  }
  return SharedBytes(std::make_shared<const Mapping>(std::move(file), name));
}

}  // namespace tessera
