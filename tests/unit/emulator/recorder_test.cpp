// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/recorder.hpp"

#include "emulator/core/fates/fates.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/descriptor.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <tuple>
#include <unistd.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

/// A folder for each test, removed with it.
class RecorderFiles : public testing::Test {
protected:
    RecorderFiles() { std::filesystem::create_directory(folder_); }
    ~RecorderFiles() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string text(const std::string& name) const
    {
        std::ifstream file{path(name), std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    [[nodiscard]] std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator{folder_}) {
            names.push_back(entry.path().filename());
        }
        return names;
    }

private:
    std::filesystem::path folder_ =
        std::filesystem::path{testing::TempDir()} / ("hapnet-recorder-" + std::to_string(getpid()));
};

Fate fate_of(std::uint64_t number)
{
    if (number % 3 == 0) return {.drop = DropCause::random_loss};
    return {.delay = number * 1us};
}

TEST_F(RecorderFiles, OfFatesHoldAllOfUpAndThenAllOfDownHoweverTheyCame)
{
    Fates expected;
    Recorder recorder{{path("fates.csv"), {}}};
    for (std::uint64_t n = 0; n < 20'000; ++n) {
        recorder.lane().on_fate(0, Direction::down, n, fate_of(n));
        recorder.lane().on_fate(0, Direction::up, n, fate_of(n + 1));
        expected.down.push_back(fate_of(n));
        expected.up.push_back(fate_of(n + 1));
    }
    EXPECT_EQ(recorder.fates_lost(), 0U);
    recorder.finish();
    EXPECT_EQ(text("fates.csv"), to_text(expected));
    EXPECT_EQ(names(), std::vector<std::string>{"fates.csv"});
}

TEST_F(RecorderFiles, OfFatesOfSeveralPathsHoldOneWayAfterTheOther)
{
    FatesOfPaths expected;
    const std::vector<std::string> paths{"1-2", "1-3", "wan"};
    Recorder recorder{{.fates = path("fates.csv"), .columns = {.has_paths = true}}};
    for (std::uint32_t i = 0; i < paths.size(); ++i) {
        EXPECT_EQ(recorder.add_path(paths[i]), i);
    }
    for (std::uint64_t n = 0; n < 10'000; ++n) { // more than are kept in memory
        for (std::uint32_t i = 0; i < paths.size(); ++i) {
            Fates& own = expected[paths[i]];
            recorder.lane().on_fate(i, Direction::down, n, fate_of(n + i));
            recorder.lane().on_fate(i, Direction::up, n, fate_of(n + i + 1));
            own.down.push_back(fate_of(n + i));
            own.up.push_back(fate_of(n + i + 1));
        }
    }
    EXPECT_EQ(recorder.fates_lost(), 0U);
    recorder.finish();
    EXPECT_EQ(text("fates.csv"), to_text(expected));
    EXPECT_EQ(parse_fates_of_paths(text("fates.csv")).value(), expected);
}

TEST_F(RecorderFiles, OfFatesAreTheSameThroughHoweverManyLanesTheyCome)
{
    const auto file_with = [&](std::uint32_t lanes) {
        Recorder recorder{
            {.fates = path("fates.csv"), .columns = {.has_paths = true}, .lanes = lanes}};
        for (const char* name : {"1-2", "1-3", "2-3"}) std::ignore = recorder.add_path(name);
        std::vector<std::thread> threads;
        for (std::uint32_t lane = 0; lane < lanes; ++lane) {
            threads.emplace_back([&, lane] {
                for (std::uint64_t n = 0; n < 5000; ++n) {
                    for (std::uint32_t i = lane; i < 3; i += lanes) {
                        recorder.lane(lane).on_fate(i, Direction::down, n, fate_of(n + i));
                        recorder.lane(lane).on_fate(i, Direction::up, n, fate_of(n + i + 1));
                    }
                }
            });
        }
        for (std::thread& thread : threads) thread.join();
        recorder.finish();
        EXPECT_EQ(recorder.fates_lost(), 0U);
        return text("fates.csv");
    };
    const auto alone = file_with(1);
    EXPECT_EQ(file_with(2), alone);
    EXPECT_EQ(file_with(3), alone);
}

struct Blocks {
    std::string without_times; // whose origin is unknown
    std::uint64_t packets = 0;
};

Blocks blocks_of(const std::string& capture)
{
    Blocks blocks{capture, 0};
    std::string& text = blocks.without_times;
    for (std::size_t at = 0; at + 12 <= text.size();) {
        const auto byte = [&](std::size_t i) -> std::size_t {
            return static_cast<unsigned char>(text[at + i]);
        };
        const auto length = byte(4) | byte(5) << 8 | byte(6) << 16 | byte(7) << 24;
        if (byte(0) == 6) {
            text.replace(at + 12, 8, 8, 't');
            ++blocks.packets;
        }
        at += length;
    }
    return blocks;
}

