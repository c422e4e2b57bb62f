// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/manager.hpp"

#include "emulator/core/bottleneck.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <deque>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint origin{1h};

struct Offered {
    base::TimePoint at;
    std::size_t bytes;
};

/// What became of a datagram: how long it waited, or that the law dropped it, and when.
struct Outcome {
    std::uint64_t number = 0;
    bool is_dropped = false;
    base::TimePoint at{};
    base::Duration waited{};

    friend bool operator==(const Outcome&, const Outcome&) = default;
};
using Outcomes = std::vector<Outcome>;

std::ostream& operator<<(std::ostream& out, const Outcome& one)
{
    return out << one.number << (one.is_dropped ? " dropped at " : " sent at ")
               << (one.at - origin).count() << " after " << one.waited.count();
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

/// A line of `rate` with a queue, as plainly as can be: `Law` gets enqueue() and dequeue().
template <typename Law>
class PlainLine {
public:
    PlainLine(Law law, std::uint64_t rate) : law_{std::move(law)}, rate_{rate} {}

    Outcomes run(const std::vector<Offered>& offered)
    {
        for (std::uint64_t i = 0; i < offered.size(); ++i) {
            serve(offered[i].at);
            if (!law_.enqueue({i, offered[i].at, offered[i].bytes}, offered[i].at)) {
                outcomes_.push_back({i, true, offered[i].at, {}});
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
            outcomes_.push_back({dropped.number, true, now, {}});
        });
        if (!packet) return;
        outcomes_.push_back({packet->number, false, now, now - packet->tstamp});
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

struct ModelPacket {
    std::uint64_t number;
    base::TimePoint tstamp;
    std::size_t bytes;
};

struct ModelQueue {
    std::deque<ModelPacket> packets;
    std::size_t bytes = 0;

    void push(const ModelPacket& packet)
    {
        packets.push_back(packet);
        bytes += packet.bytes;
    }
    std::optional<ModelPacket> pop()
    {
        if (packets.empty()) return std::nullopt;
        const auto packet = packets.front();
        packets.pop_front();
        bytes -= packet.bytes;
        return packet;
    }
};

/// The pseudo-code of RFC 8289, section 5, in its own names.
class CodelOfTheRfc {
public:
    bool enqueue(const ModelPacket& packet, base::TimePoint /*now*/)
    {
        queue_.push(packet);
        return true;
    }

    template <typename Drop>
    std::optional<ModelPacket> dequeue(base::TimePoint now, Drop drop)
    {
        DodequeueResult r = dodequeue(now);
        if (dropping_) {
            if (!r.ok_to_drop) dropping_ = false;
            while (now >= drop_next_ && dropping_) {
                drop(*r.p);
                ++count_;
                r = dodequeue(now);
                if (!r.ok_to_drop) {
                    dropping_ = false;
                } else {
                    drop_next_ = control_law(drop_next_, count_);
                }
            }
        } else if (r.ok_to_drop) {
            drop(*r.p);
            r = dodequeue(now);
            dropping_ = true;
            const std::uint32_t delta = count_ - lastcount_;
            count_ = 1;
            if (delta > 1 && now - drop_next_ < 16 * interval) count_ = delta;
            drop_next_ = control_law(now, count_);
            lastcount_ = count_;
        }
        return r.p;
    }

private:
    static constexpr base::Duration target = 5ms;
    static constexpr base::Duration interval = 100ms;

    struct DodequeueResult {
        std::optional<ModelPacket> p;
        bool ok_to_drop = false;
    };

    DodequeueResult dodequeue(base::TimePoint now)
    {
        DodequeueResult r{queue_.pop(), false};
        if (!r.p) {
            first_above_time_ = {};
            return r;
        }
        const auto sojourn_time = now - r.p->tstamp;
        if (sojourn_time < target || queue_.bytes <= 1514) {
            first_above_time_ = {};
        } else if (first_above_time_ == base::TimePoint{}) {
            first_above_time_ = now + interval;
        } else if (now >= first_above_time_) {
            r.ok_to_drop = true;
        }
        return r;
    }

    static base::TimePoint control_law(base::TimePoint t, std::uint32_t count)
    {
        const double part = static_cast<double>(interval.count()) / std::sqrt(count);
        return t + base::Duration{static_cast<base::Duration::rep>(part)};
    }

    ModelQueue queue_;
    base::TimePoint first_above_time_{};
    base::TimePoint drop_next_{};
    std::uint32_t count_ = 0;
    std::uint32_t lastcount_ = 0;
    bool dropping_ = false;
};

/// The pseudo-code of RFC 8033, sections 4.1 to 4.4, in its own names.
class PieOfTheRfc {
public:
    explicit PieOfTheRfc(const base::RandomStream& stream) : stream_{stream} {}

    bool enqueue(const ModelPacket& packet, base::TimePoint now)
    {
        tick(now);
        if (drop_prob_ == 0 && current_qdelay_ < ref / 2 && qdelay_old_ < ref / 2) {
            burst_allowance_ = 0.150;
        }
        if (burst_allowance_ <= 1e-9 && drop_early(packet.number)) return false;
        queue_.push(packet);
        return true;
    }

    template <typename Drop>
    std::optional<ModelPacket> dequeue(base::TimePoint now, Drop /*drop*/)
    {
        const auto packet = queue_.pop();
        if (!packet) return packet;
        tick(now);
        current_qdelay_ = base::to_seconds(now - packet->tstamp);
        return packet;
    }

private:
    static constexpr double ref = 0.015;

    void tick(base::TimePoint now)
    {
        if (next_ == base::TimePoint{}) next_ = now + 15ms;
        for (; next_ <= now; next_ += 15ms) calculate_drop_prob();
    }

    bool drop_early(std::uint64_t number)
    {
        if ((qdelay_old_ < ref / 2 && drop_prob_ < 0.2) || queue_.bytes <= 2 * 1024) return false;
        return stream_.uniform(number) < drop_prob_;
    }

    void calculate_drop_prob()
    {
        double p = 0.125 * (current_qdelay_ - ref) + 1.25 * (current_qdelay_ - qdelay_old_);
        if (drop_prob_ < 0.000001) {
            p /= 2048;
        } else if (drop_prob_ < 0.00001) {
            p /= 512;
        } else if (drop_prob_ < 0.0001) {
            p /= 128;
        } else if (drop_prob_ < 0.001) {
            p /= 32;
        } else if (drop_prob_ < 0.01) {
            p /= 8;
        } else if (drop_prob_ < 0.1) {
            p /= 2;
        }
        if (drop_prob_ >= 0.1 && p > 0.02) p = 0.02;
        drop_prob_ += p;
        if (current_qdelay_ == 0 && qdelay_old_ == 0) drop_prob_ *= 0.98;
        if (drop_prob_ < 0) drop_prob_ = 0;
        if (drop_prob_ > 1) drop_prob_ = 1;
        qdelay_old_ = current_qdelay_;
        burst_allowance_ = std::max(0.0, burst_allowance_ - 0.015);
    }

    base::RandomStream stream_;
    ModelQueue queue_;
    base::TimePoint next_{};
    double current_qdelay_ = 0.0;
    double qdelay_old_ = 0.0;
    double drop_prob_ = 0.0;
    double burst_allowance_ = 0.0;
};

constexpr std::uint64_t rate = 4'000'000; // 2 us a byte

Outcomes run(const QueueControl& control, const base::RandomStream& stream,
             const std::vector<Offered>& offered)
{
    Bottleneck line{{rate, 0, 1U << 30U}, 8192, origin, QueueManager{control, stream}};
    const std::vector<std::byte> payload(2000);
    Outcomes outcomes;
    const auto drain = [&](base::TimePoint now) {
        while (const auto one = line.pop(now)) {
            const auto waited = one->begun - one->datagram.arrival;
            outcomes.push_back({one->datagram.number, one->is_dropped_by_law, one->begun,
                                one->is_dropped_by_law ? base::Duration{} : waited});
        }
    };
    for (std::uint64_t i = 0; i < offered.size(); ++i) {
        const auto [at, bytes] = offered[i];
        drain(at);
        const Datagram datagram{.number = i, .arrival = at, .bytes = {payload.data(), bytes}};
        if (line.refuses(datagram)) {
            outcomes.push_back({i, true, at, {}});
        } else {
            line.push(datagram, {});
        }
    }
    drain(base::TimePoint::max());
    return outcomes;
}

/// By number, since the two report at different moments.
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

/// CoDel needs a while against a sender that does not listen.
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
    EXPECT_EQ(error({.target = 5ms}), "target belongs to codel or pie: drop-tail aims at nothing");
    EXPECT_EQ(error({.law = QueueLaw::pie, .target = 0ms}), "target must be more than 0");
    EXPECT_EQ(error({.law = QueueLaw::codel, .interval = 0ms}),
              "interval must be more than 0 and at most 1000000s");
}

} // namespace
} // namespace hapnet::emulator
