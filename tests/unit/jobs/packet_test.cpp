// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/packet.hpp"

#include <array>
#include <thread>

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tessera/base/file_descriptor.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "support/byte_image.hpp"

namespace tessera::jobs {
namespace {

class PacketSocket : public ::testing::Test {
 protected:
  void SetUp() override
  {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    near_ = FileDescriptor(ends[0]);
    far_ = FileDescriptor(ends[1]);
  }

  // Waits for a whole message.
  Bytes receive_message()
  {
    Assembly assembly;
    while (const auto packet = incoming_.receive(far_.get(), true))
      if (assembly.add(*packet)) return assembly.take();
    return {};
  }

  static Bytes pattern(std::size_t size)
  {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = static_cast<std::byte>((i * 7 + i / 999) & 0xFFU);
    return bytes;
  }

  FileDescriptor near_{};
  FileDescriptor far_{};
  Incoming incoming_{};
};

TEST_F(PacketSocket, MessagesOfAnySizeArriveWhole)
{
  for (const std::size_t size : {0UL, 1UL, 65535UL, 65536UL, 65537UL, 5000000UL}) {
    const Bytes sent = pattern(size);
    std::thread sender(
        [&] { EXPECT_TRUE(Outgoing(PacketKind::result, 1, sent).send_all(near_.get())); });
    EXPECT_EQ(receive_message(), sent) << size;
    sender.join();
  }
}

TEST_F(PacketSocket, SendingWithoutWaitingStopsWhenTheSocketIsFullAndGoesOnLater)
{
  const Bytes sent = pattern(5000000);
  Outgoing outgoing(PacketKind::run, 1, sent);
  ASSERT_TRUE(outgoing.send_some(near_.get()));
  EXPECT_FALSE(outgoing.is_sent());

  Assembly assembly;
  bool complete = false;
  while (!complete) {
    ASSERT_TRUE(outgoing.send_some(near_.get()));
    const auto packet = incoming_.receive(far_.get(), false);
    ASSERT_TRUE(packet.has_value());
    complete = assembly.add(*packet);
  }
  EXPECT_TRUE(outgoing.is_sent());
  EXPECT_EQ(assembly.take(), sent);
}

TEST_F(PacketSocket, MessageThatBreaksOffDoesNotDisturbTheNext)
{
  const Bytes first = pattern(5000000);
  const Bytes second = pattern(100);
  Outgoing broken(PacketKind::result, 1, first);
  ASSERT_TRUE(broken.send_some(near_.get()));
  Assembly assembly;
  while (const auto packet = incoming_.receive(far_.get(), false))
    EXPECT_FALSE(assembly.add(*packet));

  ASSERT_TRUE(Outgoing(PacketKind::result, 2, second).send_all(near_.get()));
  const auto packet = incoming_.receive(far_.get(), false);
  ASSERT_TRUE(packet.has_value());
  EXPECT_TRUE(assembly.add(*packet));
  EXPECT_EQ(assembly.take(), second);
}

TEST_F(PacketSocket, EndOfTheOtherSideIsSeen)
{
  EXPECT_FALSE(incoming_.receive(far_.get(), false).has_value());
  EXPECT_FALSE(incoming_.is_closed());
  near_.close();
  EXPECT_FALSE(incoming_.receive(far_.get(), true).has_value());
  EXPECT_TRUE(incoming_.is_closed());
  EXPECT_FALSE(send_signal(far_.get(), PacketKind::kill_job, 1));
}

template <class T>
class PacketValue : public ::testing::Test {
};

using Values = ::testing::Types<JobEnd, ProcessEnd, UsageReport>;
TYPED_TEST_SUITE(PacketValue, Values);

TYPED_TEST(PacketValue, ComesBackWhole)
{
  TypeParam value;
  testing::Sampler().fill(value);
  testing::expect_different_fields(value);
  testing::expect_round_trip(value);
  testing::expect_garbage_is_harmless(value);
}

}  // namespace
}  // namespace tessera::jobs
