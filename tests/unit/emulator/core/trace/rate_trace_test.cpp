// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rate_trace.hpp"

#include "emulator/core/bottleneck.hpp"
#include "proto/base/random.hpp"
#include "tests/support/seeds.hpp"

#include <chrono>
#include <deque>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint run_start{1h};

struct Arrival {
    base::Duration at;
    std::size_t bytes;
};
using Departures = std::vector<std::pair<std::size_t, base::Duration>>;

/// The number of opportunities at each moment of a schedule.
std::vector<Opportunities::Moment> moments_of(const std::vector<base::Duration>& schedule)
{
    std::vector<Opportunities::Moment> moments;
    for (std::size_t i = 0; i < schedule.size(); ++i) {
        const bool is_last = i + 1 == schedule.size() || schedule[i + 1] != schedule[i];
        if (is_last) moments.push_back({schedule[i], i + 1});
    }
    return moments;
}

/// Mahimahi's LinkQueue (src/frontend/link_queue.cc) with its own names, but with a clock in
/// nanoseconds and an endless queue. Times since the trace began.
class ReferenceLinkQueue {
public:
    ReferenceLinkQueue(std::vector<base::Duration> schedule, bool repeat)
        : schedule_{std::move(schedule)}, repeat_{repeat}
    {}

    void rationalize(base::Duration now)
    {
        while (!finished_ && schedule_.at(next_delivery_) + base_ <= now) {
            const auto this_delivery_time = schedule_.at(next_delivery_) + base_;
            std::size_t bytes_left_in_this_delivery = 1504;
            use_a_delivery_opportunity();
            while (bytes_left_in_this_delivery > 0) {
                if (packet_in_transit_bytes_left_ == 0) {
                    if (queue_.empty()) break;
                    packet_in_transit_ = queue_.front().first;
                    packet_in_transit_bytes_left_ = queue_.front().second;
                    queue_.pop_front();
                }
                const auto amount_to_send =
                    std::min(bytes_left_in_this_delivery, packet_in_transit_bytes_left_);
                packet_in_transit_bytes_left_ -= amount_to_send;
                bytes_left_in_this_delivery -= amount_to_send;
                if (packet_in_transit_bytes_left_ == 0) {
                    departures_.emplace_back(packet_in_transit_, this_delivery_time);
                }
            }
        }
    }

    void read_packet(std::size_t number, std::size_t bytes, base::Duration now)
    {
        rationalize(now);
        queue_.emplace_back(number, bytes);
    }

    [[nodiscard]] const Departures& departures() const { return departures_; }

private:
    void use_a_delivery_opportunity()
    {
        next_delivery_ = (next_delivery_ + 1) % schedule_.size();
        if (next_delivery_ != 0) return;
        if (repeat_) {
            base_ += schedule_.back();
        } else {
            finished_ = true;
        }
    }

    std::vector<base::Duration> schedule_;
    bool repeat_;
    std::size_t next_delivery_ = 0;
    base::Duration base_{};
    bool finished_ = false;
    std::size_t packet_in_transit_ = 0;
    std::size_t packet_in_transit_bytes_left_ = 0;
    std::deque<std::pair<std::size_t, std::size_t>> queue_;
    Departures departures_;
};

Departures of_reference(const std::vector<base::Duration>& schedule, const TraceTiming& timing,
                        const std::vector<Arrival>& arrivals, base::Duration until)
{
    ReferenceLinkQueue queue{schedule, timing.repeat};
    const auto zero = timing.start == TraceStart::first ? arrivals.front().at : 0ns;
    const auto in_trace = [&](base::Duration at) { return at - zero + timing.offset; };
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        queue.read_packet(i, arrivals[i].bytes, in_trace(arrivals[i].at));
    }
    queue.rationalize(in_trace(until));
    Departures departures = queue.departures();
    for (auto& departure : departures) departure.second += zero - timing.offset;
    return departures;
}

Departures of_bottleneck(const RateTraceLaw& law, const std::vector<Arrival>& arrivals,
                         base::Duration until)
{
    Rate rate{.overhead_bytes = 32, .queue_bytes_max = 1U << 30U};
    rate.trace = law;
    Bottleneck line{rate, 4096, run_start};
    const std::vector<std::byte> payload(5000);
    Departures departures;
    const auto drain = [&](base::Duration now) {
        while (const auto sent = line.pop(run_start + now)) {
            departures.emplace_back(sent->datagram.number, sent->datagram.due - run_start);
        }
    };
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const auto [at, bytes] = arrivals[i];
        drain(at);
        line.push({.number = i, .arrival = run_start + at, .bytes = {payload.data(), bytes - 32}},
                  {});
    }
    drain(until);
    return departures;
}

