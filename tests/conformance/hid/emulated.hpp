// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "tests/support/hid/fake_pid.hpp"
#include "tests/support/umockdev/hidraw_device.hpp"

#include <utility>

namespace hapnet::conformance {

/// A fake PID device behind hidraw. It moves and sends reports only when pass() is called.
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
    /// Lets time pass. The device reports its place at the end.
    void pass(base::Duration duration)
    {
        auto report = with([&](hid_double::FakePid& pid) {
            pid.pass(base::to_seconds(duration));
            return pid.input_report();
        });
        if (garbles_) report.resize(report.size() / 2);
        hidraw_.say(std::move(report));
    }
    /// Truncates the reports of the device.
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

    hid_double::FakePid pid_;
    bool garbles_ = false;
    umockdev::HidrawDevice hidraw_;
};

} // namespace hapnet::conformance
