// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <sys/types.h>

#include "tessera/base/file_descriptor.hpp"

/// How processes of one node find each other that have no common parent: local sockets with a name
/// that is in no file system. Only processes of the same user are let through.
namespace tessera::jobs {

/// @brief One end of a line to another process.
struct NodeLine {
  FileDescriptor socket{};
  pid_t peer = 0;  ///< Of who listens, or of who has connected; as this process sees it.
};

/// @brief A name that nobody else has on this node.
[[nodiscard]] std::string make_node_name();

/// @brief Lets others connect to `name`. @throws Error that says why it cannot.
[[nodiscard]] FileDescriptor listen_on_node(const std::string& name);

/// @brief The next line of who has connected; nothing if nobody waits. Never blocks.
/// @throws Error if the system lets nobody in.
[[nodiscard]] std::optional<NodeLine> accept_on_node(const FileDescriptor& listener);

/// @brief A line to who listens at `name`. @throws Error that says why there is none.
[[nodiscard]] NodeLine connect_on_node(const std::string& name);

}  // namespace tessera::jobs