/// A schedule like the recorded ones: a random walk of the rate, pauses, several in a ms.
std::vector<base::Duration> cellular(std::uint64_t seed)
{
    const auto chance = base::Seed{seed}.stream("schedule");
    std::vector<base::Duration> times;
    double per_ms = 0.2 + chance.uniform(0);
    for (std::uint64_t ms = 0; ms < 400; ++ms) {
        per_ms = std::clamp(per_ms + 0.4 * (chance.uniform(ms, 1) - 0.5), 0.0, 3.0);
        if (ms % 97 < 13 + seed % 7) continue; // handed over
        for (std::uint64_t i = 0; i < 4; ++i) {
            if (chance.uniform(ms, 2 + static_cast<std::uint32_t>(i)) < per_ms / 4.0) {
                times.emplace_back(std::chrono::milliseconds{ms});
            }
        }
    }
    times.emplace_back(401ms);
    return times;
}

std::vector<Arrival> traffic(std::uint64_t seed)
{
    const auto chance = base::Seed{seed}.stream("traffic");
    std::vector<Arrival> arrivals;
    base::Duration at{static_cast<base::Duration::rep>(chance.bits(0) % 50'000'000)};
    for (std::uint64_t i = 0; i < 1500; ++i) {
        const auto draw = chance.bits(i, 1);
        // Some arrive exactly at opportunities, some in clumps; some are larger than one.
        const std::size_t bytes = draw % 5 == 0 ? 4000 : 40 + draw % 1464;
        arrivals.push_back({at, bytes});
        const auto step = chance.bits(i, 2) % 2'500'000;
        if (draw % 3 != 0) at += base::Duration{static_cast<base::Duration::rep>(step)};
        if (draw % 7 == 0) at -= at % 1ms;
        if (at < arrivals.back().at) at = arrivals.back().at;
    }
    return arrivals;
}

TEST(RateTrace, DeliversExactlyWhatTheRuleOfMahimahiDelivers)
{
    std::size_t compared = 0;
    for (std::uint64_t seed = 0; seed < test::seeds(40); ++seed) {
        const auto schedule = cellular(seed);
        const auto arrivals = traffic(seed);
        const TraceTiming timing{.repeat = seed % 4 != 0,
                                 .offset = std::chrono::milliseconds{seed % 3 * 41},
                                 .start = seed % 2 == 0 ? TraceStart::run : TraceStart::first};
        const RateTraceLaw law{
            "x",
            std::make_shared<const RateTrace>(Opportunities{moments_of(schedule)}),
            {},
            timing};
        const auto expected = of_reference(schedule, timing, arrivals, 1h);
        EXPECT_EQ(of_bottleneck(law, arrivals, 1h), expected) << "seed " << seed;
        compared += expected.size();
    }
    EXPECT_GT(compared, 1000 * test::seeds(40));
}

TEST(RateTrace, CarriesTheRestOfAnOpportunityToWhatWaits)
{
    const auto trace = parse_rate_trace("1\n1\n5\n");
    ASSERT_TRUE(trace);
    EXPECT_EQ(trace->finish(0ns, 100 * work_per_byte, true),
              (Completion{1ms, (2 * 1504 - 100) * work_per_byte}));
    EXPECT_EQ(trace->finish(1ms, 100 * work_per_byte, true),
              (Completion{5ms, 1404 * work_per_byte}));
    EXPECT_EQ(trace->finish(5ms, 1, true)->at, 6ms); // it begins again
    EXPECT_FALSE(trace->finish(5ms, 1, false));
}

