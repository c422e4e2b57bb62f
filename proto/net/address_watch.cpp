// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/address_watch.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// Returns a socket on which the kernel reports each change of an address; -1 if that is forbidden.
int changes_of_addresses()
{
    const int changes = socket(AF_NETLINK, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, NETLINK_ROUTE);
    sockaddr_nl all{};
    all.nl_family = AF_NETLINK;
    all.nl_groups = RTMGRP_IPV4_IFADDR | RTMGRP_IPV6_IFADDR;
    if (changes >= 0 && bind(changes, reinterpret_cast<const sockaddr*>(&all), sizeof all) != 0) {
        close(changes);
        return -1;
    }
    return changes;
}

/// True if a socket can be bound to the address. Errors other than a lost address also count as
/// true.
bool has_address(const Endpoint& local)
{
    const Endpoint place = local.with_port(0);
    const int trial = socket(place.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (trial < 0) return true;
    const bool is_bound = bind(trial, place.address(), place.length()) == 0;
    const bool is_lost = !is_bound && (errno == EADDRNOTAVAIL || errno == ENODEV);
    close(trial);
    return !is_lost;
}

} // namespace

AddressWatch::AddressWatch(const std::vector<Endpoint>& locals) : socket_{changes_of_addresses()}
{
    for (const Endpoint& local : locals) {
        const auto is_same = [&](const Address& known) {
            return known.local.with_port(0) == local.with_port(0);
        };
        if (local.is_any() || std::any_of(watched_.begin(), watched_.end(), is_same)) continue;
        watched_.push_back({local});
    }
}

AddressWatch::~AddressWatch()
{
    if (socket_ >= 0) close(socket_);
}

std::vector<AddressWatch::News> AddressWatch::news()
{
    std::array<char, 4096> message{};
    bool has_changed = false;
    // A queue that overflowed (ENOBUFS) also means a change.
    while (true) {
        const auto count = recv(socket_, message.data(), message.size(), 0);
        if (count < 0 && errno != ENOBUFS) break;
        has_changed = true;
    }
    std::vector<News> news;
    if (!has_changed) return news;
    for (Address& address : watched_) {
        const bool is_lost = !has_address(address.local);
        if (is_lost == address.is_lost) continue;
        address.is_lost = is_lost;
        news.push_back({address.local, is_lost});
    }
    return news;
}

} // namespace hapnet::net
