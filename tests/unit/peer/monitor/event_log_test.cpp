// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/event_log.hpp"

#include "peer/monitor/monitor.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace hapnet::peer::monitor::event_log_test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

struct LoggedEvents : testing::Test {
    LoggedEvents()
    {
        std::string pattern = std::filesystem::temp_directory_path() / "hapnet-XXXXXX";
        folder = mkdtemp(pattern.data());
    }
    ~LoggedEvents() override { std::filesystem::remove_all(folder); }
    LoggedEvents(const LoggedEvents&) = delete;
    LoggedEvents& operator=(const LoggedEvents&) = delete;

    [[nodiscard]] std::string path() const { return folder + "/events.jsonl"; }
    /// The lines of the file, once all are in it.
    [[nodiscard]] std::vector<json> lines_of(const EventLog& log) const
    {
        while (!log.queue().is_done()) std::this_thread::yield();
        std::ifstream file{path()};
        std::vector<json> lines;
        for (std::string line; std::getline(file, line);) lines.push_back(json::parse(line));
        return lines;
    }

    std::string folder;
    std::array<int, 2> ends{-1, open("/dev/null", O_WRONLY | O_CLOEXEC)};
    net::TextQueue screen{ends[1]};
    loop::Journal journal;
};

} // namespace

TEST_F(LoggedEvents, AreWhatAPersonIsToldToo)
{
    EventLog log{path(), screen};
    Monitor monitor{journal, screen, {}, {.peer_id = 1, .others = {2, 3}}, &log};
    const base::TimePoint start{1h};
    journal.put(loop::TimedEvent{Event::met, start - 1s, 2});
    journal.put(record::Row{record::SessionRow{.start = start, .length = 10s}});
    journal.put(loop::TimedEvent{Event::started, start, 0});
    journal.put(loop::TimedLineNews{line::News::rekeyed, start + 1s, 3});
    journal.put(loop::TimedEvent{Event::lost, start + 1500ms, 3});
    monitor.close();
    EXPECT_EQ(lines_of(log),
              (std::vector<json>{{{"at_ns", 3'599'000'000'000},
                                  {"event", "met"},
                                  {"peer", 2},
                                  {"session_s", nullptr},
                                  {"text", "peer 2 answers"}},
                                 {{"at_ns", 3'600'000'000'000},
                                  {"event", "started"},
                                  {"peer", nullptr},
                                  {"session_s", 0.0},
                                  {"text", "session started"}},
                                 {{"at_ns", 3'601'000'000'000},
                                  {"event", "rekeyed"},
                                  {"peer", 3},
                                  {"session_s", 1.0},
                                  {"text", nullptr}},
                                 {{"at_ns", 3'601'500'000'000},
                                  {"event", "lost"},
                                  {"peer", 3},
                                  {"session_s", 1.5},
                                  {"text", describe_in_circle(Event::lost, "the body", 3)}}}));
}

TEST_F(LoggedEvents, OfTheDeviceHaveTheirFaultAndItsEnd)
{
    EventLog log{path(), screen};
    Monitor monitor{journal, screen, {}, {.peer_id = 1}, &log};
    DeviceReporter reporter{Recovery{}};
    base::TimePoint now{1h};
    const auto put = [&](std::optional<DeviceNews> news) {
        ASSERT_TRUE(news);
        journal.put(loop::TimedDeviceNews{*news, now += 2s});
    };
    using device::CalibrationStep;
    put(reporter.look(CalibrationStep::busy, {}, now));
    put(reporter.look(CalibrationStep::done, {}, now));
    put(reporter.look(CalibrationStep::done, {device::Fault::timeout, device::Trip::loop}, now));
    put(reporter.look(CalibrationStep::done, {}, now));
    put(reporter.look_at_energy(17, now));
    EXPECT_FALSE(reporter.look_at_energy(17, now + 10s));
    EXPECT_FALSE(reporter.look_at_energy(18, now - 1500ms)) << "within a second";
    monitor.close();
    std::vector<std::string> names;
    const auto lines = lines_of(log);
    for (const json& line : lines) names.push_back(line["event"]);
    ASSERT_EQ(names, (std::vector<std::string>{"calibrating", "calibrated", "fault",
                                               "fault_cleared", "energy_limited"}));
    EXPECT_EQ(lines[2]["fault"], "timeout");
    EXPECT_EQ(lines[2]["tripped_by"], "loop");
    EXPECT_EQ(lines[4]["ticks"], 17);
    EXPECT_EQ(lines[4]["text"], nullptr);
}

TEST_F(LoggedEvents, HaveNamesOfTheirOwn)
{
    std::set<std::string_view> names;
    for (int i = 0; i <= static_cast<int>(Event::clock_jumped); ++i)
        names.insert(name_of(static_cast<Event>(i)));
    EXPECT_EQ(names.size(), 14U);
    EXPECT_FALSE(names.contains(""));
}

TEST_F(LoggedEvents, AreLeftOutAndCountedInAFlood)
{
    EventLog log{path(), screen};
    Monitor monitor{journal, screen, {}, {.peer_id = 1}, &log};
    const base::TimePoint start{1h};
    for (int i = 0; i < 1000; ++i) journal.put(loop::TimedEvent{Event::restarted, start + i * 1ms});
    journal.put(loop::TimedEvent{Event::left, start + 1min});
    monitor.note({.at = start + 2min, .name = "stop"});
    monitor.close();
    std::uint64_t all = 0;
    for (const json& line : lines_of(log))
        all += line["event"] == "left_out" ? line["events"].get<std::uint64_t>() : 1;
    EXPECT_EQ(all, 1002U);
}

TEST_F(LoggedEvents, WaitForNoReaderOfAFifo)
{
    ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
    EventLog log{path(), screen}; // opens it: nobody reads
    const LoggedEvent event{.at = base::TimePoint{1h}, .name = "lost"};
    while (log.queue().lost() < 1000) log.put(event, std::nullopt);
    EXPECT_FALSE(log.queue().is_done());

    const int reader = open(path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    std::array<char, 4096> bytes{};
    EXPECT_GT(read(reader, bytes.data(), bytes.size()), 0);
    EXPECT_EQ(bytes.front(), '{');
    while (!log.queue().is_done()) std::ignore = read(reader, bytes.data(), bytes.size());
    close(reader);
}

TEST_F(LoggedEvents, GoToStdoutForADash)
{
    const int file = open(path().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    net::TextQueue out{file};
    EventLog log{"-", out};
    log.put({.at = base::TimePoint{1s}, .name = "lost", .about = 2}, std::nullopt);
    const auto lines = lines_of(log);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines.front()["event"], "lost");
    EXPECT_EQ(&log.queue(), &out);
}

TEST_F(LoggedEvents, RefuseAPlaceThatCannotBeWritten)
{
    try {
        EventLog log{folder, screen};
        FAIL() << "a folder";
    } catch (const std::system_error& error) {
        EXPECT_NE(std::string{error.what()}.find("--events: cannot write " + folder),
                  std::string::npos)
            << error.what();
    }
}

} // namespace hapnet::peer::monitor::event_log_test
