// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/manager.hpp"

#include "emulator/core/bottleneck.hpp"
#include "proto/base/random.hpp"
#include "tests/unit/emulator/core/queue/rfc_models.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <deque>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using rfc::CodelOfTheRfc;
using rfc::FqCodelOfTheRfc;
using rfc::PieOfTheRfc;

constexpr base::TimePoint origin{1h};

struct Offered {
    base::TimePoint at;
    std::size_t bytes;
    std::uint32_t flow = 0;
    bool is_ect = false;
};

/// The fate of a datagram: how long it waited, or that the law dropped it, and when.
struct Outcome {
    std::uint64_t number = 0;
    bool is_dropped = false;
    bool is_marked = false;
    base::TimePoint at{};
    base::Duration waited{};

    friend bool operator==(const Outcome&, const Outcome&) = default;
};
using Outcomes = std::vector<Outcome>;

std::ostream& operator<<(std::ostream& out, const Outcome& one)
{
    return out << one.number << (one.is_marked ? " marked" : "")
               << (one.is_dropped ? " dropped at " : " sent at ") << (one.at - origin).count()
               << " after " << one.waited.count();
}

/// A sender that overloads the line for a while, then rests, with clumps and pauses.
std::vector<Offered> load(std::uint64_t seed, double spacing_ms)
{
    const auto chance = base::Seed{seed}.stream("load");
    std::vector<Offered> offered;
    base::TimePoint at = origin;
    for (std::uint64_t i = 0; i < 6000; ++i) {
        const bool is_calm = (i / 1500) % 2 == 1;
        const double gap = spacing_ms * (is_calm ? 1.6 : 0.8) * 2.0 * chance.uniform(i);
        at += base::Duration{static_cast<base::Duration::rep>(gap * 1e6)};
        if (i % 1777 == 1776) at += 700ms;
        offered.push_back({at, 60 + chance.bits(i, 1) % 1400});
    }
    return offered;
}

/// A line of `rate` with a queue, as simply as possible: `Law` gets enqueue() and dequeue().
template <typename Law>
class PlainLine {
public:
    PlainLine(Law law, std::uint64_t rate) : law_{std::move(law)}, rate_{rate} {}

