// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/descriptor.hpp"
#include "tests/support/hid/pid_descriptor.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::device::hid {
namespace {

using hid_double::bytes_of;

std::string refusal(const std::vector<unsigned>& values)
{
    const auto parsed = parse_descriptor(bytes_of(values));
    return parsed ? "accepted" : parsed.error().message;
}

TEST(Descriptor, OfTheStandardsMouseHasThreeButtonsAndTwoAxesByTheirPlaces)
{
    const auto parsed = parse_descriptor(hid_double::mouse_descriptor());
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_FALSE(parsed->is_numbered);
    EXPECT_EQ(parsed->bytes_of(ReportKind::input, 0), 3U);
    EXPECT_EQ(parsed->collections, (std::vector<Usage>{0x0001'0002, 0x0001'0001}));
    ASSERT_EQ(parsed->fields.size(), 5U);
    for (std::uint32_t button = 0; button < 3; ++button) {
        EXPECT_TRUE(is_variable_of(parsed->fields[button], 0x0009'0001 + button));
        EXPECT_EQ(parsed->fields[button].bit_offset, button);
        EXPECT_EQ(parsed->fields[button].bit_size, 1U);
    }
    const Field y{.bit_offset = 16,
                  .bit_size = 8,
                  .logical_min = -127,
                  .logical_max = 127,
                  .usages = {{0x0001'0031, 0x0001'0031}},
                  .collections = {0x0001'0002, 0x0001'0001}};
    EXPECT_EQ(parsed->fields[4], y);
}

TEST(Descriptor, OfAForceDeviceGivesTheLengthOfEveryReport)
{
    const auto parsed = parse_descriptor(hid_double::pid_descriptor());
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_TRUE(parsed->is_numbered);
    EXPECT_EQ(parsed->bytes_of(ReportKind::input, 0x01), 14U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::input, 0x02), 1U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::output, 0x01), 17U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::output, 0x05), 3U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::output, 0x0a), 3U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::output, 0x0c), 1U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::feature, 0x11), 3U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::feature, 0x12), 4U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::feature, 0x13), 4U);
    EXPECT_EQ(parsed->bytes_of(ReportKind::feature, 0x14), 0U);
}

TEST(Descriptor, KeepsUnitsAndPhysicalRanges)
{
    const auto parsed = parse_descriptor(hid_double::pid_descriptor()).value();
    const auto duration =
        std::find_if(parsed.fields.begin(), parsed.fields.end(),
                     [](const Field& field) { return is_variable_of(field, 0x000f'0050); });
    ASSERT_NE(duration, parsed.fields.end());
    EXPECT_EQ(duration->unit, 0x1003U);
    EXPECT_EQ(duration->unit_exponent, -3);
    EXPECT_EQ(duration->physical_max, 32767);
    EXPECT_EQ(duration->bit_offset, 16U);
    EXPECT_TRUE(lies_in(*duration, 0x000f'0021));
}

TEST(Descriptor, SaysByWhichValueAnArrayMeansAUsage)
{
    const Field array{.logical_min = 1,
                      .logical_max = 4,
                      .is_array = true,
                      .usages = {{10, 10}, {20, 22}, {30, 30}}};
    EXPECT_EQ(value_of(array, 10), 1);
    EXPECT_EQ(value_of(array, 22), 4);
    EXPECT_EQ(value_of(array, 30), std::nullopt); // beyond its range
    EXPECT_EQ(value_of(array, 11), std::nullopt);
}

TEST(Descriptor, TakesAMaximumOfTwoHundredAndFiftyFiveInOneByteForWhatItMeans)
{
    const auto parsed = parse_descriptor(
        bytes_of({0x15, 0x00, 0x25, 0xff, 0x75, 0x08, 0x95, 0x01, 0x09, 0x01, 0x81, 0x02}));
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(parsed->fields.at(0).logical_max, 255);
}

TEST(Descriptor, GivesTheLastUsageToAllValuesThatAreLeft)
{
    const auto parsed = parse_descriptor(bytes_of(
        {0x25, 0x01, 0x75, 0x01, 0x95, 0x04, 0x0b, 1, 0, 9, 0, 0x0b, 2, 0, 9, 0, 0x91, 0x02}));
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_TRUE(is_variable_of(parsed->fields.at(1), 0x0009'0002));
    EXPECT_TRUE(is_variable_of(parsed->fields.at(3), 0x0009'0002));
}

TEST(Descriptor, RestoresWhatWasPushedAndSkipsLongItems)
{
    const auto parsed =
        parse_descriptor(bytes_of({0x75, 0x08, 0x95, 0x01, 0x25, 0x7f, 0xa4, 0x75, 0x10, 0xb4, 0xfe,
                                   0x02, 0x55, 9, 9, 0x81, 0x02}));
    ASSERT_TRUE(parsed.has_value()) << parsed.error().message;
    EXPECT_EQ(parsed->fields.at(0).bit_size, 8U);
}

TEST(Descriptor, IsRefusedWithTheReasonWhereItMakesNoSense)
{
    EXPECT_EQ(refusal({0x05}), "cut off in the middle of an item");
    EXPECT_EQ(refusal({0xfe, 0x05, 0x00, 0x01}), "cut off in the middle of an item");
    EXPECT_EQ(refusal({0xa1, 0x01}), "a collection does not end");
    EXPECT_EQ(refusal({0x05, 0x01, 0xc0}), "byte 2: the end of a collection that never began");
    EXPECT_EQ(refusal({0x85, 0x00}), "byte 0: a report ID is not within 1 to 255");
    EXPECT_EQ(refusal({0xb4}), "byte 0: popped more than was pushed");
    EXPECT_EQ(refusal({0xa4, 0xa4, 0xa4, 0xa4, 0xa4}), "byte 4: pushed too often");
    EXPECT_EQ(refusal({0x0d, 0x00}), "byte 0: an item of a reserved type");
    EXPECT_EQ(refusal({0xa9, 0x01}), "byte 0: delimiters are not understood");
    EXPECT_EQ(refusal({0x29, 0x03}), "byte 0: a range of usages ends that never began");
    EXPECT_EQ(refusal({0x19, 0x04, 0x29, 0x03}), "byte 2: a range of usages runs backwards");
    EXPECT_EQ(refusal({0x15, 0x05, 0x25, 0x04, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02}),
              "byte 8: the logical range runs backwards");
    EXPECT_EQ(refusal({0x75, 0x20, 0x96, 0x00, 0x80, 0x81, 0x02}), "byte 5: a report is too long");
    EXPECT_EQ(refusal({0x75, 0x08, 0x95, 0x01, 0x81, 0x02, 0x85, 0x01}),
              "some reports have a number and some have none");
    EXPECT_EQ(refusal(std::vector<unsigned>(17 * 2, 0xa1)), "byte 32: collections lie too deep");
    EXPECT_EQ(refusal(std::vector<unsigned>(4097, 0x08)), "longer than 4096 bytes");
}

TEST(Descriptor, CutOffAnywhereIsRefusedAndNeverReadBeyondItsEnd)
{
    const auto whole = hid_double::pid_descriptor();
    for (std::size_t size = 1; size < whole.size(); ++size) {
        const std::vector<std::byte> part(whole.begin(),
                                          whole.begin() + static_cast<std::ptrdiff_t>(size));
        const bool says_nothing_yet = size <= 4; // a usage page and a usage
        EXPECT_EQ(parse_descriptor(part).has_value(), says_nothing_yet && size % 2 == 0) << size;
    }
}

} // namespace
} // namespace hapnet::device::hid
