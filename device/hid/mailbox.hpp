// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/order.hpp"

#include <atomic>
#include <cstdint>

namespace hapnet::device::hid {

/// What came of the orders so far: each counts on and begins again at 0.
struct Progress {
    std::uint32_t sent = 0;    // reports that the device took
    std::uint32_t refused = 0; // ... and that it did not
    bool is_busy = false;      // there is still something to send
    bool is_gone = false;      // the device
};

/// Where whoever drives a device leaves the newest order, and the one who sends it takes it. Any
/// thread may do either; nobody ever waits.
class Mailbox {
public:
    [[nodiscard]] Order order() const { return unpacked_order(order_.load()); }

    /// Makes the order what `change` makes of it.
    template <typename Change>
    void update(Change change)
    {
        std::uint64_t before = order_.load();
        while (true) {
            Order order = unpacked_order(before);
            change(order);
            if (order_.compare_exchange_weak(before, packed(order))) return;
        }
    }

    void count_sent() { ++sent_; }
    void count_refused() { ++refused_; }
    void say_gone() { is_gone_ = true; }
    void say_done(const Order& order) { done_ = packed(order); }

    [[nodiscard]] Progress progress() const
    {
        return {.sent = sent_,
                .refused = refused_,
                .is_busy = order_.load() != done_.load(),
                .is_gone = is_gone_};
    }

private:
    std::atomic<std::uint64_t> order_{0};
    std::atomic<std::uint64_t> done_{0};
    std::atomic<std::uint32_t> sent_{0};
    std::atomic<std::uint32_t> refused_{0};
    std::atomic<bool> is_gone_{false};
};

/// Sends what is left in its mailbox, in its own time. Its end is orderly: it sends the last order
/// first, as far as the device takes it.
class Outbox {
public:
    Outbox() = default;
    virtual ~Outbox() = default;
    Outbox(const Outbox&) = delete;
    Outbox& operator=(const Outbox&) = delete;

    [[nodiscard]] virtual Mailbox& mailbox() = 0;
    /// There is a new order. Never waits; from any thread.
    virtual void wake() noexcept = 0;
};

} // namespace hapnet::device::hid
