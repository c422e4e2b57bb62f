// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/clock.hpp"
#include "tests/support/hid/fake_pid.hpp"
#include "tests/support/umockdev/hidraw_device.hpp"

#include <atomic>
#include <thread>
#include <utility>

namespace hapnet::conformance {

/// Somebody who does something once a millisecond, of real time, until this ends.
class Rhythm {
public:
    template <typename Beat>
    explicit Rhythm(Beat beat)
        : thread_{[this, beat = std::move(beat)]() mutable {
              base::TimePoint last = net::monotonic_now();
              while (!ends_) {
                  net::sleep_until(last + std::chrono::milliseconds{1});
                  const base::TimePoint now = net::monotonic_now();
                  beat(now - std::exchange(last, now));
              }
          }}
    {}
    ~Rhythm()
    {
        ends_ = true;
        thread_.join();
    }
    Rhythm(const Rhythm&) = delete;
    Rhythm& operator=(const Rhythm&) = delete;

private:
    std::atomic<bool> ends_{false};
    std::thread thread_;
};

/// A fake PID device behind hidraw: it moves and speaks in real time.
class EmulatedPid final : private umockdev::HidModel {
public:
    explicit EmulatedPid(umockdev::Testbed& testbed, int number = 0)
        : hidraw_{testbed, description(number), *this}
    {}

    [[nodiscard]] umockdev::HidrawDevice& hidraw() { return hidraw_; }
    /// Looks at or changes the device between two of its steps.
    template <typename Action>
    auto with(Action action)
    {
        return hidraw_.with_model([&] { return action(pid_); });
    }
    /// Of its reports only a part arrives, and what does not belong there.
    void garble(bool on) { garbles_ = on; }

    static umockdev::HidDescription description(int number)
    {
        return {.vendor = 0x1209,
                .product = 0xffb0,
                .name = "Force Board",
                .serial = number == 0 ? "FFB0001" : "",
                .report_descriptor = hid_double::pid_descriptor(),
                .number = number};
    }

private:
    void on_output(std::span<const std::byte> report) override { pid_.on_output(report); }
    void on_feature(std::span<const std::byte> report) override { pid_.on_feature(report); }
    std::optional<std::vector<std::byte>> feature(std::uint8_t id) override
    {
        return pid_.feature(id);
    }

    void beat(base::Duration passed)
    {
        auto report = with([&](hid_double::FakePid& pid) {
            pid.pass(base::to_seconds(passed));
            return pid.input_report();
        });
        if (garbles_) report.resize(report.size() / 2);
        hidraw_.say(std::move(report));
    }

    hid_double::FakePid pid_;
    std::atomic<bool> garbles_{false};
    umockdev::HidrawDevice hidraw_;
    Rhythm rhythm_{[this](base::Duration passed) { beat(passed); }};
};

} // namespace hapnet::conformance