    Outcomes run(const std::vector<Offered>& offered)
    {
        for (std::uint64_t i = 0; i < offered.size(); ++i) {
            serve(offered[i].at);
            const auto [at, bytes, flow, is_ect] = offered[i];
            if (!law_.enqueue({i, at, bytes, flow, is_ect}, at)) {
                outcomes_.push_back({i, true, false, at, {}});
            }
            if constexpr (requires { law_.evict(); }) {
                for (const auto number : law_.evict()) {
                    outcomes_.push_back({number, true, false, at, {}});
                }
            }
            if (!is_busy_) start(offered[i].at);
        }
        serve(base::TimePoint::max());
        return std::move(outcomes_);
    }

private:
    void serve(base::TimePoint until)
    {
        while (is_busy_ && free_at_ <= until) {
            is_busy_ = false;
            start(free_at_);
        }
    }
    void start(base::TimePoint now)
    {
        const auto packet = law_.dequeue(now, [&](const auto& dropped) {
            outcomes_.push_back({dropped.number, true, false, now, {}});
        });
        if (!packet) return;
        outcomes_.push_back({packet->number, false, packet->is_marked, now, now - packet->tstamp});
        is_busy_ = true;
        // All lengths and the rate are such that bits take whole nanoseconds.
        free_at_ = now + base::Duration{static_cast<base::Duration::rep>(packet->bytes * 8 *
                                                                         1'000'000'000 / rate_)};
    }

    Law law_;
    std::uint64_t rate_;
    bool is_busy_ = false;
    base::TimePoint free_at_{};
    Outcomes outcomes_;
};

constexpr std::uint64_t rate = 4'000'000; // 2 us a byte

Outcomes run(const QueueControl& control, const base::RandomStream& stream,
             const std::vector<Offered>& offered, std::size_t queue_bytes_max = 1U << 30U)
{
    Bottleneck line{{rate, 0, queue_bytes_max}, 8192, origin, QueueManager{control, stream}};
    const std::vector<std::byte> payload(2000);
    Outcomes outcomes;
    const auto drain = [&](base::TimePoint now) {
        while (const auto one = line.pop(now)) {
            const auto waited = one->begun - one->datagram.arrival;
            const bool is_evicted = one->dropped == DropCause::rate_queue_full;
            outcomes.push_back({one->datagram.number, one->dropped.has_value(), one->is_marked,
                                is_evicted ? one->datagram.due : one->begun,
                                one->dropped ? base::Duration{} : waited});
        }
    };
    for (std::uint64_t i = 0; i < offered.size(); ++i) {
        const auto [at, bytes, flow, is_ect] = offered[i];
        drain(at);
        Datagram datagram{.marks = {static_cast<std::uint8_t>(is_ect ? 2 : 0), 64},
                          .number = i,
                          .arrival = at,
                          .bytes = {payload.data(), bytes}};
        if (line.refuses(datagram)) {
            outcomes.push_back({i, true, false, at, {}});
        } else {
            line.push(datagram, {}, flow);
        }
    }
    drain(base::TimePoint::max());
    return outcomes;
}

/// Sorted by number, because the two report at different moments.
Outcomes sorted(Outcomes outcomes)
{
    const auto by_number = [](const auto& a, const auto& b) { return a.number < b.number; };
    std::sort(outcomes.begin(), outcomes.end(), by_number);
    return outcomes;
}

std::size_t dropped(const Outcomes& outcomes)
{
    return static_cast<std::size_t>(std::count_if(
        outcomes.begin(), outcomes.end(), [](const Outcome& one) { return one.is_dropped; }));
}

double mean_wait_ms(const Outcomes& outcomes)
{
    double sum = 0.0;
    double count = 0.0;
    for (const Outcome& one : outcomes) {
        if (one.is_dropped) continue;
        sum += 1e3 * base::to_seconds(one.waited);
        count += 1.0;
    }
    return sum / count;
}

TEST(Codel, IsThatOfTheRfcToTheNanosecond)
{
    const auto stream = base::Seed{1}.stream("up/queue");
    std::size_t drops = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto offered = load(seed, 1.0 + 0.1 * static_cast<double>(seed));
        const auto expected = sorted(PlainLine{CodelOfTheRfc{}, rate}.run(offered));
        const auto ours = sorted(run({.law = QueueLaw::codel}, stream, offered));
        ASSERT_EQ(ours, expected) << "seed " << seed;
        drops += dropped(ours);
    }
    EXPECT_GT(drops, 1000U);
}

/// The same load, of several flows and with some datagrams that may be marked.
std::vector<Offered> load_of_flows(std::uint64_t seed, double spacing_ms)
{
    auto offered = load(seed, spacing_ms);
    const auto chance = base::Seed{seed}.stream("flows");
    for (std::uint64_t i = 0; i < offered.size(); ++i) {
        const double part = chance.uniform(i);
        // One flow sends half of all, some send little, and sometimes a new one begins.
        offered[i].flow = part < 0.5 ? 3 : static_cast<std::uint32_t>(chance.bits(i, 1) % 40);
        offered[i].is_ect = offered[i].flow % 3 == 0 && chance.bits(i, 2) % 2 == 0;
    }
    return offered;
}

std::size_t marked(const Outcomes& outcomes)
{
    return static_cast<std::size_t>(std::count_if(
        outcomes.begin(), outcomes.end(), [](const Outcome& one) { return one.is_marked; }));
}

TEST(Codel, MarksWhatCanBeMarkedWhereItWouldDropIt)
{
    const auto stream = base::Seed{1}.stream("up/queue");
    std::size_t marks = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto offered = load_of_flows(seed, 1.0 + 0.1 * static_cast<double>(seed));
        const auto expected = sorted(PlainLine{CodelOfTheRfc{}, rate}.run(offered));
        const auto ours = sorted(run({.law = QueueLaw::codel}, stream, offered));
        ASSERT_EQ(ours, expected) << "seed " << seed;
        marks += marked(ours);
        const QueueControl deaf{.law = QueueLaw::codel, .is_marking = false};
        EXPECT_EQ(marked(run(deaf, stream, offered)), 0U);
    }
    EXPECT_GT(marks, 200U);
}

