// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/own_network.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sched.h>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::net {

namespace {

bool write_to(const char* path, std::string_view text)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool is_written = write(file, text.data(), text.size()) == std::ssize(text);
    const int error = errno;
    close(file);
    errno = error;
    return is_written;
}

/// System errors whose text already includes the cure.
class NetworkErrors : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "own network"; }
    [[nodiscard]] std::string message(int error) const override
    {
        return std::generic_category().message(error);
    }
};

constexpr std::string_view user_namespace_cure =
    "cannot make a user namespace, which another user than root needs for a network of its own; "
    "the system forbids it: run as root, or have an administrator allow it: sysctl -w "
    "user.max_user_namespaces=10000, on Debian also kernel.unprivileged_userns_clone=1, on Ubuntu "
    "kernel.apparmor_restrict_unprivileged_userns=0; in a container, allow unshare (with Docker: "
    "--security-opt seccomp=unconfined)";

/// Returns a socket that lists the sockets in the network of that process (sock_diag(7)); -1 if
/// there is none. The calling thread is briefly in that network.
int sockets_of(pid_t process)
{
    const int own = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    const int other = open(fmt::format("/proc/{}/ns/net", process).c_str(), O_RDONLY | O_CLOEXEC);
    int sockets = -1;
    if (own >= 0 && other >= 0 && setns(other, CLONE_NEWNET) == 0) {
        sockets = socket(AF_NETLINK, SOCK_DGRAM | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
        base::ensure(setns(own, CLONE_NEWNET) == 0);
    }
    if (own >= 0) close(own);
    if (other >= 0) close(other);
    return sockets;
}

/// True if there is a socket of this family and protocol in one of the states, which are bits. Also
/// false if the kernel cannot tell.
bool has_socket(int sockets, int family, int protocol, std::uint32_t states)
{
    struct Request {
        nlmsghdr header{};
        inet_diag_req_v2 wanted{};
    } request;
    request.header.nlmsg_len = sizeof request;
    request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
    request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
    request.wanted.sdiag_family = static_cast<std::uint8_t>(family);
    request.wanted.sdiag_protocol = static_cast<std::uint8_t>(protocol);
    request.wanted.idiag_states = states;
    if (send(sockets, &request, sizeof request, 0) != static_cast<ssize_t>(sizeof request))
        return false;
    bool has = false;
    alignas(nlmsghdr) std::array<char, 8192> answer{};
    while (true) {
        const auto length = recv(sockets, answer.data(), answer.size(), 0);
        if (length < static_cast<ssize_t>(sizeof(nlmsghdr))) return has;
        for (std::size_t at = 0; at + sizeof(nlmsghdr) <= static_cast<std::size_t>(length);) {
            nlmsghdr header{};
            std::memcpy(&header, answer.data() + at, sizeof header);
            if (header.nlmsg_type == NLMSG_DONE || header.nlmsg_type == NLMSG_ERROR) return has;
            has = true;
            at += NLMSG_ALIGN(std::max<std::size_t>(header.nlmsg_len, sizeof header));
        }
    }
}

} // namespace

void deny_network(int error, const std::string& what)
{
    static const NetworkErrors errors;
    throw std::system_error{error, errors, what};
}

void enter_own_network()
{
    if (geteuid() != 0) {
        const auto user = std::to_string(geteuid());
        const auto group = std::to_string(getegid());
        if (unshare(CLONE_NEWUSER) != 0 ||
            !write_to("/proc/self/uid_map", user + " " + user + " 1") ||
            !write_to("/proc/self/setgroups", "deny") ||
            !write_to("/proc/self/gid_map", group + " " + group + " 1")) {
            deny_network(errno, std::string{user_namespace_cure});
        }
    }
    if (unshare(CLONE_NEWNET) != 0) {
        deny_network(errno,
                     "cannot make a network namespace: a container needs CAP_SYS_ADMIN for it "
                     "(with Docker: --cap-add SYS_ADMIN --cap-add NET_ADMIN), or the right to make "
                     "user namespaces and another user than root");
    }
    write_to("/proc/sys/net/ipv6/conf/default/disable_ipv6", "1");
}

void open_command_network()
{
    if (unshare(CLONE_NEWNET) != 0) deny_network(errno, "cannot make a network namespace");
    // Addresses are usable at once. Ping and the ports below 1024 need no capability.
    write_to("/proc/sys/net/ipv6/conf/default/accept_dad", "0");
    write_to("/proc/sys/net/ipv6/conf/all/accept_dad", "0");
    const auto group = std::to_string(getegid());
    write_to("/proc/sys/net/ipv4/ping_group_range", group + " " + group);
    write_to("/proc/sys/net/ipv4/ip_unprivileged_port_start", "0");
}

bool has_listener(pid_t process)
{
    const int sockets = sockets_of(process);
    if (sockets < 0) return false;
    // The states of listening sockets. In UDP, a bound socket that is not connected has the state
    // TCP_CLOSE.
    constexpr std::uint32_t listens = 1U << 10U; // TCP_LISTEN
    constexpr std::uint32_t is_bound = 1U << 7U; // TCP_CLOSE
    const bool has = has_socket(sockets, AF_INET, IPPROTO_TCP, listens) ||
                     has_socket(sockets, AF_INET6, IPPROTO_TCP, listens) ||
                     has_socket(sockets, AF_INET, IPPROTO_UDP, is_bound) ||
                     has_socket(sockets, AF_INET6, IPPROTO_UDP, is_bound);
    close(sockets);
    return has;
}

} // namespace hapnet::net
