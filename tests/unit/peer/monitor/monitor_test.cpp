// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/monitor.hpp"

#include "proto/record/reader.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace hapnet::peer::monitor {
namespace {

using namespace std::chrono_literals;

/// No file of this process may grow beyond that, as on a full disk.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit narrow{bytes, before_.rlim_max};
        is_in_force_ = setrlimit(RLIMIT_FSIZE, &narrow) == 0;
    }
    ~FileSizeLimit()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

    [[nodiscard]] bool is_in_force() const { return is_in_force_; }

private:
    rlimit before_{};
    bool is_in_force_ = false;
    void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

std::size_t count_of(std::string_view word, const std::string& text)
{
    std::size_t count = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

TEST(Monitor, TellsOnceThatADiskIsFullAndGoesOnWithoutTheRecord)
{
    const std::string path = testing::TempDir() + "hapnet-monitor-full.rec";
    testing::internal::CaptureStderr(); // a file: before the limit
    std::exception_ptr failure;
    bool was_whole_at_first = false;
    std::uint64_t lost = 0;
    {
        loop::Journal journal;
        net::TextQueue screen{STDERR_FILENO};
        Monitor monitor{
            journal, screen, {.writer = record::Writer{path, nlohmann::json::object()}}, {1}};
        was_whole_at_first = monitor.record_failure() == nullptr;
        const FileSizeLimit limit{16'384};
        ASSERT_TRUE(limit.is_in_force());
        for (int round = 0; round < 3; ++round) {
            for (int i = 0; i < 1000; ++i) journal.put(record::Row{record::TickRow{}});
            monitor.drain();
        }
        monitor.close();
        while (!monitor.is_done()) std::this_thread::yield();
        monitor.finish();
        while (!screen.is_done()) std::this_thread::yield();
        EXPECT_FALSE(monitor.is_record_whole());
        lost = monitor.rows_lost();
        failure = monitor.record_failure();
        EXPECT_FALSE(journal.take());
    }
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(was_whole_at_first);
    EXPECT_THROW(std::rethrow_exception(failure), std::system_error);
    EXPECT_EQ(count_of("goes on without it", said), 1U) << said;
    EXPECT_EQ(count_of(path, said), 1U) << said;
    EXPECT_LE(std::filesystem::file_size(path), 16'384U);
    const auto record = record::read(path);
    ASSERT_TRUE(record) << record.error().message;
    EXPECT_GT(record->ticks.size(), 10U);
    EXPECT_EQ(record->ticks.size() + lost, 3000U) << "each row is in the record or counted";
    std::filesystem::remove(path);
}

TEST(Monitor, NoLongerWaitsForAPeerThatAnswered)
{
    testing::internal::CaptureStderr();
    loop::Journal journal;
    net::TextQueue screen{STDERR_FILENO};
    Monitor monitor{journal, screen, {}, {1}};
    base::TimePoint now{1s};
    const auto said_so_far = [&] {
        while (!screen.is_done()) std::this_thread::yield();
        return testing::internal::GetCapturedStderr();
    };
    const auto line_with = [&](std::optional<Event> event) {
        journal.put(record::Row{record::TickRow{}});
        if (event) journal.put(loop::TimedEvent{*event, now});
        monitor.drain();
        said_so_far();
        testing::internal::CaptureStderr();
        monitor.show(now += 5s);
        const std::string said = said_so_far();
        testing::internal::CaptureStderr();
        return said;
    };
    EXPECT_EQ(line_with({}), ""); // the first comes after 5 s
    EXPECT_EQ(line_with({}).rfind("hapnet-peer 1: waiting for the other peer", 0), 0U);
    EXPECT_EQ(line_with(Event::met), "hapnet-peer 1: agreeing on the start with the other peer\n");
    EXPECT_EQ(line_with({}), "hapnet-peer 1: agreeing on the start with the other peer\n");
    testing::internal::GetCapturedStderr();
}

TEST(Monitor, ShowsTheShortestRoundTripSinceTheLineBeforeToTheMicrosecond)
{
    testing::internal::CaptureStderr();
    loop::Journal journal;
    net::TextQueue screen{STDERR_FILENO};
    Monitor monitor{journal, screen, {}, {1}};
    base::TimePoint now{100s};
    const auto hear = [&](base::Duration round_trip) {
        wire::State state;
        state.session = 1;
        state.sequence = 1;
        state.sent = base::TimePoint{1h}; // on the other's clock, which says nothing here
        state.echo = wire::Echo{now - 20ms - round_trip, 20ms};
        journal.put(loop::HeardMessage{1, now, 2, line::Datagram{wire::encode(state).bytes()}});
    };
    const auto show = [&] {
        record::SessionRow session;
        session.start = now;
        journal.put(record::Row{session});
        record::TickRow tick;
        tick.due = now + 1s;
        journal.put(record::Row{tick});
        monitor.drain();
        monitor.show(now += 5s);
    };
    show(); // the first line comes after 5 s
    hear(2ms);
    hear(52us);
    hear(300us);
    show();
    show(); // nothing was heard
    hear(160ms);
    show();
    monitor.close();
    monitor.finish();
    while (!screen.is_done()) std::this_thread::yield();
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(count_of("round trip 0.052 ms", said), 2U) << said;
    EXPECT_EQ(count_of("round trip 160.0 ms", said), 1U) << said;
}

TEST(Monitor, NamesThePeersOfACircle)
{
    testing::internal::CaptureStderr();
    loop::Journal journal;
    net::TextQueue screen{STDERR_FILENO};
    Monitor monitor{journal, screen, {}, {1, {2, 3, 4}}};
    base::TimePoint now{1s};
    const auto line_with = [&](const loop::TimedEvent& event) {
        journal.put(record::Row{record::TickRow{}});
        journal.put(event);
        monitor.drain();
        monitor.show(now += 5s);
    };
    line_with({Event::met, now, 3});
    line_with({Event::met, now, 2});
    line_with({Event::met, now, 4});
    line_with({Event::left, now, 3});
    journal.put(loop::TimedLineNews{line::News::moved, now, 4});
    monitor.close();
    monitor.finish();
    while (!screen.is_done()) std::this_thread::yield();
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "hapnet-peer 1: peer 3 answers\n"
              "hapnet-peer 1: peer 2 answers\n"
              "hapnet-peer 1: waiting for peer 4; running, and is the emulator between you?\n"
              "hapnet-peer 1: peer 4 answers\n"
              "hapnet-peer 1: agreeing on the start with the other peers\n"
              "hapnet-peer 1: peer 3 said goodbye: its hand is gone\n"
              "hapnet-peer 1: agreeing on the start with the other peers\n"
              "hapnet-peer 1: peer 4 is heard from another address: sending there\n");
}

TEST(Monitor, CallsTheSharedBodiesByTheirNames)
{
    const auto said_with = [](const Named& named) {
        testing::internal::CaptureStderr();
        loop::Journal journal;
        net::TextQueue screen{STDERR_FILENO};
        Monitor monitor{journal, screen, {}, named};
        base::TimePoint now{1s};
        monitor.show(now);
        journal.put(record::Row{record::SessionRow{.start = now, .length = 10s}});
        record::TickRow tick;
        tick.due = now;
        tick.cube = {{0.0125, 0.0, 0.0}};
        journal.put(record::Row{tick});
        journal.put(loop::TimedEvent{Event::joined, base::TimePoint{}, 0});
        monitor.drain();
        monitor.show(now);
        monitor.show(now += 5s);
        monitor.close();
        monitor.finish();
        while (!screen.is_done()) std::this_thread::yield();
        return testing::internal::GetCapturedStderr();
    };
    const auto tool = said_with({.peer_id = 1, .body = "hammer"});
    EXPECT_EQ(count_of("  hammer x  +12.5 mm", tool), 1U) << tool;
    EXPECT_EQ(count_of("under way, with the hammer as the other has it", tool), 1U) << tool;
    const auto tools =
        said_with({.peer_id = 1, .others = {2, 3}, .body = "hammer", .has_several = true});
    EXPECT_EQ(count_of("  hammer x  +12.5 mm", tools), 1U) << tools;
    EXPECT_EQ(count_of("under way, with the bodies as the others have it", tools), 1U) << tools;
    EXPECT_EQ(count_of("cube", tool + tools), 0U);
}

TEST(Monitor, LetsNoFloodOfEventsFillALog)
{
    testing::internal::CaptureStderr();
    loop::Journal journal;
    net::TextQueue screen{STDERR_FILENO};
    Monitor monitor{journal, screen, {}, {1}};
    const base::TimePoint start{1h};
    for (int i = 0; i < 3000; ++i) { // a thousand a second
        journal.put(loop::TimedEvent{Event::restarted, start + i * 1ms});
        monitor.drain();
    }
    journal.put(loop::TimedEvent{Event::left, start + 1min});
    monitor.close();
    monitor.finish();
    while (!screen.is_done()) std::this_thread::yield();
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_LE(count_of("restarted", said), 26U);
    EXPECT_GE(count_of("restarted", said), 20U);
    EXPECT_EQ(count_of("messages were left out", said), 6U) << said; // one for each gap
    EXPECT_EQ(count_of("goodbye", said), 1U) << "what comes later is said";
}

TEST(Monitor, WaitsForNobodyWhoDoesNotReadWhatItSays)
{
    std::signal(SIGPIPE, SIG_IGN); // as every program of ours does
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    loop::Journal journal;
    net::TextQueue screen{ends[1]};
    Monitor monitor{journal, screen, {}, {1}};
    base::TimePoint now{1h};
    for (int i = 0; i < 10'000; ++i) { // 1 MB: more than a pipe and the queue hold
        journal.put(record::Row{record::TickRow{}});
        monitor.drain();
        monitor.show(now += 5s);
    }
    monitor.close();
    monitor.finish();
    EXPECT_FALSE(screen.is_done());
    EXPECT_GT(screen.lost(), 1000U);
    close(ends[0]); // now the write fails, and the thread ends
    while (!screen.is_done()) std::this_thread::yield();
    EXPECT_EQ(screen.error(), EPIPE);
    close(ends[1]);
}

} // namespace
} // namespace hapnet::peer::monitor
