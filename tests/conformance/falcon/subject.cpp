// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/falcon/transport/falcons.hpp"
#include "tests/conformance/falcon/emulated.hpp"

#include <algorithm>

namespace hapnet::conformance {

namespace {

constexpr std::uint8_t centre_button = 0x4;

/// The backend through unmodified libusb.
class FalconSubject final : public Subject {
public:
    FalconSubject() : due_{net::monotonic_now()} {}

    [[nodiscard]] Traits traits() const override { return {.calibrates = true}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::falcon::open_falcon("FALC0001", "");
    }
    [[nodiscard]] base::TimePoint now() override { return net::monotonic_now(); }
    void pass(base::Duration duration) override
    {
        // A late step must not make the next one early.
        due_ = std::max(due_ + duration, net::monotonic_now());
        net::sleep_until(due_);
    }

    void help_calibrate() override
    {
        emulated_.usb.with_model([&] { emulated_.falcon.help_homing(); });
    }
    void press(bool down) override
    {
        emulated_.usb.with_model([&] { emulated_.falcon.press(down ? centre_button : 0); });
    }
    void stall(bool on) override { emulated_.usb.stall(on); }
    void unplug() override { emulated_.usb.unplug(); }
    void plug_in() override { emulated_.usb.plug_in(); }
    void garble(bool on) override
    {
        emulated_.usb.with_model([&] { emulated_.falcon.garble(on); });
    }

    [[nodiscard]] std::vector<Command> commands() const override
    {
        return emulated_.usb.with_model([&] {
            const auto& heard = emulated_.falcon.commands();
            std::vector<Command> commands(heard.size());
            std::transform(heard.begin(), heard.end(), commands.begin(),
                           [](const device::falcon::Command& one) {
                               const bool zero = one.motors == device::falcon::Counts{};
                               return Command{.zero = zero, .motors_on = !zero};
                           });
            return commands;
        });
    }

private:
    mutable EmulatedFalcon emulated_;
    base::TimePoint due_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<FalconSubject>(); }

} // namespace hapnet::conformance
