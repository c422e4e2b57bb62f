// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"
#include "proto/record/header.hpp"
#include "proto/record/reader.hpp"
#include "proto/record/writer.hpp"
#include "tests/support/another_user.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::record {
namespace {

using namespace std::chrono_literals;

const nlohmann::json config{{"peer_id", 1}, {"task", "T1"}, {"tick_ns", 1'000'000}};

/// A path of its own for each test; the file goes with it.
class TemporaryPath {
public:
    TemporaryPath()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::temp_directory_path() /
                ("hapnet_" + std::to_string(::getpid()) + "_" + test->name());
    }
    ~TemporaryPath() { std::filesystem::remove_all(path_); }
    TemporaryPath(const TemporaryPath&) = delete;
    TemporaryPath& operator=(const TemporaryPath&) = delete;

    [[nodiscard]] std::string text() const { return path_.string(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    void fill(const std::string& content) const
    {
        std::ofstream{path_, std::ios::binary} << content;
    }

private:
    std::filesystem::path path_;
};

TickRow tick(std::uint64_t number)
{
    TickRow row;
    row.tick = number;
    row.due = base::TimePoint{number * 1ms};
    return row;
}

TEST(RecordFile, GivesBackRowsOfEachKindInTheOrderWritten)
{
    const TemporaryPath file;
    MessageRow message;
    message.from = 2;
    message.bytes = {std::byte{0}, std::byte{0}, std::byte{9}};
    SessionRow session;
    session.session = 77;
    {
        Writer writer{file.text(), config, Layout::for_messages_of(136)};
        writer.write(tick(1));
        writer.write(session);
        writer.write(message);
        writer.write(tick(2));
    }
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->config, config);
    EXPECT_EQ(record->ticks, (std::vector{tick(1), tick(2)}));
    EXPECT_EQ(record->messages, std::vector{message});
    EXPECT_EQ(record->sessions, std::vector{session});
    EXPECT_EQ(record->ticks_before_session, std::vector<std::size_t>{1});
    EXPECT_FALSE(record->cut_off);
}

TEST(RecordFile, HasOneHeaderLineAndThenNothingButRows)
{
    const TemporaryPath file;
    Writer writer{file.text(), config};
    writer.write(tick(1));
    writer.flush();
    EXPECT_EQ(std::filesystem::file_size(file.path()), header_line(config).size() + 1 + row_bytes);
}

TEST(RecordFile, IsReadableFromTheMomentItIsOpened)
{
    const TemporaryPath file;
    const Writer writer{file.text(), config};
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_TRUE(record->ticks.empty());
}

TEST(RecordFile, LosesOnlyTheLastRowWhenThatIsCutOff)
{
    const TemporaryPath file;
    {
        Writer writer{file.text(), config};
        for (std::uint64_t i = 0; i < 3; ++i) writer.write(tick(i));
    }
    std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 1);
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->ticks, (std::vector{tick(0), tick(1)}));
    EXPECT_TRUE(record->cut_off);
}

TEST(RecordFile, NamesFileAndNumberOfADamagedRow)
{
    const TemporaryPath file;
    file.fill(header_line(config) + "\n" + std::string(2 * row_bytes, '\xff'));
    EXPECT_EQ(read(file.text()).error().message,
              file.text() + ": row 1 is damaged: unknown kind of row 255");
}

TEST(RecordFile, SaysThatAFileOfAnotherKindIsNoRecordAndWhatWasExpected)
{
    const TemporaryPath file;
    for (const std::string content :
         {"", "\n", "tick,hip_x\n", "[1]\n", "{}\n", "7\n", "\"format\"\n",
          "{\"format\":\"hapnet-record\"", "\xff\xfe\n"}) {
        file.fill(content);
        const auto record = read(file.text());
        ASSERT_FALSE(record) << content;
        EXPECT_EQ(record.error().message,
                  file.text() + " is not a record that can be read: expected a JSON line with "
                                "\"format\":\"hapnet-record\"");
    }
}

TEST(RecordFile, DoesNotReadALargeFileWithoutLinesAsOneHeader)
{
    const TemporaryPath file;
    file.fill(std::string(3U << 20U, 'x'));
    EXPECT_FALSE(read(file.text()));
}

TEST(RecordFile, SaysWhichFileIsMissing)
{
    EXPECT_EQ(read("/nonexistent/a.rec").error().message,
              "cannot open /nonexistent/a.rec: No such file or directory");
}

TEST(RecordFile, RefusesAFolder) { EXPECT_FALSE(read("/")); }

