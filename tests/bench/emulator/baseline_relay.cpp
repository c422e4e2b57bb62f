// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/baseline_relay.hpp"

#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <deque>
#include <netinet/in.h>
#include <optional>
#include <poll.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace hapnet::bench {

namespace {

constexpr std::size_t datagram_bytes_max = 2048;
constexpr int turn_datagrams_max = 64; // datagrams of one socket before it is the other's turn

class Socket {
public:
    explicit Socket(const net::Endpoint& peer)
        : descriptor_{socket(peer.family(), SOCK_DGRAM | SOCK_NONBLOCK, 0)}, peer_{peer}
    {
        const int bytes = 4 << 20;
        setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
        setsockopt(descriptor_, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
        const auto local = net::resolve({"127.0.0.1", 0});
        if (bind(descriptor_, local.address(), local.length()) != 0) {
            throw std::system_error{errno, std::generic_category(), "bind"};
        }
    }

    [[nodiscard]] int descriptor() const { return descriptor_; }

    [[nodiscard]] std::string local() const
    {
        sockaddr_storage address{};
        socklen_t length = sizeof address;
        getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length);
        return net::Endpoint{address, length}.to_text();
    }

    ssize_t receive(std::span<std::byte> buffer) const
    {
        return recv(descriptor_, buffer.data(), buffer.size(), 0);
    }

    void send_to_peer(std::span<const std::byte> bytes) const
    {
        sendto(descriptor_, bytes.data(), bytes.size(), 0, peer_.address(), peer_.length());
    }

private:
    int descriptor_;
    net::Endpoint peer_;
};

class Relay {
public:
    explicit Relay(const BaselineOptions& options)
        : delay_{options.delay}, a_{options.a}, b_{options.b}
    {}

    [[nodiscard]] const Socket& a() const { return a_; }
    [[nodiscard]] const Socket& b() const { return b_; }

    void turn()
    {
        pass(a_, b_);
        pass(b_, a_);
        const auto now = net::monotonic_now();
        while (!heap_.empty() && heap_.front().due <= now) {
            std::pop_heap(heap_.begin(), heap_.end(), leaves_after);
            const Entry entry = heap_.back();
            heap_.pop_back();
            entry.to->send_to_peer({places_[entry.place].bytes.data(), entry.size});
            free_.push_back(entry.place);
        }
    }

    [[nodiscard]] std::optional<base::TimePoint> next_due() const
    {
        return heap_.empty() ? std::nullopt : std::optional{heap_.front().due};
    }

private:
    struct Entry {
        base::TimePoint due;
        std::uint64_t number = 0;
        const Socket* to = nullptr;
        std::size_t place = 0;
        std::size_t size = 0;
    };
    struct Place {
        std::array<std::byte, datagram_bytes_max> bytes;
    };

    static bool leaves_after(const Entry& a, const Entry& b)
    {
        return a.due != b.due ? a.due > b.due : a.number > b.number;
    }

    void pass(const Socket& from, const Socket& to)
    {
        for (int i = 0; i < turn_datagrams_max; ++i) {
            if (free_.empty()) {
                free_.push_back(places_.size());
                places_.emplace_back();
            }
            Place& place = places_[free_.back()];
            const auto size = from.receive(place.bytes);
            if (size < 0) return;
            if (delay_ == base::Duration{0}) {
                to.send_to_peer({place.bytes.data(), static_cast<std::size_t>(size)});
                continue;
            }
            heap_.push_back({net::monotonic_now() + delay_, number_++, &to, free_.back(),
                             static_cast<std::size_t>(size)});
            free_.pop_back();
            std::push_heap(heap_.begin(), heap_.end(), leaves_after);
        }
    }

    base::Duration delay_;
    Socket a_;
    Socket b_;
    std::uint64_t number_ = 0;
    std::vector<Entry> heap_;
    std::deque<Place> places_; // grows without moving its elements
    std::vector<std::size_t> free_;
};

void wait_with_poll(const Relay& relay)
{
    int timeout_ms = -1;
    if (const auto due = relay.next_due()) {
        const auto left = std::max(base::Duration{0}, *due - net::monotonic_now());
        timeout_ms = static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(left).count());
    }
    std::array<pollfd, 2> polled{pollfd{relay.a().descriptor(), POLLIN, 0},
                                 pollfd{relay.b().descriptor(), POLLIN, 0}};
    poll(polled.data(), polled.size(), timeout_ms);
}

class TimerWait {
public:
    explicit TimerWait(const Relay& relay)
    {
        for (const int descriptor : {relay.a().descriptor(), relay.b().descriptor(), timer_}) {
            epoll_event event{};
            event.events = EPOLLIN;
            event.data.fd = descriptor;
            epoll_ctl(epoll_, EPOLL_CTL_ADD, descriptor, &event);
        }
    }

    void wait(const Relay& relay)
    {
        if (const auto due = relay.next_due(); due && !(is_armed_ && *due == armed_)) arm(*due);
        std::array<epoll_event, 3> events{};
        const int count = epoll_wait(epoll_, events.data(), 3, -1);
        for (int i = 0; i < count; ++i) {
            std::uint64_t expirations = 0;
            if (events[static_cast<std::size_t>(i)].data.fd != timer_) continue;
            if (read(timer_, &expirations, sizeof expirations) > 0) is_armed_ = false;
        }
    }

private:
    void arm(base::TimePoint due)
    {
        const auto since_boot = due.time_since_epoch();
        const auto seconds = std::chrono::floor<std::chrono::seconds>(since_boot);
        itimerspec when{};
        when.it_value.tv_sec = seconds.count();
        when.it_value.tv_nsec = (since_boot - seconds).count();
        timerfd_settime(timer_, TFD_TIMER_ABSTIME, &when, nullptr);
        is_armed_ = true;
        armed_ = due;
    }

    int epoll_ = epoll_create1(0);
    int timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
    bool is_armed_ = false;
    base::TimePoint armed_{};
};

} // namespace

void run_baseline(const BaselineOptions& options)
{
    Relay relay{options};
    fmt::print("ready a={} b={}\n", relay.a().local(), relay.b().local());
    std::fflush(stdout);
    TimerWait timer{relay};
    for (;;) {
        if (options.waiting == Waiting::poll) {
            wait_with_poll(relay);
        } else {
            timer.wait(relay);
        }
        relay.turn();
    }
}

} // namespace hapnet::bench
