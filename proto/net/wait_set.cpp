// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/wait_set.hpp"

#include <cerrno>
#include <sys/epoll.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::net {

namespace {

void control(int set, int operation, int descriptor, epoll_event event)
{
    if (epoll_ctl(set, operation, descriptor, &event) == 0) return;
    throw std::system_error{errno, std::generic_category(), "epoll_ctl"};
}

epoll_event event_of(std::uint64_t key, WaitSet::Interest interest)
{
    epoll_event event{};
    if (interest.to_read) event.events |= EPOLLIN;
    if (interest.to_write) event.events |= EPOLLOUT;
    event.data.u64 = key;
    return event;
}

} // namespace

WaitSet::WaitSet() : descriptor_{epoll_create1(EPOLL_CLOEXEC)}
{
    if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "epoll_create1"};
}

WaitSet::~WaitSet() { close(descriptor_); }

void WaitSet::add(int descriptor, std::uint64_t key, Interest interest)
{
    control(descriptor_, EPOLL_CTL_ADD, descriptor, event_of(key, interest));
}

void WaitSet::change(int descriptor, std::uint64_t key, Interest interest)
{
    control(descriptor_, EPOLL_CTL_MOD, descriptor, event_of(key, interest));
}

std::span<const Ready> WaitSet::ready()
{
    std::array<epoll_event, batch_max> events{};
    const int count = epoll_wait(descriptor_, events.data(), static_cast<int>(batch_max), 0);
    const auto found = count < 0 ? 0 : static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < found; ++i) {
        const auto what = events[i].events;
        ready_[i] = {.key = events[i].data.u64,
                     .is_readable = (what & EPOLLIN) != 0,
                     .is_writable = (what & EPOLLOUT) != 0,
                     .is_gone = (what & (EPOLLHUP | EPOLLERR)) != 0};
    }
    return std::span{ready_}.first(found);
}

} // namespace hapnet::net