TEST(RecordFile, ThrowsWithTheNameOfTheFileThatCannotBeCreated)
{
    try {
        const Writer writer{"/nonexistent/a.rec", config};
        FAIL() << "created a file in a folder that does not exist";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
        EXPECT_NE(std::string{error.what()}.find("/nonexistent/a.rec"), std::string::npos);
    }
}

TEST(RecordFile, BelongsToOneWriterAtATimeAndIsNotEmptiedByAnother)
{
    const TemporaryPath path;
    Writer writer{path.text(), config};
    writer.write(TickRow{});
    writer.flush();
    EXPECT_THROW(Writer(path.text(), config), std::system_error);
    EXPECT_EQ(read(path.text()).value().ticks.size(), 1U);
}

TEST(RecordFile, ThrowsWhenTheDiskIsFull)
{
    EXPECT_THROW(Writer("/dev/full", config), std::system_error);
}

TEST(RecordFile, EndsWithTheLastWholeRowOnADiskThatFillsUpAndKnowsHowManyItHas)
{
    const TemporaryPath file;
    std::signal(SIGXFSZ, SIG_IGN); // a file that is too long stands for a full disk
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 30'000;
    std::uint64_t rows = 0;
    {
        Writer writer{file.text(), config};
        EXPECT_EQ(writer.rows(), 0U);
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        const auto write = [&] {
            for (std::uint64_t i = 0; i < 1000; ++i) writer.write(tick(i));
        };
        EXPECT_THROW(write(), std::system_error);
        rows = writer.rows();
    }
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(rows, (30'000 - header_line(config).size() - 1) / row_bytes);
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->ticks.size(), rows);
    EXPECT_FALSE(record->cut_off);
}

TEST(RecordFile, DoesNotEmptyAFileThatHasAnotherNameBesides)
{
    const TemporaryPath file;
    const std::string victim = file.text() + "-victim";
    std::ofstream{victim} << "old";
    std::filesystem::create_hard_link(victim, file.path());
    EXPECT_THROW(Writer(file.text(), config), std::system_error);
    EXPECT_EQ(std::filesystem::file_size(victim), 3U);
    std::filesystem::remove(victim);
}

TEST(RecordFile, DoesNotFollowALinkOfAnotherUser)
{
    if (!test::is_root()) GTEST_SKIP() << "only root can make a link of another user";
    const TemporaryPath file;
    const std::string victim = file.text() + "-victim";
    std::ofstream{victim} << "old";
    std::filesystem::create_symlink(victim, file.path());
    ASSERT_EQ(lchown(file.text().c_str(), test::another_user, test::another_user), 0);
    EXPECT_THROW(Writer(file.text(), config), std::system_error);
    EXPECT_EQ(std::filesystem::file_size(victim), 3U);
    ASSERT_EQ(lchown(file.text().c_str(), 0, 0), 0);
    EXPECT_NO_THROW(Writer(file.text(), config)) << "one's own";
    EXPECT_TRUE(read(victim));
    std::filesystem::remove(victim);
}

TEST(RecordHeader, DescribesEveryFieldWithItsTypeOffsetAndUnit)
{
    const auto header = nlohmann::json::parse(header_line(config));
    EXPECT_EQ(header["format"], "hapnet-record");
    EXPECT_EQ(header["row_bytes"], row_bytes);
    EXPECT_EQ(header["message_row_bytes"], 859);
    EXPECT_EQ(header["version"], 3);
    EXPECT_FALSE(header.contains("body_row_bytes")) << "one body that does not turn has no rows";
    EXPECT_EQ(header["schema"].size(), 3U);
    const auto& fields = header["schema"]["tick"]["fields"];
    ASSERT_EQ(fields.size(), 24);
    EXPECT_EQ(fields[1],
              nlohmann::json::parse(
                  R"({"name":"due","type":"i64","offset":9,"unit":"ns of CLOCK_BOOTTIME"})"));
    EXPECT_EQ(fields[15], nlohmann::json::parse(
                              R"({"name":"remote","type":"f64[3]","offset":181,"unit":"N"})"));
    EXPECT_EQ(fields[5]["values"][3], "hands_off");
    EXPECT_EQ(header["schema"]["message"]["kind"], 2);
}

TEST(RecordHeader, RefusesAnotherVersionRowSizeOrSchema)
{
    const auto ours = nlohmann::json::parse(header_line(config));
    auto other = ours;
    other["version"] = 1;
    EXPECT_EQ(parse_header(other.dump()).error().message,
              "it is of version 1, and this program reads versions 2 to 5: use the hapnet-lab of "
              "the release that wrote it");
    for (const int version : {4, 5, 6}) { // 4 and 5 without their rows of bodies, and one to come
        other["version"] = version;
        EXPECT_FALSE(parse_header(other.dump())) << version;
    }
    other = ours;
    other["row_bytes"] = 200;
    EXPECT_EQ(parse_header(other.dump()).error().message,
              "expected a JSON line with \"row_bytes\":216");
    other = ours;
    other["schema"]["tick"]["fields"][0]["offset"] = 2;
    EXPECT_EQ(parse_header(other.dump()).error().message, "its schema is not that of version 3");
    other = ours; // in other words for people
    other["schema"]["tick"]["fields"][1]["unit"] = "ns of CLOCK_MONOTONIC";
    EXPECT_TRUE(parse_header(other.dump()));
    other = ours;
    other["schema"]["tick"]["fields"] = 1;
    EXPECT_FALSE(parse_header(other.dump()));
    other = ours;
    other["message_row_bytes"] = 860;
    EXPECT_EQ(parse_header(other.dump()).error().message,
              "\"message_row_bytes\" is not from 21 to 859");
    other.erase("message_row_bytes");
    EXPECT_FALSE(parse_header(other.dump()));
    other = ours;
    other["config"] = 1;
    EXPECT_FALSE(parse_header(other.dump()));
    EXPECT_TRUE(parse_header(ours.dump()));
}

TEST(RecordFile, OfSeveralBodiesHasARowForEachOfThemAndTheirLayout)
{
    const TemporaryPath file;
    const std::vector<BodyRow> bodies{
        {.tick = 1, .body = 0}, {.tick = 1, .body = 3}, {.tick = 2, .body = 0}};
    {
        Writer writer{file.text(), config, Layout{}.with_bodies()};
        writer.write(tick(1));
        writer.write(bodies[0]);
        writer.write(bodies[1]);
        writer.write(tick(2));
        writer.write(bodies[2]);
    }
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->ticks.size(), 2U);
    EXPECT_EQ(record->bodies, bodies);
    const auto header = nlohmann::json::parse(header_line(config, Layout{}.with_bodies()));
    EXPECT_EQ(header["version"], 5);
    EXPECT_EQ(header["body_row_bytes"], 117);
    EXPECT_EQ(header["schema"]["body"]["fields"][4],
              nlohmann::json::parse(R"({"name":"orientation","type":"f64[4]","offset":59})"));
}