TEST(FqCodel, IsThatOfTheRfcToTheNanosecond)
{
    const auto stream = base::Seed{1}.stream("up/queue");
    const QueueControl control{.law = QueueLaw::fq_codel, .flows = FqCodelOfTheRfc::flows};
    std::size_t drops = 0;
    std::size_t marks = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto offered = load_of_flows(seed, 0.8 + 0.1 * static_cast<double>(seed));
        const auto expected = sorted(PlainLine{FqCodelOfTheRfc{1U << 30U}, rate}.run(offered));
        const auto ours = sorted(run(control, stream, offered));
        ASSERT_EQ(ours, expected) << "seed " << seed;
        drops += dropped(ours);
        marks += marked(ours);
    }
    EXPECT_GT(drops, 1000U);
    EXPECT_GT(marks, 50U);
}

TEST(FqCodel, TakesRoomFromTheLongestQueue)
{
    const auto stream = base::Seed{1}.stream("up/queue");
    const QueueControl control{.law = QueueLaw::fq_codel, .flows = FqCodelOfTheRfc::flows};
    constexpr std::size_t limit = 40'000;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto offered = load_of_flows(seed, 0.5);
        const auto expected = sorted(PlainLine{FqCodelOfTheRfc{limit}, rate}.run(offered));
        const auto ours = sorted(run(control, stream, offered, limit));
        ASSERT_EQ(ours, expected) << "seed " << seed;
    }
}

/// The purpose of the law: a flow with little traffic does not wait for one that fills the line.
TEST(FqCodel, LetsAFlowOfLittlePassAtOnce)
{
    std::vector<Offered> offered;
    for (int i = 0; i < 3000; ++i) { // 1000 B take 2 ms: five times what the line can carry
        const auto at = origin + i * 400us;
        offered.push_back({at, 1000, 1});
        if (i % 50 == 49) offered.push_back({at + 1us, 100, 2});
    }
    const auto stream = base::Seed{1}.stream("up/queue");
    const auto longest_of_little = [&](QueueLaw law) {
        base::Duration longest{};
        for (const Outcome& one : run({.law = law}, stream, offered, 200'000)) {
            if (offered[one.number].flow == 2 && !one.is_dropped) {
                longest = std::max(longest, one.waited);
            }
        }
        return longest;
    };
    EXPECT_LE(longest_of_little(QueueLaw::fq_codel), 2ms); // of the one that is being sent
    EXPECT_GT(longest_of_little(QueueLaw::drop_tail), 300ms);
}

TEST(Pie, MarksUpToATenthAndThenDrops)
{
    auto offered = load(3, 0.4); // more than twice what the line can carry
    for (Offered& one : offered) one.is_ect = true;
    QueueManager manager{{.law = QueueLaw::pie}, base::Seed{1}.stream("up/queue")};
    Bottleneck line{{rate, 0, 1U << 30U}, 8192, origin, manager};
    const std::vector<std::byte> payload(2000);
    std::size_t marks = 0;
    std::size_t drops = 0;
    for (std::uint64_t i = 0; i < 1500; ++i) {
        while (line.pop(offered[i].at)) {}
        Datagram datagram{.marks = {1, 64},
                          .number = i,
                          .arrival = offered[i].at,
                          .bytes = {payload.data(), offered[i].bytes}};
        if (line.refuses(datagram)) {
            ++drops;
            continue;
        }
        if (datagram.marks.is_congested()) {
            EXPECT_EQ(drops, 0U) << i; // the probability only grows here
            ++marks;
        }
        line.push(datagram, {});
    }
    EXPECT_GT(marks, 3U);
    EXPECT_GT(drops, 100U);
}

TEST(EcnThreshold, MarksUnderAnyLawWhatHasWaitedLonger)
{
    std::vector<Offered> offered;
    for (int i = 0; i < 4; ++i) offered.push_back({origin, 1000, 0, i != 3}); // 2 ms each
    for (const auto law :
         {QueueLaw::drop_tail, QueueLaw::codel, QueueLaw::pie, QueueLaw::fq_codel}) {
        const auto outcomes =
            run({.law = law, .mark_above = 2ms}, base::Seed{1}.stream("up/queue"), offered);
        std::vector<std::uint64_t> numbers;
        for (const Outcome& one : outcomes) {
            if (one.is_marked) numbers.push_back(one.number);
        }
        // They wait 0, 2, 4 and 6 ms; the last cannot be marked.
        EXPECT_EQ(numbers, std::vector<std::uint64_t>{2}) << base::name_of(law);
    }
}

TEST(Pie, IsThatOfTheRfcDrawByDraw)
{
    std::size_t drops = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto stream = base::Seed{seed}.stream("up/queue");
        const auto offered = load(seed, 1.0 + 0.1 * static_cast<double>(seed));
        const auto expected = sorted(PlainLine{PieOfTheRfc{stream}, rate}.run(offered));
        const auto ours = sorted(run({.law = QueueLaw::pie}, stream, offered));
        ASSERT_EQ(ours, expected) << "seed " << seed;
        drops += dropped(ours);
    }
    EXPECT_GT(drops, 1000U);
}

