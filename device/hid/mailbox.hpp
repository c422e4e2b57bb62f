// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace hapnet::device::hid {

/// An order to the motors and the sender. It fits into 64 bits, so that one thread can pass it to
/// another without a lock. The newest order counts.
struct Order {
    static constexpr double level_full = 32767.0;

    std::array<std::int16_t, 2> levels{}; // in 1/32767 of full scale: right, away from the user
    bool motors_on = false;
    bool is_last = false;    // the effects in the device are freed, too
    std::uint8_t stops = 0;  // counts the requests to stop, each of which is sent
    std::uint8_t probes = 0; // counts the requests to check that a resting device still responds
    std::uint8_t number = 0; // counts the orders with the motors on

    friend bool operator==(const Order&, const Order&) = default;
};

[[nodiscard]] constexpr std::uint64_t packed(const Order& order)
{
    const auto at = [](std::uint64_t value, unsigned shift) { return value << shift; };
    return at(static_cast<std::uint16_t>(order.levels[0]), 0) |
           at(static_cast<std::uint16_t>(order.levels[1]), 16) | at(order.motors_on ? 1U : 0U, 32) |
           at(order.is_last ? 1U : 0U, 33) | at(order.stops, 40) | at(order.probes, 48) |
           at(order.number, 56);
}

[[nodiscard]] constexpr Order unpacked_order(std::uint64_t word)
{
    const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(word >> shift); };
    const auto level = [&](unsigned shift) {
        return static_cast<std::int16_t>(static_cast<std::uint16_t>(word >> shift));
    };
    return {.levels = {level(0), level(16)},
            .motors_on = (byte(32) & 1U) != 0,
            .is_last = (byte(32) & 2U) != 0,
            .stops = byte(40),
            .probes = byte(48),
            .number = byte(56)};
}

/// The results of the orders so far. The counters wrap around.
struct Progress {
    std::uint32_t sent = 0;    // reports that the device accepted
    std::uint32_t refused = 0; // reports that the device did not accept
    bool is_busy = false;      // there is still something to send
    bool is_gone = false;      // the device has gone
};

/// Holds the newest order: the driver of a device stores it, and the sender reads it. Any thread
/// may do either, and none ever waits.
class Mailbox {
public:
    [[nodiscard]] Order order() const { return unpacked_order(order_.load()); }

    /// Applies `change` to the order, atomically.
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

/// Sends the orders in its mailbox, at its own pace. Its destructor sends the last order first, as
/// far as the device accepts it.
class ReportSender {
public:
    ReportSender() = default;
    virtual ~ReportSender() = default;
    ReportSender(const ReportSender&) = delete;
    ReportSender& operator=(const ReportSender&) = delete;

    [[nodiscard]] virtual Mailbox& mailbox() = 0;
    /// Signals a new order. Never waits. May be called from any thread.
    virtual void wake() noexcept = 0;
};

} // namespace hapnet::device::hid