TEST(RateTrace, HasAsManyOpportunitiesAsAFastLineNeeds)
{
    // 25 of 1504 B each millisecond are 300.8 Mbit/s, or 1.5 million a minute.
    constexpr int each_ms = 25;
    std::string text;
    for (int ms = 1; ms <= 60'000; ++ms) {
        for (int i = 0; i < each_ms; ++i) text += std::to_string(ms) + "\n";
    }
    const auto trace = parse_rate_trace(text);
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_EQ(trace->mean_rate(), 300.8e6);
    EXPECT_EQ(trace->period(), 60s);
    const Work minute = Work{60'000} * each_ms * 1504 * work_per_byte;
    EXPECT_EQ(trace->sent(0s, 1ms, true), minute / 60'000);
    EXPECT_EQ(trace->finish(0s, minute / 60'000 + 1, true)->at, 2ms);
    static_assert(sizeof(Opportunities::Moment) == 16); // as the documents say
}

TEST(RateTrace, SendsInStepsWhatTheyAddUpTo)
{
    const auto trace = parse_rate_trace("t_ms,rate_bps\n0,8000000\n10,0\n30,4000000\n");
    ASSERT_TRUE(trace);
    const auto bytes = [](std::uint64_t count) { return count * work_per_byte; };
    EXPECT_EQ(trace->finish(0ns, bytes(1000), true), (Completion{1ms, 0}));
    EXPECT_EQ(trace->finish(9ms, bytes(1500), true)->at, 31ms);
    EXPECT_EQ(trace->finish(40ms, bytes(1), false)->at, 40ms + 2us); // the last one holds
    EXPECT_EQ(trace->finish(49ms, bytes(1500), true)->at, 51ms);     // again from the first
    EXPECT_EQ(trace->sent(0ns, 50ms, true), bytes(20'000));
    EXPECT_EQ(trace->sent(0ns, 500ms, true), bytes(200'000));
    EXPECT_EQ(trace->finish(0ns, bytes(200'000), true)->at, 500ms);
    EXPECT_DOUBLE_EQ(trace->mean_rate(), 3.2e6);
}

TEST(RateTrace, OfOneRateIsThatOfALineWithIt)
{
    Rate by_trace{.overhead_bytes = 4, .queue_bytes_max = 1U << 20U};
    by_trace.trace = RateTraceLaw{
        "x", std::make_shared<const RateTrace>(*parse_rate_trace("t_ms,rate_bps\n0,1234567\n"))};
    Bottleneck one{by_trace, 64, run_start};
    Bottleneck other{{1'234'567, 4, 1U << 20U}, 64, run_start};
    const std::vector<std::byte> payload(100);
    for (std::uint64_t i = 0; i < 64; ++i) {
        for (Bottleneck* line : {&one, &other}) {
            line->push({.number = i, .arrival = run_start, .bytes = payload}, {});
        }
    }
    while (const auto due = other.next_sent()) {
        ASSERT_EQ(one.next_sent(), due);
        EXPECT_EQ(one.pop(*due)->datagram.number, other.pop(*due)->datagram.number);
    }
    EXPECT_FALSE(one.next_sent());
}

TEST(RateTrace, GoesOnFromAConstantRateAndBack)
{
    Rate by_trace{.overhead_bytes = 0, .queue_bytes_max = 1U << 20U};
    by_trace.trace = RateTraceLaw{
        "x",
        std::make_shared<const RateTrace>(*parse_rate_trace("t_ms,rate_bps\n0,8000\n")),
        {},
        {.start = TraceStart::first}};
    Bottleneck line{{16'000, 0, 1U << 20U}, 64, run_start};
    const std::vector<std::byte> payload(4);
    line.push({.number = 0, .arrival = run_start, .bytes = payload}, {});
    EXPECT_EQ(line.next_sent(), run_start + 2ms);
    line.change(by_trace, run_start + 1ms); // 2 of the 4 bytes are left
    EXPECT_EQ(line.next_sent(), run_start + 3ms);
    line.change({16'000, 0, 1U << 20U}, run_start + 2ms);
    EXPECT_EQ(line.next_sent(), run_start + 2ms + 500us);
}

TEST(RateTrace, RefusesWhatIsNotOneAndNamesTheLine)
{
    const auto error = [](std::string_view text) {
        const auto trace = parse_rate_trace(text);
        return trace ? "accepted" : trace.error().message;
    };
    EXPECT_EQ(error("5\n4\n"), "line 2: 4 ms is earlier than the line before");
    EXPECT_EQ(error("0\n"), "line 1: the file ends without an opportunity later than 0 ms");
    EXPECT_EQ(error("1\nx\n"),
              "line 2: 'x' is not a time in whole milliseconds, as Mahimahi has them; a table "
              "begins with the names of its columns");
    EXPECT_EQ(error("rate_bps\n1\n"),
              "line 1: no column is named time_ns, time_us, time_ms or time_s: name it, such as "
              "columns \"time=stamp:s\", or say how long each value lasts, such as slot = "
              "\"10ms\"");
    EXPECT_EQ(error("t_s,rate_bps\n0,0\n"), "line 2: nothing would ever pass: each rate is 0");
    EXPECT_EQ(error(""), "line 1: the file ends without a rate");
}

} // namespace
} // namespace hapnet::emulator
