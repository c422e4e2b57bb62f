// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The format of the files. tests/e2e/mcap tests that other readers accept them.
#include "lab/records/mcap.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace hapnet::lab::records {
namespace {

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size = 8)
{
    std::uint64_t number = 0;
    for (std::size_t i = size; i-- > 0;)
        number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

struct Found {
    std::uint8_t opcode = 0;
    std::size_t begin = 0; // of the record
    std::string_view content{};
};

std::vector<Found> records_in(std::string_view bytes)
{
    std::vector<Found> found;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto size = number_at(bytes, at + 1);
        found.push_back({static_cast<std::uint8_t>(bytes[at]), at, bytes.substr(at + 9, size)});
        at += 9 + size;
    }
    return found;
}

/// Two topics, of which the first has many more messages.
std::string made_file(std::size_t messages)
{
    std::string file;
    McapWriter writer{[&](std::string_view bytes) { file += bytes; }};
    const auto schema = writer.add_schema("a/msg/B", "float64 x");
    const auto one = writer.add_channel(schema, "/one");
    const auto two = writer.add_channel(schema, "/two");
    for (std::size_t i = 0; i < messages; ++i) {
        writer.write(one, 1000 + i, std::string(100, 'x'));
        if (i % 10 == 0) writer.write(two, 1000 + i, "y");
    }
    writer.finish();
    return file;
}

TEST(Mcap, HasRecordsBetweenItsMagicNumbersAndAFooterThatFindsTheSummary)
{
    const auto file = made_file(20'000); // several chunks
    ASSERT_EQ(file.substr(0, 8), magic);
    ASSERT_EQ(file.substr(file.size() - 8), magic);
    const auto inner = std::string_view{file}.substr(8, file.size() - 16);
    const auto all = records_in(inner);
    EXPECT_EQ(all.front().opcode, 0x01);
    EXPECT_EQ(all.back().opcode, 0x02);
    const auto summary = number_at(all.back().content, 0);
    const auto is_summary = [&](const Found& one) { return 8 + one.begin == summary; };
    const auto first = std::find_if(all.begin(), all.end(), is_summary);
    ASSERT_NE(first, all.end());
    EXPECT_EQ(first->opcode, 0x03) << "the schemas again";
    EXPECT_EQ((first - 1)->opcode, 0x0f) << "behind the end of the data";
}

TEST(Mcap, FindsEachMessageByItsIndex)
{
    const auto file = made_file(20'000);
    const auto inner = std::string_view{file}.substr(8, file.size() - 16);
    std::string_view chunk;
    std::size_t chunks = 0;
    std::multiset<std::uint64_t> times;
    for (const Found& one : records_in(inner)) {
        if (one.opcode == 0x06) {
            chunk = one.content.substr(40); // after times, sizes, checksum and compression
            EXPECT_EQ(number_at(one.content, 16), chunk.size());
            ++chunks;
        } else if (one.opcode == 0x07) {
            const auto channel = number_at(one.content, 0, 2);
            for (std::size_t at = 6; at < one.content.size(); at += 16) {
                const auto message = chunk.substr(number_at(one.content, at + 8));
                ASSERT_EQ(message[0], 0x05);
                EXPECT_EQ(number_at(message, 9, 2), channel);
                EXPECT_EQ(number_at(message, 15), number_at(one.content, at)) << "its time";
                times.insert(number_at(message, 15));
            }
        }
    }
    EXPECT_GT(chunks, 1U);
    EXPECT_EQ(times.size(), 22'000U);
    EXPECT_EQ(*times.begin(), 1000U);
    EXPECT_EQ(*times.rbegin(), 20'999U);
}

TEST(Mcap, OfNoMessageIsAFileToo)
{
    const auto file = made_file(0);
    const auto all = records_in(std::string_view{file}.substr(8, file.size() - 16));
    for (const Found& one : all) EXPECT_NE(one.opcode, 0x06);
    EXPECT_EQ(all.back().opcode, 0x02);
}

} // namespace
} // namespace hapnet::lab::records