/// Reads a pipe until its writers have closed it.
std::string text_until_closed(int pipe)
{
    std::string text;
    std::vector<char> part(1 << 16);
    while (true) {
        const auto count = read(pipe, part.data(), part.size());
        if (count > 0) {
            text.append(part.data(), static_cast<std::size_t>(count));
        } else if (count < 0 && errno == EAGAIN) {
            pollfd polled{pipe, POLLIN, 0};
            poll(&polled, 1, -1);
        } else {
            return text;
        }
    }
}

TEST_F(RecorderFiles, OfACaptureHoldEveryPacketWholeWithItsComment)
{
    Recorder recorder{{{}, path("capture.pcapng")}};
    std::string expected;
    append_capture_head(expected, base::version_line("hapnet-emulator"),
                        std::array{CaptureNames{}});
    const UdpAddress from{{std::byte{10}}, 7000, false};
    const UdpAddress to{{std::byte{11}}, 7001, false};
    for (const std::size_t size : {0U, 1U, 239U, 240U, 241U, 480U, 65'507U}) {
        const std::vector<std::byte> payload(size, std::byte{0x5a});
        const CapturedPacket came{CaptureSide::a, false, base::TimePoint{1s}, from, to, payload};
        const CapturedPacket left{CaptureSide::b, true, base::TimePoint{2s}, to, from, payload};
        recorder.lane().on_arrival(came, fate_of(4));
        recorder.lane().on_departure(left, 7us, true);
        append_packet(expected, came, 0s, "delayed 4 us");
        append_packet(expected, left, 0s, "late 7 us, copy");
    }
    recorder.finish();
    EXPECT_EQ(recorder.capture_lost(), 0U);
    EXPECT_EQ(blocks_of(text("capture.pcapng")).without_times, blocks_of(expected).without_times);
}

TEST_F(RecorderFiles, OfTheLastSecondsHoldWhatCameSince)
{
    std::filesystem::create_directory(path("kept"));
    Recorder recorder{{.kept = 10s, .keep_in = path("kept")}};
    EXPECT_EQ(recorder.held(), 10s);
    const std::vector<std::byte> payload(40, std::byte{0x5a});
    std::string expected;
    append_capture_head(expected, base::version_line("hapnet-emulator"),
                        std::array{CaptureNames{}});
    for (int second = 1; second <= 30; ++second) {
        const CapturedPacket came{CaptureSide::a, false, base::TimePoint{second * 1s}, {}, {},
                                  payload};
        recorder.lane().on_arrival(came, fate_of(4));
        if (second >= 26) append_packet(expected, came, 0s, "delayed 4 us");
    }
    const auto file = recorder.keep("trap-1", base::TimePoint{26s});
    ASSERT_EQ(file, path("kept/trap-1.pcapng"));
    recorder.finish();
    EXPECT_EQ(blocks_of(text("kept/trap-1.pcapng")).without_times,
              blocks_of(expected).without_times);
    EXPECT_FALSE(recorder.keep("trap-1", base::TimePoint{26s})) << "it is there";
    EXPECT_FALSE(recorder.keep_trouble());
    EXPECT_EQ(names(), std::vector<std::string>{"kept"});
}

TEST_F(RecorderFiles, HoldNothingUnlessToldTo)
{
    Recorder recorder{{{}, path("capture.pcapng")}};
    EXPECT_FALSE(recorder.held());
    EXPECT_FALSE(recorder.keep("trap-1", {}));
}

TEST_F(RecorderFiles, LackExactlyWhatWasCountedAsLost)
{
    // A pipe without a reader stops the writer, like a disk that is too slow.
    ASSERT_EQ(mkfifo(path("capture.pcapng").c_str(), 0600), 0);
    const disk::Descriptor reader{open(path("capture.pcapng").c_str(), O_RDONLY | O_NONBLOCK)};
    const std::vector<std::byte> payload(65'507);
    const CapturedPacket left{CaptureSide::a, true, base::TimePoint{1s}, {}, {}, payload};
    std::uint64_t handed_over = 0;
    std::uint64_t lost = 0;
    std::string capture;
    std::thread reading;
    {
        Recorder recorder{{{}, path("capture.pcapng")}};
        // Each needs a 480th of the queue.
        for (; handed_over < 2000 && recorder.capture_lost() == 0; ++handed_over) {
            recorder.lane().on_departure(left, 0us, false);
        }
        reading = std::thread{[&] { capture = text_until_closed(reader.number()); }};
        recorder.finish();
        lost = recorder.capture_lost();
    }
    reading.join();
    EXPECT_GT(lost, 0U);
    EXPECT_EQ(blocks_of(capture).packets, handed_over - lost);
}

TEST_F(RecorderFiles, ThatWereNotFinishedLeaveNothingBehind)
{
    {
        Recorder recorder{{path("fates.csv"), path("capture.pcapng")}};
        recorder.lane().on_fate(0, Direction::up, 0, fate_of(0));
    }
    EXPECT_EQ(names(), std::vector<std::string>{});
}

TEST_F(RecorderFiles, ThatCannotBeWrittenAreRefusedAtOnce)
{
    EXPECT_THROW((Recorder{{path("none/fates.csv"), {}}}), std::system_error);
    EXPECT_THROW((Recorder{{{}, path("none/capture.pcapng")}}), std::system_error);
}

TEST_F(RecorderFiles, OnAFullDiskAreReportedAtTheEnd)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    Recorder recorder{{"/dev/full", "/dev/full"}};
    const std::vector<std::byte> payload(40);
    for (std::uint64_t number = 0; number < 100; ++number) {
        recorder.lane().on_fate(0, Direction::up, number, fate_of(number));
        recorder.lane().on_arrival({CaptureSide::a, false, base::TimePoint{1s}, {}, {}, payload},
                                   fate_of(number));
    }
    EXPECT_THROW(recorder.finish(), std::system_error);
    EXPECT_TRUE(recorder.has_failed());
    EXPECT_EQ(recorder.fates_lost(), 100U);
    EXPECT_EQ(recorder.capture_lost(), 100U);
}

TEST_F(RecorderFiles, OnADiskThatFillsUpKeepWhatFoundRoom)
{
    std::signal(SIGXFSZ, SIG_IGN); // a file that is too long stands for a full disk
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 300'000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::uint64_t lost = 0;
    {
        Recorder recorder{{path("fates.csv"), {}}};
        for (std::uint64_t number = 0; number < 20'000; ++number) { // 600 KB, in several writes
            recorder.lane().on_fate(0, Direction::up, number, fate_of(number));
        }
        EXPECT_THROW(recorder.finish(), std::system_error);
        EXPECT_TRUE(recorder.has_failed());
        lost = recorder.fates_lost();
    }
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    const auto kept = text("fates.csv");
    EXPECT_GT(kept.size(), 1000U);
    EXPECT_LE(kept.size(), 300'000U);
    EXPECT_EQ(kept.back(), '\n'); // whole rows
    EXPECT_EQ(names(), std::vector<std::string>{"fates.csv"});
    const auto rows = static_cast<std::uint64_t>(std::ranges::count(kept, '\n')) - 1;
    EXPECT_EQ(rows + lost, 20'000U) << "each fate is in the file or counted";
}

TEST_F(RecorderFiles, OfWhichOneCannotBeWrittenTellWhatItLacksAndTheOtherIsWhole)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const std::vector<std::byte> payload(40);
    const CapturedPacket came{CaptureSide::a, false, base::TimePoint{1s}, {}, {}, payload};
    Recorder recorder{{"/dev/full", path("capture.pcapng")}};
    for (std::uint64_t number = 0; number < 10'000; ++number) {
        recorder.lane().on_fate(0, Direction::down, number, fate_of(number));
        recorder.lane().on_arrival(came, fate_of(number));
    }
    const auto not_taken = recorder.capture_lost();
    EXPECT_THROW(recorder.finish(), std::system_error);
    EXPECT_EQ(recorder.fates_lost(), 10'000U);
    EXPECT_EQ(blocks_of(text("capture.pcapng")).packets + not_taken, 10'000U);
    EXPECT_EQ(recorder.capture_lost(), not_taken);
}

TEST_F(RecorderFiles, OfAFullDiskStillHoldTheLastSeconds)
{
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    Recorder recorder{{.capture = "/dev/full", .kept = 10s, .keep_in = path("")}};
    const std::vector<std::byte> payload(40);
    const auto come = [&](std::chrono::seconds at) {
        recorder.lane().on_arrival({CaptureSide::a, false, base::TimePoint{at}, {}, {}, payload},
                                   fate_of(4));
    };
    come(1s);
    while (!recorder.has_failed()) std::this_thread::yield();
    come(2s);
    ASSERT_TRUE(recorder.keep("trap-1", base::TimePoint{1s}));
    EXPECT_THROW(recorder.finish(), std::system_error);
    EXPECT_EQ(blocks_of(text("trap-1.pcapng")).packets, 2U);
    EXPECT_EQ(recorder.capture_lost(), 2U);
}

TEST(Recorder, WithoutAFileDoesNothing)
{
    Recorder recorder{{}};
    EXPECT_FALSE(recorder.lane().captures());
    recorder.lane().on_fate(0, Direction::up, 0, fate_of(0));
    recorder.lane().on_departure({}, 0us, false);
    recorder.finish();
}

} // namespace
} // namespace hapnet::emulator
