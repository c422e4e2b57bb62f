// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/link.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <tuple>
#include <vector>

namespace hapnet::emulator::link_test {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr base::TimePoint start{1h};
constexpr std::array<std::byte, 96> payload{};

Link link_of(const Conditions& conditions, QueueLimits limits = {.datagrams_max = 1024})
{
    return Link{conditions, {base::Seed{7}, Direction::up, start, limits}};
}

/// Returns all departures within an hour, in their order.
std::vector<Datagram> all_of(Link& link)
{
    std::vector<Datagram> departures;
    while (const auto departure = link.poll(start + 1h)) {
        departures.push_back(*departure);
        link.on_sent(*departure, departure->due);
    }
    return departures;
}

std::vector<std::uint64_t> numbers_of(const std::vector<Datagram>& departures)
{
    std::vector<std::uint64_t> numbers;
    for (const Datagram& departure : departures) numbers.push_back(departure.number);
    return numbers;
}

/// The numbers of datagrams that arrived 1 ms apart, in the order in which they leave.
std::vector<std::uint64_t> numbers_that_leave(const Conditions& conditions, int count)
{
    Link link = link_of(conditions);
    for (int i = 0; i < count; ++i) link.on_packet(payload, start + i * 1ms);
    return numbers_of(all_of(link));
}

} // namespace

TEST(Link, CarriesAnEnvelopeThatNoLawCountsOrChanges)
{
    constexpr std::uint8_t envelope = 14;
    constexpr auto size = payload.size() - envelope;
    Conditions conditions{
        .mtu = {size + Mtu::header_bytes}, .corrupt = {100_percent, 8}, .delay = constant(5ms)};
    conditions.rate = {.bits_per_second = 8 * size * 1000, .overhead_bytes = 0}; // one takes 1 ms
    Link link = link_of(conditions);
    for (int i = 0; i < 200; ++i) {
        const auto at = start + i * 10ms;
        const auto admission = link.on_packet(payload, at, true, {.envelope_bytes = envelope});
        EXPECT_FALSE(admission.drop);
        const auto departure = link.poll(at + 6ms);
        ASSERT_TRUE(departure);
        EXPECT_EQ(departure->due, at + 6ms);
        EXPECT_EQ(departure->bytes.size(), payload.size());
        const auto head = departure->bytes.first(envelope);
        EXPECT_TRUE(std::ranges::equal(head, std::span{payload}.first(envelope)));
        link.on_sent(*departure, departure->due);
    }
    EXPECT_EQ(link.statistics().corrupted, 200U);
    EXPECT_EQ(link.statistics().bytes_in, 200 * size);
    EXPECT_EQ(link.statistics().bytes_out, 200 * size);
}

TEST(Link, CarriesMarksAndCountsThoseOfCongestion)
{
    Link link = link_of({.duplicate = {100_percent}, .delay = constant(5ms)});
    const base::IpMarks congested{0xbb, 17};
    link.on_packet(payload, start, true, {.marks = congested});
    link.on_packet(payload, start, true, {.marks = {0xba, 18}});
    link.on_packet(payload, start);
    std::vector<base::IpMarks> marks;
    while (const auto departure = link.poll(start + 5ms)) {
        marks.push_back(departure->marks);
        link.on_sent(*departure, start + 5ms);
    }
    EXPECT_EQ(marks,
              (std::vector<base::IpMarks>{congested, congested, {0xba, 18}, {0xba, 18}, {}, {}}));
    EXPECT_EQ(link.statistics().ce_in, 1U);
    EXPECT_EQ(link.statistics().ce_out, 2U); // with its copy
}

namespace {

/// A frame with a UDP packet over IPv4 to that port.
std::array<std::byte, 1000> frame_to(std::uint8_t port)
{
    std::array<std::byte, 1000> frame{};
    const auto put = [&](std::size_t at, unsigned value) {
        frame[at] = static_cast<std::byte>(value);
    };
    put(12, 0x08);
    put(14, 0x45);
    put(14 + 9, 17);
    put(14 + 23, port);
    return frame;
}

void expect_identity(const Link& link)
{
    const Statistics& s = link.statistics();
    EXPECT_EQ(s.received + s.duplicated, s.delivered + s.dropped_total() + s.in_flight);
}

} // namespace