TEST(RecordFile, RefusesBodiesWhoseTicksGoBack)
{
    const TemporaryPath file;
    {
        Writer writer{file.text(), config, Layout{}.with_bodies()};
        writer.write(BodyRow{.tick = 2});
        writer.write(BodyRow{.tick = 1});
    }
    EXPECT_EQ(read(file.text()).error().message,
              file.text() + ": row 2 is damaged: a body row of tick 1 after one of tick 2");
}

TEST(RecordFile, OfVersion4IsStillReadAndItsBodiesHaveNoOwner)
{
    const TemporaryPath file;
    const BodyRow body{.tick = 1, .body = 3, .owner = 2};
    {
        Writer writer{file.text(), config, Layout::of_version_4()};
        writer.write(tick(1));
        writer.write(body);
    }
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->bodies, (std::vector<BodyRow>{{.tick = 1, .body = 3}}));
    const auto header = nlohmann::json::parse(header_line(config, Layout::of_version_4()));
    EXPECT_EQ(header["body_row_bytes"], 115);
    EXPECT_EQ(header["schema"]["body"]["fields"].size(), 6U);
}

TEST(RecordFile, OfVersion2IsStillRead)
{
    const TemporaryPath file;
    const auto layout = Layout::of_version_2();
    MessageRow message;
    message.bytes.resize(150);
    nlohmann::json header{{"format", "hapnet-record"}, {"version", 2},     {"row_bytes", 216},
                          {"byte_order", "little"},    {"config", config}, {"schema", 1}};
    std::string content = header.dump() + "\n";
    for (const Row& row : {Row{tick(0)}, Row{message}, Row{SessionRow{.session = 5}}}) {
        const RowBytes bytes = encode(row, layout);
        content.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    file.fill(content);
    const auto record = read(file.text());
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_EQ(record->messages, std::vector{message});
    EXPECT_EQ(record->sessions.at(0).session, 5U);
    EXPECT_EQ(record->ticks.size(), 1U);
}

TEST(RecordHeader, IsOneLineOfUtf8WhateverTheConfigurationSays)
{
    const auto line = header_line({{"scene", "a\nb\xff"}});
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_TRUE(line.starts_with(R"({"format":"hapnet-record","version":3,)"));
    EXPECT_TRUE(parse_header(line));
}

} // namespace
} // namespace hapnet::record
