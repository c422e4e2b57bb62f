// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/warm_up.hpp"

#include <array>
#include <cerrno>
#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

Endpoint bound_to_loopback(int descriptor)
{
    sockaddr_in loopback{};
    loopback.sin_family = AF_INET;
    loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::ignore = bind(descriptor, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback);
    sockaddr_storage address{};
    address.ss_family = AF_INET;
    socklen_t length = sizeof address;
    std::ignore = getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length);
    return Endpoint{address, length};
}

} // namespace

WarmUp::WarmUp()
    : descriptor_{socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)},
      self_{bound_to_loopback(descriptor_)}
{
    if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "socket"};
    sock_filter drop_all{BPF_RET | BPF_K, 0, 0, 0};
    const sock_fprog program{1, &drop_all};
    std::ignore = setsockopt(descriptor_, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program);
}

WarmUp::~WarmUp() { close(descriptor_); }

void WarmUp::run() const
{
    constexpr std::array<char, 64> datagram{};
    std::ignore = sendto(descriptor_, datagram.data(), datagram.size(), MSG_DONTWAIT,
                         self_.address(), self_.length());
}

} // namespace hapnet::net