TEST(Link, GivesEachFlowOfFramesItsTurn)
{
    Conditions conditions;
    conditions.rate = {.bits_per_second = 8'000'000, .overhead_bytes = 14, .queue_bytes_max = 8000};
    conditions.queue.law = QueueLaw::fq_codel;
    Link link = link_of(conditions);
    const auto fat = frame_to(1);
    const auto thin = frame_to(2);
    const Headers headers{.envelope_bytes = 14, .marks = {}};
    for (int i = 0; i < 20; ++i) link.on_packet(fat, start, true, headers); // 1 ms each
    const auto admission = link.on_packet(thin, start, true, headers);
    EXPECT_FALSE(admission.drop); // the longest queue has made room
    expect_identity(link);
    std::vector<std::uint64_t> numbers;
    while (const auto departure = link.poll(start + 10ms)) {
        numbers.push_back(departure->number);
        link.on_sent(*departure, departure->due);
        expect_identity(link);
    }
    EXPECT_EQ(link.statistics().dropped[DropCause::rate_queue_full] + numbers.size(), 21U);
    EXPECT_EQ(link.statistics().in_flight, 0U);
    EXPECT_GT(link.statistics().dropped[DropCause::rate_queue_full], 8U);
    ASSERT_GE(numbers.size(), 3U);
    EXPECT_EQ(numbers[0], 0U);
    EXPECT_EQ(numbers[2], 20U); // after what was being sent, and at most one turn of the fat flow
}

TEST(Link, LosesNothingWhenTheLawOfItsQueueChanges)
{
    Conditions conditions;
    conditions.rate = {.bits_per_second = 8'000'000, .overhead_bytes = 14};
    conditions.queue.law = QueueLaw::fq_codel;
    Link link = link_of(conditions);
    const Headers headers{.envelope_bytes = 14, .marks = {}};
    std::uint64_t sent = 0;
    const auto offer = [&](base::TimePoint at) {
        for (std::uint8_t port = 0; port < 5; ++port, ++sent) {
            EXPECT_FALSE(link.on_packet(frame_to(port), at, true, headers).drop);
        }
    };
    offer(start);
    conditions.queue.law = QueueLaw::drop_tail;
    link.change(conditions, start + 500us);
    offer(start + 500us);
    conditions.queue = {.law = QueueLaw::fq_codel, .flows = 3};
    link.change(conditions, start + 700us);
    offer(start + 700us);
    conditions.rate.bits_per_second = 0; // all waiting datagrams leave at once
    link.change(conditions, start + 900us);
    offer(start + 900us);
    while (const auto departure = link.poll(start + 1ms)) {
        link.on_sent(*departure, departure->due);
    }
    EXPECT_EQ(link.statistics().delivered, sent);
    expect_identity(link);
}

TEST(Link, MarksInsteadOfDropping)
{
    Conditions conditions{.delay = constant(5ms)};
    conditions.rate = {.bits_per_second = 8 * payload.size() * 1000, .overhead_bytes = 0};
    conditions.queue.mark_above = 1ms;
    Link link = link_of(conditions);
    for (int i = 0; i < 4; ++i) { // they wait 0, 1, 2 and 3 ms
        link.on_packet(payload, start, true, {.marks = {static_cast<std::uint8_t>(i), 64}});
    }
    std::vector<base::IpMarks> marks;
    while (const auto departure = link.poll(start + 1s)) {
        marks.push_back(departure->marks);
        link.on_sent(*departure, departure->due);
    }
    EXPECT_EQ(marks, (std::vector<base::IpMarks>{{0, 64}, {1, 64}, {3, 64}, {3, 64}}));
    EXPECT_EQ(link.statistics().ce_in, 1U);
    EXPECT_EQ(link.statistics().ce_marked, 1U); // the last one was marked before
    EXPECT_EQ(link.statistics().ce_out, 2U);
}