/// CoDel needs time against a sender that does not respond.
TEST(QueueLaws, KeepAQueueShorterThanDropTail)
{
    const auto stream = base::Seed{1}.stream("up/queue");
    const auto offered = load(7, 1.2);
    const double tail = mean_wait_ms(run({}, stream, offered));
    EXPECT_GT(tail, 100.0);
    EXPECT_LT(mean_wait_ms(run({.law = QueueLaw::codel}, stream, offered)), 0.8 * tail);
    EXPECT_LT(mean_wait_ms(run({.law = QueueLaw::pie}, stream, offered)), tail / 3);
    EXPECT_EQ(dropped(run({}, stream, offered)), 0U);
}

TEST(QueueBounds, CountDatagramsThatWaitAndNotTheOneThatIsSent)
{
    const auto outcomes =
        run({.packets_max = 2}, base::Seed{1}.stream(""), std::vector<Offered>(5, {origin, 1000}));
    EXPECT_EQ(dropped(outcomes), 2U);
}

TEST(QueueBounds, DropWhatWouldWaitLonger)
{
    // Each takes 2 ms: the third waits 4 ms, the fourth would wait 6 ms.
    const std::vector<Offered> offered(5, {origin, 1000});
    const auto outcomes = run({.time_max = 4ms}, base::Seed{1}.stream(""), offered);
    EXPECT_EQ(dropped(outcomes), 2U);
    EXPECT_EQ(dropped(run({.time_max = 3'999'999ns}, base::Seed{1}.stream(""), offered)), 3U);
}

TEST(QueueControl, RefusesWhatItCannotDo)
{
    const auto error = [](const QueueControl& control) {
        const auto valid = validate(control);
        return valid ? "" : valid.error().message;
    };
    EXPECT_EQ(error({.law = QueueLaw::codel, .target = 5ms}), "");
    EXPECT_EQ(error({.target = 5ms}),
              "target belongs to codel, fq-codel or pie: drop-tail aims at nothing");
    EXPECT_EQ(error({.law = QueueLaw::pie, .target = 0ms}), "target must be more than 0");
    EXPECT_EQ(error({.law = QueueLaw::codel, .interval = 0ms}),
              "interval must be more than 0 and at most 1000000s");
    EXPECT_EQ(error({.law = QueueLaw::fq_codel, .interval = 50ms, .is_marking = true, .flows = 1}),
              "");
    for (const QueueLaw law : {QueueLaw::drop_tail, QueueLaw::pie}) {
        EXPECT_EQ(error({.law = law, .interval = 100ms}),
                  "interval belongs to codel or fq-codel: remove it, or use one of these laws");
    }
    // Also with the default values.
    for (const QueueLaw law : {QueueLaw::drop_tail, QueueLaw::codel, QueueLaw::pie}) {
        const auto refusal = "flows and quantum belong to fq-codel: remove them, or use that law";
        EXPECT_EQ(error({.law = law, .flows = 1024}), refusal);
        EXPECT_EQ(error({.law = law, .quantum_bytes = 1514}), refusal);
    }
    for (const bool is_marking : {false, true}) {
        EXPECT_EQ(
            error({.is_marking = is_marking}).rfind("ecn belongs to codel, fq-codel or pie", 0),
            0U);
    }
    EXPECT_EQ(error({.mark_above = 5ms}), "");
}

} // namespace
} // namespace hapnet::emulator
