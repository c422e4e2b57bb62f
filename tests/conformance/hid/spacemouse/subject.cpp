// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/hid/transport/hids.hpp"
#include "proto/net/clock.hpp"
#include "tests/support/hid/pid_descriptor.hpp"
#include "tests/support/umockdev/hidraw_device.hpp"

#include <gtest/gtest.h>

namespace hapnet::conformance {

namespace {

using hid_double::bytes_of;

constexpr base::Duration report_every{std::chrono::milliseconds{8}};
constexpr int deflection = 100;

/// A cap that a person pushes to the right and back, every tenth of a second.
class FakeSpaceMouse final : public umockdev::HidModel {
public:
    void on_output(std::span<const std::byte> /*report*/) override {}
    void on_feature(std::span<const std::byte> /*report*/) override {}
    std::optional<std::vector<std::byte>> feature(std::uint8_t /*id*/) override { return {}; }
};

/// A fake SpaceMouse under unmodified hidapi.
class SpaceMouseSubject final : public Subject {
public:
    // The device is silent at rest, so a stall cannot be told from rest, and moves nothing.
    [[nodiscard]] Traits traits() const override { return {.has_motors = false, .stalls = false}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::hid::open_hid("", {});
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override
    {
        now_ += duration;
        if (now_ < next_report_) return;
        next_report_ = now_ + report_every;
        ++reports_;
        const bool goes_right = reports_ / 12 % 2 == 0;
        const auto x = static_cast<unsigned>(goes_right ? deflection : 65536 - deflection);
        auto report = bytes_of({1, x & 0xffU, x >> 8U, 0, 0, 0, 0});
        if (garbles_) report.resize(3);
        hidraw_.say(std::move(report));
    }
    void press(bool down) override { hidraw_.say(bytes_of({3, down ? 1U : 0U, 0})); }
    void unplug() override { hidraw_.unplug(); }
    void plug_in() override { hidraw_.plug_in(); }
    void garble(bool on) override { garbles_ = on; }
    [[nodiscard]] std::vector<Command> commands() const override { return {}; }

private:
    umockdev::Testbed testbed_;
    FakeSpaceMouse model_;
    umockdev::HidrawDevice hidraw_{testbed_,
                                   {.vendor = 0x046d,
                                    .product = 0xc626,
                                    .name = "3Dconnexion SpaceNavigator",
                                    .serial = "",
                                    .report_descriptor = hid_double::spacemouse_descriptor(),
                                    .number = 0},
                                   model_};
    base::TimePoint now_{std::chrono::seconds{1000}};
    base::TimePoint next_report_{};
    int reports_ = 0;
    bool garbles_ = false;
};

TEST(SpaceMouse, IsFoundByTheNameOfItsModelAndItsNode)
{
    SpaceMouseSubject subject;
    const auto found = device::hid::find_hids({});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].identity.model, "SpaceNavigator (SpaceMouse, input only)");
    EXPECT_EQ(found[0].identity.serial, "hidraw0");
    EXPECT_EQ(found[0].identity.note, "never run on the physical device");
    EXPECT_FALSE(found[0].unusable.has_value());
}

TEST(SpaceMouse, MovesWhereItsCapIsPushed)
{
    SpaceMouseSubject subject;
    const auto device = subject.open().value();
    device::Sample sample;
    for (int i = 0; i < 80; ++i) {
        subject.pass(std::chrono::milliseconds{1});
        sample = device->read(subject.now());
    }
    // 79 ms at 100/350 of 0.1 m/s. The first millisecond only receives the push.
    EXPECT_NEAR(sample.hip.x(), 0.079 * 0.1 * 100 / 350, 1e-9);
}

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<SpaceMouseSubject>(); }

} // namespace hapnet::conformance
