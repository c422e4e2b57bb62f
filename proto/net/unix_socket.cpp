// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/unix_socket.hpp"

#include <cerrno>
#include <cstring>
#include <spdlog/fmt/fmt.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

/// Explains why a path cannot become a control socket. The advice is about programs and paths, not
/// about ports.
class PathCategory : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "control socket"; }
    [[nodiscard]] std::string message(int error) const override
    {
        if (error == EEXIST) {
            return "this exists and is not a socket; it was left as it is: choose another path";
        }
        if (error == ENOTSOCK) return "this is not a socket";
        return "another emulator or peer serves it: end that one, or choose another path";
    }
    [[nodiscard]] std::error_condition default_error_condition(int error) const noexcept override
    {
        return {error, std::generic_category()};
    }
};

[[noreturn]] void refuse(int error, std::string_view doing, const std::string& path)
{
    static const PathCategory path_category;
    const bool is_of_path = error == EADDRINUSE || error == EEXIST || error == ENOTSOCK;
    const std::error_category& category =
        is_of_path ? static_cast<const std::error_category&>(path_category)
                   : std::generic_category();
    throw std::system_error{error, category, fmt::format("{} {}", doing, path)};
}

sockaddr_un address_of(const std::string& path)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty()) refuse(ENOENT, "a socket needs a path", path);
    if (path.size() >= sizeof address.sun_path) {
        refuse(
            ENAMETOOLONG,
            fmt::format("the path of a socket has at most {} bytes:", sizeof address.sun_path - 1),
            path);
    }
    std::memcpy(address.sun_path, path.data(), path.size());
    return address;
}

/// Returns the address in the type that the system's functions require.
const sockaddr* generic(const sockaddr_un& address)
{
    return reinterpret_cast<const sockaddr*>(&address);
}

UnixStream new_socket()
{
    const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor < 0) throw std::system_error{errno, std::generic_category(), "socket"};
    return UnixStream{descriptor};
}

Transfer outcome_of(ssize_t count)
{
    using State = Transfer::State;
    if (count > 0) return {State::moved, static_cast<std::size_t>(count)};
    if (count == 0) return {State::ended};
    const bool is_for_now = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    return {is_for_now ? State::later : State::gone};
}

/// Removes a socket on which no program answers.
void clear_the_place(const std::string& path, const sockaddr_un& address)
{
    struct stat found {};
    if (lstat(path.c_str(), &found) != 0) return;
    if (!S_ISSOCK(found.st_mode)) refuse(EEXIST, "cannot listen on", path);
    const auto probe = new_socket();
    if (::connect(probe.descriptor(), generic(address), sizeof address) == 0 || errno == EAGAIN) {
        refuse(EADDRINUSE, "cannot listen on", path);
    }
    if (errno == ECONNREFUSED) unlink(path.c_str());
}

} // namespace

UnixStream UnixStream::connect(const std::string& path)
{
    const auto address = address_of(path);
    auto stream = new_socket();
    if (::connect(stream.descriptor(), generic(address), sizeof address) != 0) {
        const int error = errno;
        struct stat found {};
        const bool is_other = stat(path.c_str(), &found) == 0 && !S_ISSOCK(found.st_mode);
        refuse(is_other ? ENOTSOCK : error, "cannot connect to", path);
    }
    return stream;
}

UnixStream::~UnixStream()
{
    if (descriptor_ >= 0) close(descriptor_);
}

UnixStream::UnixStream(UnixStream&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}
{}

UnixStream& UnixStream::operator=(UnixStream&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

Transfer UnixStream::read(std::span<char> into)
{
    return outcome_of(recv(descriptor_, into.data(), into.size(), MSG_DONTWAIT));
}

Transfer UnixStream::write(std::string_view bytes)
{
    return outcome_of(send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
}

UnixListener::UnixListener(std::string path) : path_{std::move(path)}, socket_{new_socket()}
{
    constexpr int waiting_max = 64;
    const auto address = address_of(path_);
    clear_the_place(path_, address);
    // The file is created with its final mode, so that no other user can ever open the socket.
    const auto mask = umask(S_IRWXG | S_IRWXO | S_IXUSR);
    const int bound = bind(descriptor(), generic(address), sizeof address);
    const int error = errno;
    umask(mask);
    if (bound != 0) refuse(error, "cannot listen on", path_);
    struct stat created {};
    if (lstat(path_.c_str(), &created) == 0) file_ = created.st_ino;
    if (listen(descriptor(), waiting_max) != 0) refuse(errno, "cannot listen on", path_);
}

UnixListener::~UnixListener()
{
    struct stat found {};
    // Another file may have this inode number by now.
    const bool is_ours =
        lstat(path_.c_str(), &found) == 0 && S_ISSOCK(found.st_mode) && found.st_ino == file_;
    if (is_ours) unlink(path_.c_str());
}

std::optional<UnixStream> UnixListener::accept()
{
    const int accepted = accept4(descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (accepted < 0) return std::nullopt;
    return UnixStream{accepted};
}

} // namespace hapnet::net
