// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_opening.hpp"
#include "device/hid/pid_reports.hpp"
#include "device/hid/recognise.hpp"
#include "device/hid/usages.hpp"
#include "tests/support/hid/memory_pid.hpp"
#include "tests/unit/device/hid/pid_layouts.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::device::hid {
namespace {

using hid_double::bytes_of;
using hid_double::FakePid;
using hid_double::Line;
using hid_double::MemoryWire;
using hid_double::ReportIds;

/// The descriptor with every occurrence of an item replaced by another of the same length.
std::vector<std::byte> with(const std::vector<unsigned>& item, const std::vector<unsigned>& other)
{
    auto all = hid_double::pid_descriptor();
    const auto from = bytes_of(item);
    const auto to = bytes_of(other);
    auto at = std::search(all.begin(), all.end(), from.begin(), from.end());
    EXPECT_NE(at, all.end());
    for (; at != all.end(); at = std::search(at, all.end(), from.begin(), from.end())) {
        at = std::copy(to.begin(), to.end(), at);
    }
    return all;
}

std::string what_is_missing(const std::vector<unsigned>& item, const std::vector<unsigned>& other)
{
    const auto found = find_force(parse_descriptor(with(item, other)).value());
    return found ? "nothing" : found.error().message;
}

TEST(PidReports, HaveTheBytesOfTheDevicesOwnDescription)
{
    const ForceLayout layout = layout_of({});
    // Block 7, constant force, 100 ms, full gain, direction enabled: 270 degrees.
    EXPECT_EQ(bytes(set_effect_report(layout, 7, Axis::right)),
              bytes_of({0x01, 7, 1, 100, 0, 0, 0, 0, 0, 0, 0, 255, 0, 4, 0x78, 0x69, 0, 0}));
    // ... 180 degrees.
    EXPECT_EQ(bytes(set_effect_report(layout, 7, Axis::away)),
              bytes_of({0x01, 7, 1, 100, 0, 0, 0, 0, 0, 0, 0, 255, 0, 4, 0x50, 0x46, 0, 0}));
    EXPECT_EQ(bytes(level_report(layout, 2, -0.5)), bytes_of({0x05, 2, 0x00, 0xc0}));
    EXPECT_EQ(bytes(level_report(layout, 2, 1.0)), bytes_of({0x05, 2, 0xff, 0x7f}));
    EXPECT_EQ(bytes(operation_report(layout, 3, usage::effect_start)), bytes_of({0x0a, 3, 1, 1}));
    EXPECT_EQ(bytes(operation_report(layout, 3, usage::effect_stop)), bytes_of({0x0a, 3, 3, 1}));
    EXPECT_EQ(bytes(control_report(layout, usage::enable_actuators)), bytes_of({0x0c, 0x01}));
    EXPECT_EQ(bytes(control_report(layout, usage::disable_actuators)), bytes_of({0x0c, 0x02}));
    EXPECT_EQ(bytes(control_report(layout, usage::stop_all_effects)), bytes_of({0x0c, 0x04}));
    EXPECT_EQ(bytes(control_report(layout, usage::device_reset)), bytes_of({0x0c, 0x08}));
    EXPECT_EQ(bytes(gain_report(layout).value()), bytes_of({0x0d, 255}));
    EXPECT_EQ(bytes(create_report(layout)), bytes_of({0x11, 1, 0, 0}));
    EXPECT_EQ(bytes(free_report(layout, 3).value()), bytes_of({0x0b, 3}));
}

TEST(PidReports, TakeTheirNumbersFromTheDescriptor)
{
    const ForceLayout layout = layout_of({.moved = 0x20});
    EXPECT_EQ(bytes(level_report(layout, 2, 1.0)), bytes_of({0x25, 2, 0xff, 0x7f}));
    EXPECT_EQ(bytes(control_report(layout, usage::enable_actuators)), bytes_of({0x2c, 0x01}));
}

TEST(PidReports, ReadWhereAnEffectHasBeenPlaced)
{
    const ForceLayout layout = layout_of({});
    const auto loaded = [&](unsigned block, unsigned status) {
        Report answer{layout.block_load.place};
        answer.data()[0] = static_cast<std::byte>(block);
        answer.data()[1] = static_cast<std::byte>(status);
        return read_block_load(layout, answer);
    };
    EXPECT_EQ(loaded(5, 1).load, Load::success);
    EXPECT_EQ(loaded(5, 1).block, 5U);
    EXPECT_EQ(loaded(0, 2).load, Load::full);
    EXPECT_EQ(loaded(5, 3).load, Load::error);
    EXPECT_EQ(loaded(5, 0).load, Load::error);
    EXPECT_EQ(loaded(0, 1).load, Load::error);
    EXPECT_EQ(loaded(41, 1).load, Load::error);
}

TEST(PidLayout, NamesWhatAConstantForceWouldNeed)
{
    EXPECT_EQ(what_is_missing({0x09, 0x70}, {0x09, 0x71}),
              "its Set Constant Force report has no magnitude");
    EXPECT_EQ(what_is_missing({0x09, 0x56}, {0x09, 0x02}),
              "its Set Effect report has no direction enable");
    EXPECT_EQ(what_is_missing({0x09, 0x99}, {0x09, 0x02}),
              "its Device Control report has no enable, disable, stop and reset");
    EXPECT_EQ(what_is_missing({0x09, 0x89}, {0x09, 0x02}),
              "its Block Load report has no effect block index");
    EXPECT_EQ(what_is_missing({0x16, 0x01, 0x80, 0x26, 0xff, 0x7f, 0x75, 0x10, 0x95, 0x01},
                              {0x16, 0x00, 0x00, 0x26, 0xff, 0x7f, 0x75, 0x10, 0x95, 0x01}),
              "its constant forces have no sign");
    EXPECT_EQ(what_is_missing({0x09, 0x7f}, {0x09, 0x02}), "nothing"); // a Pool is not needed
}

TEST(PidLayout, LeavesOutAnAxisYThatNoEffectPlaysOnAsThatOfAPedal)
{
    const auto axes = [](const std::vector<std::byte>& descriptor) {
        return find_input(parse_descriptor(descriptor).value()).value().axes.size();
    };
    EXPECT_EQ(axes(hid_double::pid_descriptor()), 2U);
    EXPECT_EQ(axes(with({0x09, 0x30, 0x09, 0x31, 0x15}, {0x09, 0x30, 0x09, 0x32, 0x15})), 1U);
}

TEST(RecognisedDevice,
     AForceDeviceIsKnownByItsDescriptionAndASpaceMouseByItsIdentityAndNothingElseIs)
{
    const auto seen = [](std::uint16_t vendor, std::uint16_t product, std::vector<std::byte> d) {
        return recognise({.path = "/dev/hidraw3",
                          .vendor = vendor,
                          .product = product,
                          .serial = "",
                          .name = "Board",
                          .descriptor = std::move(d)});
    };
    const auto board = seen(0x1209, 0xffb0, hid_double::pid_descriptor());
    ASSERT_TRUE(board && board->force);
    EXPECT_EQ(board->serial, "hidraw3");
    EXPECT_EQ(identity_of(*board, {}).note,
              "never run on the physical device; no force until --hid-force says what full scale "
              "is at the grip");
    EXPECT_EQ(identity_of(*board, {.force_full_n = 8.0}).note, "never run on the physical device");
    EXPECT_FALSE(seen(0x046d, 0xc077, hid_double::mouse_descriptor()));
    EXPECT_FALSE(seen(0x1209, 0xffb0, bytes_of({0x05})));
    ASSERT_TRUE(seen(0x046d, 0xc626, hid_double::spacemouse_descriptor()));
    EXPECT_TRUE(seen(0x046d, 0xc626, hid_double::spacemouse_descriptor())->is_spacemouse);
    EXPECT_FALSE(seen(0x256f, 0xc652, hid_double::mouse_descriptor())); // a receiver's other node
    EXPECT_FALSE(seen(0x1234, 0x5678, hid_double::spacemouse_descriptor()));
    const auto weak = seen(1, 2, with({0x09, 0x70}, {0x09, 0x71}));
    ASSERT_TRUE(weak && !weak->force);
    EXPECT_EQ(identity_of(*weak, {.force_full_n = 8.0}).note,
              "never run on the physical device; no force: its Set Constant Force report has no "
              "magnitude");
    const auto blind = seen(1, 2, with({0x09, 0x30}, {0x09, 0x3f}));
    ASSERT_TRUE(blind && blind->unusable);
}

TEST(PidOpening, LeavesTwoEffectsWithoutForceAndTheActuatorsDisabled)
{
    Line line;
    MemoryWire wire{line};
    const auto prepared = prepare(wire, layout_of({}), 2);
    ASSERT_TRUE(prepared.has_value()) << prepared.error().message;
    EXPECT_EQ(prepared->blocks, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(line.pid.gain(), 255);
    EXPECT_EQ(line.pid.starts(), 0U);
    EXPECT_FALSE(line.pid.push().motors_on);
    for (const auto& push : line.pid.pushes()) EXPECT_TRUE(push.is_zero());
}

TEST(PidOpening, SaysWhyItFailedAndLeavesNothingBehind)
{
    Line line;
    MemoryWire wire{line};
    line.pid.limit_places(1);
    const auto full = prepare(wire, layout_of({}), 2);
    ASSERT_FALSE(full.has_value());
    EXPECT_EQ(full.error().fault, Fault::in_use);
    EXPECT_EQ(line.pid.places_taken(), 0U);
    EXPECT_FALSE(line.pid.push().motors_on);

    line.pid.limit_places(40);
    line.pid.refuse_effects();
    EXPECT_EQ(prepare(wire, layout_of({}), 2).error().fault, Fault::communication);
    line.refuses = true;
    EXPECT_EQ(prepare(wire, layout_of({}), 2).error().fault, Fault::communication);
    line.is_gone = true;
    EXPECT_EQ(prepare(wire, layout_of({}), 2).error().fault, Fault::disconnected);
}

TEST(PidOpening, OfAWheelLoadsOneEffectAndItsSenderSpeaksOfNoOther)
{
    Line line;
    MemoryWire wire{line};
    const auto prepared = prepare(wire, layout_of({}), 1);
    ASSERT_TRUE(prepared.has_value());
    EXPECT_EQ(line.pid.places_taken(), 1U);
    PidSender sender{layout_of({}), prepared->blocks};
    const Order order{.levels = {5, 7}, .motors_on = true, .number = 1};
    std::size_t reports = 0;
    while (sender.next(order)) ++reports;
    EXPECT_EQ(reports, 3U); // enable, force, start
}

TEST(PidOpening, AsksADeviceThatAnswersNothingOnlyThreeTimes)
{
    Line line;
    line.is_mute = true;
    MemoryWire wire{line};
    EXPECT_EQ(prepare(wire, layout_of({}), 2).error().fault, Fault::communication);
    EXPECT_EQ(line.questions, 3U);
}

} // namespace
} // namespace hapnet::device::hid