TEST(Link, DoesTheSameWithoutALens)
{
    const Conditions conditions{.loss = {RandomLoss{20_percent}}, .delay = constant(5ms)};
    Link::Setup setup{base::Seed{7}, Direction::up, start, {.datagrams_max = 1024}};
    Link seen{conditions, setup};
    setup.stream_detail = StreamDetail::nothing;
    Link unseen{conditions, setup};
    for (Link* link : {&seen, &unseen}) {
        for (int ms = 0; ms < 100; ++ms) std::ignore = link->on_packet(payload, start + ms * 1ms);
    }
    EXPECT_EQ(numbers_of(all_of(seen)), numbers_of(all_of(unseen)));
    EXPECT_TRUE(seen.stream_statistics().report().delay);
    EXPECT_FALSE(unseen.stream_statistics().report().delay);
}

TEST(Link, TellsInStretchesAllThatItTellsOfTheWhole)
{
    Conditions conditions{.loss = {RandomLoss{20_percent}}, .delay = constant(30ms)};
    conditions.rate = {.bits_per_second = 100'000, .queue_bytes_max = 1000};
    Link link{conditions,
              {.start = start,
               .limits = {.datagrams_max = 1024},
               .stream_detail = StreamDetail::over_time}};
    for (int ms = 0; ms < 500; ++ms) {
        const auto now = start + ms * 1ms;
        std::ignore = link.on_packet(payload, now);
        while (const auto due = link.poll(now)) {
            if (due->number % 10 == 3) {
                link.on_failed(*due, DropCause::send_failed);
            } else {
                link.on_sent(*due, now);
            }
        }
    }
    Stretch all;
    for (const Stretch& one : link.stream_statistics().totals().over_time->stretches())
        all.add(one);
    const Statistics& whole = link.statistics();
    EXPECT_GT(whole.dropped[DropCause::random_loss], 0U);
    EXPECT_GT(whole.dropped[DropCause::rate_queue_full], 0U);
    EXPECT_GT(whole.dropped[DropCause::send_failed], 0U);
    EXPECT_EQ(all.received, 500U);
    EXPECT_EQ(all.dropped, whole.dropped_total());
    EXPECT_EQ(all.left.count, whole.delivered);
    EXPECT_EQ(all.bytes_out, whole.bytes_out);
    EXPECT_EQ(all.queue_max, whole.sojourn.max());
}

TEST(Link, HoldsADatagramUntilItsDelayHasPassedAndNotANanosecondLonger)
{
    Link link = link_of({.delay = constant(160ms)});
    const Admission admission = link.on_packet(payload, start);
    EXPECT_EQ(admission.fate, Fate{.delay = 160ms});
    EXPECT_FALSE(admission.departure);
    EXPECT_EQ(link.next_deadline(), start + 160ms);
    EXPECT_FALSE(link.poll(start + 160ms - 1ns));
    EXPECT_TRUE(link.poll(start + 160ms));
    EXPECT_FALSE(link.next_deadline());
}

TEST(Link, HandsBackAtOnceWhatNothingHolds)
{
    Link link = link_of({});
    const Admission admission = link.on_packet(payload, start);
    ASSERT_TRUE(admission.departure);
    EXPECT_EQ(admission.departure->bytes.data(), payload.data()); // not a copy
    EXPECT_EQ(admission.departure->due, start);
    EXPECT_EQ(link.statistics().in_flight, 1U);
    EXPECT_FALSE(link.poll(start + 1h));
    link.on_sent(*admission.departure, start + 3us);
    EXPECT_EQ(link.statistics().in_flight, 0U);
    EXPECT_EQ(link.statistics().delivered, 1U);
    EXPECT_EQ(link.statistics().lateness.max(), 3us);
}

TEST(Link, LetsNothingPassThatWhichStillWaits)
{
    Link link = link_of({.delay = constant(5ms)});
    link.on_packet(payload, start);
    link.change({}, start + 1ms);
    EXPECT_FALSE(link.on_packet(payload, start + 1ms).departure);
    EXPECT_EQ(numbers_of(all_of(link)), (std::vector<std::uint64_t>{0, 1}));
    EXPECT_TRUE(link.on_packet(payload, start + 9ms).departure);
}

TEST(Link, GivesBackTheBytesItWasGiven)
{
    Link link = link_of({.delay = constant(1ms)});
    for (const int value : {1, 2, 300}) {
        const std::vector<std::byte> bytes(static_cast<std::size_t>(value),
                                           static_cast<std::byte>(value));
        link.on_packet(bytes, start);
        const auto departure = link.poll(start + 1ms);
        ASSERT_TRUE(departure);
        EXPECT_TRUE(std::ranges::equal(departure->bytes, bytes));
        link.on_sent(*departure, start + 1ms);
    }
}

TEST(Link, CarriesAnEmptyDatagram)
{
    Link link = link_of({.delay = constant(1ms)});
    link.on_packet({}, start);
    EXPECT_TRUE(link.poll(start + 1ms)->bytes.empty());
}

TEST(Link, CountsAFailedSendUnderItsCause)
{
    Link link = link_of({.delay = constant(1ms)});
    link.on_packet(payload, start);
    link.on_failed(*link.poll(start + 1ms), DropCause::no_route);
    EXPECT_EQ(link.statistics().dropped[DropCause::no_route], 1U);
    EXPECT_EQ(link.statistics().delivered, 0U);
    EXPECT_EQ(link.statistics().in_flight, 0U);
    EXPECT_EQ(link.statistics().bytes_out, 0U);
}

TEST(Link, DropsAndCountsWhatExceedsItsBound)
{
    Link link = link_of({.delay = constant(1s)}, {.datagrams_max = 2});
    link.on_packet(payload, start);
    link.on_packet(payload, start);
    EXPECT_EQ(link.on_packet(payload, start).drop, DropCause::queue_full);
    EXPECT_EQ(link.statistics().dropped[DropCause::queue_full], 1U);
    EXPECT_EQ(link.statistics().in_flight, 2U);
}

TEST(Link, HoldsAsManyBytesAsItsLimitSaysWhateverTheSlabHas)
{
    Link::Setup setup{base::Seed{7}, Direction::up, start, {.bytes_max = 4 * 1536 + 256}};
    setup.slab = std::make_shared<Slab>(std::size_t{1} << 20);
    Link link{{.delay = constant(1s)}, setup};
    const std::vector<std::byte> large(1200);
    const std::vector<std::byte> small(200);
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(link.on_packet(large, start).drop);
    EXPECT_EQ(link.on_packet(large, start).drop, DropCause::queue_full);
    EXPECT_FALSE(link.on_packet(small, start).drop);
    EXPECT_EQ(link.on_packet(small, start).drop, DropCause::queue_full);
    link.on_sent(*link.poll(start + 1s), start + 1s);
    EXPECT_FALSE(link.on_packet(large, start + 1s).drop);
}

TEST(Link, SharesASlabWithOthers)
{
    Link::Setup setup{base::Seed{7}, Direction::up, start, {}};
    setup.slab = std::make_shared<Slab>(Slab::block_bytes);
    Link one{{.delay = constant(1s)}, setup};
    Link other{{.delay = constant(1s)}, setup};
    const std::vector<std::byte> large(60'000);
    EXPECT_FALSE(one.on_packet(large, start).drop);
    EXPECT_EQ(other.on_packet(large, start).drop, DropCause::queue_full);
    one.on_sent(*one.poll(start + 1s), start + 1s);
    EXPECT_FALSE(other.on_packet(large, start + 1s).drop);
}

TEST(Link, HoldsTheDatagramsOfASatelliteLinkByDefault)
{
    Link link{{.delay = constant(600ms)}, {base::Seed{7}, Direction::up, start}};
    const std::vector<std::byte> large(1200);
    for (int i = 0; i < 18'000; ++i) { // 30 000 a second, 288 Mbit/s
        EXPECT_FALSE(link.on_packet(large, start + i * 33us).drop);
    }
}

TEST(Link, DropsWhatHasNoDestinationAndSaysSoInItsFateUnlessALawDropsItFirst)
{
    Link link = link_of({.loss = {ListedLoss{{1}}}, .delay = constant(1s)});
    const auto first = link.on_packet(payload, start, /*has_destination*/ false);
    EXPECT_EQ(first.drop, DropCause::no_destination);
    EXPECT_EQ(first.fate, Fate{.drop = DropCause::no_destination});
    EXPECT_FALSE(first.fate.is_lost());
    EXPECT_EQ(link.on_packet(payload, start, false).fate.drop, DropCause::listed_loss);
    EXPECT_FALSE(link.on_packet(payload, start, true).drop);
    EXPECT_EQ(link.statistics().dropped[DropCause::no_destination], 1U);
    EXPECT_EQ(link.statistics().in_flight, 1U);
}

TEST(Link, DoesNotHoldUpTheNextDatagramBehindOneThatDidNotFit)
{
    Link link = link_of({.delay = constant(1s), .jitter = uniform(1s)}, {.datagrams_max = 1});
    link.on_packet(payload, start);
    const auto due = link.next_deadline();
    for (int i = 0; i < 100; ++i) link.on_packet(payload, start);
    link.on_sent(*link.poll(*due), *due);
    link.on_packet(payload, start);
    EXPECT_LE(*link.next_deadline(), std::max(*due, start + 2s));
}

TEST(Link, NeverReordersUnderJitterWhenOrderIsKeptOrSorted)
{
    for (const Order order : {Order::keep, Order::sorted}) {
        const auto numbers = numbers_that_leave(
            {.delay = constant(10ms), .jitter = uniform(10ms), .order = order}, 200);
        EXPECT_EQ(numbers.size(), 200U);
        EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    }
}

TEST(Link, ReordersUnderWideJitterWhenOrderIsFree)
{
    const auto numbers = numbers_that_leave(
        {.delay = constant(10ms), .jitter = uniform(10ms), .order = Order::free}, 200);
    EXPECT_EQ(numbers.size(), 200U);
    EXPECT_FALSE(std::is_sorted(numbers.begin(), numbers.end()));
}

TEST(Link, SortedLeavesAtTheTimesOfFree)
{
    const auto times = [](Order order) {
        Link link = link_of({.delay = constant(10ms), .jitter = uniform(10ms), .order = order});
        for (int i = 0; i < 200; ++i) link.on_packet(payload, start + i * 1ms);
        std::vector<base::TimePoint> dues;
        for (const Datagram& departure : all_of(link)) dues.push_back(departure.due);
        return dues;
    };
    EXPECT_EQ(times(Order::sorted), times(Order::free));
}

TEST(Link, KeepsOrderByTheLaterOfOwnDelayAndPredecessor)
{
    Link link = link_of({.delay = constant(5ms), .jitter = uniform(5ms)});
    auto previous = base::TimePoint::min();
    for (int i = 0; i < 50; ++i) {
        const auto arrival = start + i * 1ms;
        const auto admission = link.on_packet(payload, arrival);
        const auto own = admission.fate.delay;
        previous = std::max(previous, arrival + own);
        const auto departure = link.poll(start + 1h);
        ASSERT_TRUE(departure);
        EXPECT_EQ(departure->due, previous);
        link.on_sent(*departure, previous);
    }
}

TEST(Link, CountsAsReorderedWhatLeavesAfterAHigherNumber)
{
    Link link = link_of({});
    std::array<Datagram, 4> taken;
    for (Datagram& departure : taken) departure = *link.on_packet(payload, start).departure;
    for (const std::size_t number : {1U, 0U, 3U, 2U}) link.on_sent(taken[number], start);
    EXPECT_EQ(link.statistics().reordered, 2U); // 0 after 1, 2 after 3 (RFC 4737)
}

TEST(Link, NumbersWhatItLosesToo)
{
    Link link = link_of({.loss = {RandomLoss{100_percent}}});
    for (std::uint64_t number = 0; number < 3; ++number) {
        const Admission admission = link.on_packet(payload, start);
        EXPECT_EQ(admission.number, number);
        EXPECT_EQ(admission.fate, Fate{.drop = DropCause::random_loss});
    }
    EXPECT_EQ(link.statistics().received, 3U);
    EXPECT_EQ(link.statistics().bytes_in, 3U * 96U);
    EXPECT_FALSE(link.next_deadline());
}

TEST(Link, SendsCopiesAfterTheirOriginalsAndCountsThemApart)
{
    Link link = link_of({.duplicate = {100_percent, 2ms}, .delay = constant(1ms)});
    for (int i = 0; i < 100; ++i) link.on_packet(payload, start + i * 10ms);
    const auto departures = all_of(link);
    ASSERT_EQ(departures.size(), 200U);
    for (std::size_t i = 0; i < 200; i += 2) {
        EXPECT_FALSE(departures[i].is_copy);
        EXPECT_TRUE(departures[i + 1].is_copy);
        EXPECT_EQ(departures[i].number, departures[i + 1].number);
        EXPECT_LT(departures[i + 1].due - departures[i].due, 2ms);
    }
    EXPECT_EQ(link.statistics().duplicated, 100U);
    EXPECT_EQ(link.statistics().delivered, 200U);
    EXPECT_EQ(link.statistics().reordered, 0U);
}

TEST(Link, InvertsAsManyBitsAsItIsTold)
{
    Link link = link_of({.corrupt = {100_percent, 3}});
    int flipped = 0;
    for (int i = 0; i < 100; ++i) {
        link.on_packet(payload, start);
        const auto departure = link.poll(start);
        ASSERT_TRUE(departure);
        for (const std::byte byte : departure->bytes) {
            flipped += std::popcount(static_cast<unsigned>(byte));
        }
        link.on_sent(*departure, start);
    }
    EXPECT_EQ(link.statistics().corrupted, 100U);
    EXPECT_GT(flipped, 290); // two flips of one place undo each other: 1 in 256
    EXPECT_LE(flipped, 300);
}

TEST(Link, LetsADisplacedDatagramBeOvertakenByAsManyAsItIsTold)
{
    Link link = link_of({.delay = constant(1ms), .reorder = {100_percent, {2, {}}}});
    link.on_packet(payload, start);
    link.change({.delay = constant(1ms)}, start);
    for (int i = 1; i < 5; ++i) link.on_packet(payload, start + i * 1ms);
    EXPECT_EQ(numbers_of(all_of(link)), (std::vector<std::uint64_t>{1, 2, 0, 3, 4}));
    EXPECT_EQ(link.statistics().reordered, 1U);
    EXPECT_EQ(link.statistics().displaced, 1U);
}

TEST(Link, LetsADisplacedDatagramBeOvertakenByThoseThatNothingDelays)
{
    Link link = link_of({.reorder = {100_percent, {2, {}}}});
    link.on_packet(payload, start);
    link.change({}, start);
    for (int i = 1; i < 4; ++i) {
        const auto admission = link.on_packet(payload, start + i * 1ms);
        if (admission.departure) link.on_sent(*admission.departure, start + i * 1ms);
    }
    const auto departures = all_of(link);
    EXPECT_EQ(numbers_of(departures), (std::vector<std::uint64_t>{1, 2, 0, 3}));
    EXPECT_EQ(departures[2].due, start + 2ms);
}

TEST(Link, LetsADisplacedDatagramGoWhenNothingFollows)
{
    Link link = link_of({.delay = constant(1ms), .reorder = {100_percent, {2, {}}}});
    link.on_packet(payload, start);
    EXPECT_EQ(link.next_deadline(), start + 1001ms);
    EXPECT_FALSE(link.poll(start + 1001ms - 1ns));
    EXPECT_TRUE(link.poll(start + 1001ms));
}

TEST(Link, HoldsADisplacedDatagramBackForItsTimeEvenWhereOrderIsKept)
{
    Link link = link_of({.delay = constant(1ms), .reorder = {100_percent, {0, 3ms}}});
    link.on_packet(payload, start);
    link.change({.delay = constant(1ms)}, start);
    for (int i = 1; i < 6; ++i) link.on_packet(payload, start + i * 1ms);
    EXPECT_EQ(numbers_of(all_of(link)), (std::vector<std::uint64_t>{1, 2, 0, 3, 4, 5}));
    EXPECT_EQ(link.statistics().displaced, 1U);
}

TEST(Link, SendsAtItsRateAndDropsWhatItsQueueDoesNotHold)
{
    // 100 bytes with their overhead of 4 at 800 kbit/s: 1 ms each, and a queue of three of them.
    Link link = link_of({.rate = {800'000, 4, 300}, .delay = constant(10ms)});
    for (int i = 0; i < 6; ++i) link.on_packet(payload, start);
    EXPECT_EQ(link.statistics().dropped[DropCause::rate_queue_full], 2U);
    const auto departures = all_of(link);
    ASSERT_EQ(departures.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(departures[i].due, start + 11ms + 1ms * i);
}

TEST(Link, LetsWhatIsLostBehindTheBottleneckTakeItsTimeThere)
{
    Link link = link_of({.rate = {800'000, 4, 300}, .loss = {PatternLoss{{true, false}}}});
    link.on_packet(payload, start);
    link.on_packet(payload, start);
    const auto departures = all_of(link);
    ASSERT_EQ(departures.size(), 1U);
    EXPECT_EQ(departures[0].due, start + 2ms);
    EXPECT_EQ(link.statistics().in_flight, 0U);
}

TEST(Link, TakesWhatArrivedJustBeforeTheRateOfAFullQueueWasTakenAway)
{
    Link link = link_of({.rate = {8, 0, 1 << 20}, .loss = {PatternLoss{{true, false}}}},
                        {.datagrams_max = 4});
    for (int i = 0; i < 5; ++i) link.on_packet(payload, start);
    link.change({}, start + 1ms);
    link.on_packet(payload, start + 1ms - 1us);
    EXPECT_EQ(numbers_of(all_of(link)), (std::vector<std::uint64_t>{1, 3, 5}));
    EXPECT_EQ(link.statistics().in_flight, 0U);
}

TEST(Link, LetsNothingLeaveBeforeItCameWhenAChangeIsStampedBeforeIt)
{
    Link link = link_of({.rate = {8, 0, 1 << 20}});
    link.on_packet(payload, start + 2us);
    link.change({}, start + 1us);
    const auto departures = all_of(link);
    ASSERT_EQ(departures.size(), 1U);
    EXPECT_EQ(departures[0].due, start + 2us);
}

TEST(Link, KeepsTheTimesOfWhatIsScheduledWhenConditionsChange)
{
    Link link = link_of({.delay = constant(10ms)});
    link.on_packet(payload, start);
    link.change({.delay = constant(20ms)}, start + 1ms);
    link.on_packet(payload, start + 1ms);
    const auto departures = all_of(link);
    EXPECT_EQ(departures[0].due, start + 10ms);
    EXPECT_EQ(departures[1].due, start + 21ms);
}

TEST(Link, TakesAnArrivalThatIsStampedBeforeTheLastAsArrivedTogether)
{
    Link link = link_of({.delay = constant(1ms), .order = Order::free});
    link.on_packet(payload, start + 5us);
    link.on_packet(payload, start);
    EXPECT_EQ(numbers_of(all_of(link)), (std::vector<std::uint64_t>{0, 1}));
}

} // namespace hapnet::emulator::link_test
