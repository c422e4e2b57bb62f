// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::net {

/// The result of an attempt to transfer bytes.
struct Transfer {
    enum class State : std::uint8_t {
        moved,
        later, // nothing can be transferred now
        ended, // the other side sends no more
        gone,  // the connection is broken
    };

    State state = State::later;
    std::size_t bytes = 0; // number of bytes that were transferred
};

/// One end of a connection over a Unix socket. Transfers bytes; makes no decisions.
class UnixStream {
public:
    /// Connects to the socket at `path`. Throws std::system_error naming it.
    [[nodiscard]] static UnixStream connect(const std::string& path);

    /// Takes over a connected descriptor.
    explicit UnixStream(int descriptor) : descriptor_{descriptor} {}
    ~UnixStream();
    UnixStream(UnixStream&& other) noexcept;
    UnixStream& operator=(UnixStream&& other) noexcept;
    UnixStream(const UnixStream&) = delete;
    UnixStream& operator=(const UnixStream&) = delete;

    /// Reads what has arrived. read() and write() never block.
    Transfer read(std::span<char> into);
    Transfer write(std::string_view bytes);

    [[nodiscard]] int descriptor() const { return descriptor_; }

private:
    int descriptor_ = -1;
};

/// A Unix socket in the file system that only its owner may open (mode 0600). Never blocks.
class UnixListener {
public:
    /// Creates the socket. Replaces an existing socket on which no program answers any more, and
    /// nothing else. Throws std::system_error naming the path: EADDRINUSE if a program answers
    /// there or the file is not a socket.
    explicit UnixListener(std::string path);
    /// Removes the socket file, unless another one has replaced it.
    ~UnixListener();
    UnixListener(const UnixListener&) = delete;
    UnixListener& operator=(const UnixListener&) = delete;

    /// Returns the next connection; nullopt if there is none.
    [[nodiscard]] std::optional<UnixStream> accept();

    [[nodiscard]] int descriptor() const { return socket_.descriptor(); }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
    UnixStream socket_;      // owns the listening descriptor
    std::uint64_t file_ = 0; // inode number of the socket
};

} // namespace hapnet::net
