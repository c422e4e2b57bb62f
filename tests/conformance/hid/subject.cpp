// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/hid/transport/hids.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/hid/emulated.hpp"

#include <algorithm>
#include <iterator>

namespace hapnet::conformance {

namespace {

constexpr base::Duration step{std::chrono::milliseconds{1}};

/// A fake PID device under unmodified hidapi.
class PidSubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return {}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::hid::open_hid("", {.force_full_n = hid_double::FakePid::force_full_n});
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override
    {
        // The device's time is virtual, so a tick is never late. But its library and the thread
        // that writes to it get at least as much real time.
        const base::TimePoint due = net::monotonic_now() + duration;
        for (base::Duration left = duration; left > base::Duration{0}; left -= step) {
            pid_.pass(std::min(left, step));
        }
        now_ += duration;
        net::sleep_until(due);
    }
    void press(bool down) override
    {
        pid_.with([&](hid_double::FakePid& pid) { pid.press(down); });
    }
    void stall(bool on) override { pid_.hidraw().stall(on); }
    void unplug() override { pid_.hidraw().unplug(); }
    void plug_in() override
    {
        pid_.with([](hid_double::FakePid& pid) { pid.power_up(); });
        pid_.hidraw().plug_in();
    }
    void garble(bool on) override { pid_.garble(on); }
    [[nodiscard]] std::vector<Command> commands() const override
    {
        std::vector<Command> commands;
        pid_.with([&](const hid_double::FakePid& pid) {
            std::transform(pid.pushes().begin(), pid.pushes().end(), std::back_inserter(commands),
                           [](const hid_double::Push& push) {
                               return Command{push.is_zero(), push.motors_on};
                           });
        });
        return commands;
    }

private:
    umockdev::Testbed testbed_;
    mutable EmulatedPid pid_{testbed_};
    base::TimePoint now_{std::chrono::seconds{1000}};
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<PidSubject>(); }

} // namespace hapnet::conformance
