// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/peer_watch.hpp"

#include <array>
#include <chrono>
#include <future>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "tessera/base/file_descriptor.hpp"

namespace tessera::pipeline {
namespace {

using namespace std::chrono_literals;

constexpr PeerLimits kQuick{.look = 10ms, .silence = 300ms};
constexpr auto kHang = 30s;
constexpr auto kManyLooks = 100 * kQuick.look;

// A peer on this machine: with so many connections that nobody has accepted, it answers no more.
class Listener {
 public:
  explicit Listener(int backlog) : socket_(::socket(AF_INET, SOCK_STREAM, 0))
  {
    socklen_t size = sizeof address_;
    address_.sin_family = AF_INET;
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_.get(), as_plain(), size), 0);
    EXPECT_EQ(::listen(socket_.get(), backlog), 0);
    EXPECT_EQ(::getsockname(socket_.get(), as_plain(), &size), 0);
  }

  // The last connection on this side, on which a byte has been sent.
  [[nodiscard]] FileDescriptor accepted() const
  {
    FileDescriptor other(::accept(socket_.get(), nullptr, nullptr));
    EXPECT_EQ(::send(other.get(), "x", 1, 0), 1);
    return other;
  }

  // Made, or on its way.
  [[nodiscard]] FileDescriptor connection()
  {
    FileDescriptor made(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
    ::connect(made.get(), as_plain(), sizeof address_);
    return made;
  }

 private:
  sockaddr* as_plain() { return reinterpret_cast<sockaddr*>(&address_); }

  FileDescriptor socket_;
  sockaddr_in address_{};
};

// A watch, and the sentence that it says.
struct Watched {
  std::promise<std::string> said{};
  std::future<std::string> sentence = said.get_future();
  PeerWatch watch{[this](const std::string& text) { said.set_value(text); }, kQuick};
};

TEST(PeerWatch, SaysThatAPeerDoesNotAnswer)
{
  Listener full(0);
  std::vector<FileDescriptor> connections;
  for (int i = 0; i < 4; ++i) connections.push_back(full.connection());
  Watched watched;
  ASSERT_EQ(watched.sentence.wait_for(kHang), std::future_status::ready);
  EXPECT_NE(watched.sentence.get().find("no answer from"), std::string::npos);
}

TEST(PeerWatch, SaysThatAPeerHasEnded)
{
  Listener listener(8);
  Watched watched;
  FileDescriptor connection = listener.connection();
  const FileDescriptor other = listener.accepted();
  ASSERT_EQ(watched.sentence.wait_for(kManyLooks), std::future_status::timeout);
  connection.close();
  ASSERT_EQ(watched.sentence.wait_for(kHang), std::future_status::ready);
  EXPECT_NE(watched.sentence.get().find("127.0.0.1 has been closed"), std::string::npos);
}

// Two ranks that connect to each other at once have two connections, and MPI drops one.
TEST(PeerWatch, IsContentWithAConnectionThatIsDroppedBeforeThePeerHasSaidAnything)
{
  Listener listener(8);
  Watched watched;
  FileDescriptor connection = listener.connection();
  ASSERT_EQ(watched.sentence.wait_for(kManyLooks), std::future_status::timeout);
  connection.close();
  EXPECT_EQ(watched.sentence.wait_for(kManyLooks), std::future_status::timeout);
}

TEST(PeerWatch, IsContentWithAPeerThatHasNothingToSay)
{
  Listener listener(8);
  Watched watched;
  const FileDescriptor connection = listener.connection();
  EXPECT_EQ(watched.sentence.wait_for(kManyLooks), std::future_status::timeout);
}

}  // namespace
}  // namespace tessera::pipeline
