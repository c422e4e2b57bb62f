// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/link.hpp"

#include "emulator/core/frame.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

namespace hapnet::emulator {

namespace {

/// The time for which a datagram waits for later ones to overtake it before it leaves anyway.
constexpr base::Duration displaced_for_max = std::chrono::seconds{1};
constexpr std::size_t displaced_max = 1024;

/// Inverts the bits that `flips` selects. An empty datagram has none and stays unchanged. Two flips
/// of one bit cancel each other.
void apply(const Flips& flips, std::span<std::byte> bytes)
{
    if (bytes.empty()) return;
    for (std::size_t i = 0; i < flips.count; ++i) {
        const std::size_t bit = flips.places[i] % (bytes.size() * 8);
        bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    }
}

/// Returns the flow of a datagram. A datagram without an envelope belongs to the only flow of its
/// path.
std::uint32_t flow_in(const Datagram& datagram)
{
    return datagram.envelope_bytes > 0 ? flow_of(datagram.bytes) : 0;
}

} // namespace

Link::~Link() = default;
Link::Link(Link&&) noexcept = default;
Link& Link::operator=(Link&&) noexcept = default;

Link::Link(const Conditions& conditions, const Setup& setup)
    : Link{std::make_shared<const Conditions>(conditions), setup}
{}

Link::Link(std::shared_ptr<const Conditions> conditions, const Setup& setup)
    : conditions_{std::move(conditions)},
      setup_{setup},
      pipeline_{*conditions_, setup.seed, setup.direction, setup.name},
      slab_{setup.slab ? setup.slab : std::make_shared<Slab>(setup.limits.bytes_max)},
      line_{setup.limits.datagrams_max},
      bottleneck_{std::make_shared<Bottleneck>(
          conditions_->rate, setup.limits.datagrams_max, setup.start,
          QueueManager{conditions_->queue, pipeline_.stream("queue")})},
      last_arrival_{setup.start},
      stream_statistics_{setup.stream_detail, setup.start}
{
    displaced_.reserve(displaced_max);
    follow_rates();
    if (rates_) bottleneck_->change(rate_now(), setup.start, conditions_->queue);
}

Admission Link::on_packet(std::span<const std::byte> bytes, base::TimePoint arrival,
                          bool has_destination, const Headers& headers)
{
    last_arrival_ = std::max(arrival, last_arrival_);
    advance(last_arrival_);
    const Packet packet{statistics_.received, bytes.size() - headers.envelope_bytes,
                        last_arrival_ - setup_.start};
    Datagram datagram{.envelope_bytes = headers.envelope_bytes,
                      .marks = headers.marks,
                      .number = packet.number,
                      .arrival = last_arrival_,
                      .due = last_arrival_,
                      .bytes = bytes};
    Admission admission{packet.number, fate_of(packet), {}, {}};
    if (!has_destination) admission.fate = without_destination(admission.fate);
    const Fate& fate = admission.fate;
    admission.drop = fate.drop;
    ++statistics_.received;
    statistics_.bytes_in += packet.bytes;
    if (headers.marks.is_congested()) ++statistics_.ce_in;
    const std::uint32_t flow = bottleneck_->is_fair() ? flow_in(datagram) : 0;
    if (bottleneck_->is_on() && fate.drop != DropCause::mtu) {
        refuse_or_pass(datagram, flow, admission);
    }
    if (!admission.drop) {
        if (passes_untouched(fate)) {
            admission.departure = datagram;
            last_due_ = std::max(last_due_, last_arrival_);
            ++statistics_.in_flight;
        } else if (!hold(datagram, flow, fate)) {
            admission.drop = DropCause::queue_full;
        }
    }
    stream_statistics_.on_packet(fate, last_arrival_);
    if (admission.drop) note_drop(*admission.drop, last_arrival_);
    return admission;
}

Fate Link::fate_of(const Packet& packet)
{
    return setup_.replay ? setup_.replay->on_packet(packet) : pipeline_.on_packet(packet);
}

/// Drops the datagram if the queue of the rate does not accept it. A datagram that will be lost
/// after the bottleneck still takes its time there. One that is too large for the path never
/// reaches it.
void Link::refuse_or_pass(Datagram& datagram, std::uint32_t flow, Admission& admission)
{
    const base::IpMarks before = datagram.marks;
    if (const auto refused = bottleneck_->refuses(datagram)) {
        admission.drop = refused;
    } else if (admission.fate.drop) {
        queue_up(datagram, flow, admission.fate);
    } else if (datagram.marks != before) {
        ++statistics_.ce_marked;
    }
}

void Link::queue_up(const Datagram& datagram, std::uint32_t flow, const Fate& fate)
{
    if (through_ == nullptr) return bottleneck_->push(datagram, fate, flow);
    bottleneck_->push(datagram, fate, flow, this);
    through_->setup_.place.mark();
}

void Link::share_bottleneck_of(Link& other)
{
    base::ensure(bottleneck_->is_idle() && !bottleneck_->is_on());
    bottleneck_ = other.bottleneck_;
    through_ = &other;
}

bool Link::passes_untouched(const Fate& fate) const
{
    return fate.delay == base::Duration{0} && !fate.copy_after && fate.flips.count == 0 &&
           fate.displacement == Displacement{} && !bottleneck_->is_on() && bottleneck_->is_idle() &&
           line_.size() == 0 && displaced_.empty();
}

/// Stores the bytes of the datagram in the slab and holds it. Returns false if there was no room.
bool Link::hold(Datagram& datagram, std::uint32_t flow, const Fate& fate)
{
    const auto stored = store(datagram);
    if (!stored) return false;
    if (fate.flips.count > 0) {
        apply(fate.flips, stored->subspan(datagram.envelope_bytes));
        ++statistics_.corrupted;
    }
    if (bottleneck_->is_on() || !bottleneck_->is_idle()) {
        queue_up(datagram, flow, fate);
    } else {
        schedule(datagram, fate);
    }
    return true;
}

/// Gives the datagram a copy of its bytes in the slab, and returns the copy.
std::optional<std::span<std::byte>> Link::store(Datagram& datagram)
{
    if (held_datagrams_ >= setup_.limits.datagrams_max) return std::nullopt;
    const auto stored = slab_->store(datagram.bytes);
    if (!stored) return std::nullopt;
    if (held_bytes_ + stored->slot_bytes > setup_.limits.bytes_max) {
        slab_->release(stored->slot);
        return std::nullopt;
    }
    held_bytes_ += stored->slot_bytes;
    ++held_datagrams_;
    datagram.slot = stored->slot;
    datagram.bytes = stored->bytes;
    ++statistics_.in_flight;
    return stored->bytes;
}

/// Frees the bytes of a datagram that has left, or will not leave.
void Link::release(const Datagram& datagram)
{
    --statistics_.in_flight;
    if (datagram.slot == Slab::no_slot) return;
    --held_datagrams_;
    held_bytes_ -= slab_->release(datagram.slot);
}

/// Computes when a datagram is to leave. Its `due` must be the time when its delay begins, and is
/// then set to the result.
void Link::schedule(Datagram& datagram, const Fate& fate)
{
    datagram.due += fate.delay;
    const Order order = order_of(fate);
    if (order == Order::keep) datagram.due = std::max(datagram.due, last_due_);
    last_due_ = std::max(last_due_, datagram.due);
    const auto [places, time] = fate.displacement;
    if (places > 0 && displaced_.size() < displaced_max) {
        ++statistics_.displaced;
        displaced_.push_back({datagram, fate});
    } else if (time > base::Duration{0}) {
        ++statistics_.displaced;
        Datagram later = datagram;
        later.due += time;
        line_.push(later);
    } else {
        put(datagram, order);
    }
    if (fate.copy_after) schedule_copy(datagram, *fate.copy_after, order);
    if (!displaced_.empty()) release_displaced(datagram.number, datagram.due);
}

void Link::schedule_copy(Datagram copy, base::Duration after, Order order)
{
    ++statistics_.duplicated;
    if (!store(copy)) {
        ++statistics_.dropped[DropCause::queue_full];
        return;
    }
    copy.is_copy = true;
    copy.due += after;
    put(copy, order);
}

void Link::put(const Datagram& datagram, Order order)
{
    if (order == Order::sorted) {
        line_.push_sorted(datagram);
    } else {
        line_.push(datagram);
    }
}

/// Schedules the displaced datagrams that waited for datagram `scheduled`, which leaves at `due`.
void Link::release_displaced(std::uint64_t scheduled, base::TimePoint due)
{
    std::erase_if(displaced_, [&](const Queued& waiting) {
        Datagram datagram = waiting.datagram;
        if (datagram.number + waiting.fate.displacement.places > scheduled) return false;
        datagram.due = std::max(datagram.due, due);
        line_.push(datagram);
        return true;
    });
}

std::optional<Datagram> Link::poll(base::TimePoint now)
{
    advance(now);
    return line_.pop(now);
}

/// Passes on the datagrams that have left the bottleneck by `now`, and those that have waited long
/// enough to be overtaken.
void Link::move_on(base::TimePoint now)
{
    (through_ == nullptr ? *this : *through_).empty_bottleneck(now);
    if (displaced_.empty()) return;
    std::erase_if(displaced_, [&](const Queued& waiting) {
        const auto latest = waiting.datagram.due + displaced_for_max;
        if (latest > now) return false;
        Datagram datagram = waiting.datagram;
        datagram.due = latest;
        line_.push(datagram);
        return true;
    });
}

/// Passes on the datagrams that have left the bottleneck by `now`. The rate changes when a regime
/// does, whether or not datagrams arrive.
void Link::empty_bottleneck(base::TimePoint now)
{
    if (rates_) switch_rates(now);
    pass_on(now);
}

void Link::switch_rates(base::TimePoint now)
{
    while (setup_.start + rates_->end() <= now) {
        const auto at = setup_.start + rates_->end();
        pass_on(at);
        std::ignore = rates_->at(rates_->end());
        bottleneck_->change(rate_now(), at, conditions_->queue);
    }
}

/// Returns the rate of the current regime, or the link's own rate if the regime sets none.
const Rate& Link::rate_now() const
{
    if (!rates_) return conditions_->rate;
    const Patch& sets = conditions_->regimes.all[rates_->current()].own;
    return sets.rate ? *sets.rate : conditions_->rate;
}

/// Starts or stops watching the regimes for their rates.
void Link::follow_rates()
{
    const auto sets_rate = [](const Regime& regime) { return regime.own.rate.has_value(); };
    const bool is_needed = std::ranges::any_of(conditions_->regimes.all, sets_rate);
    rates_.reset();
    if (through_ == nullptr) bottleneck_->have_regimes(is_needed);
    if (is_needed) rates_ = std::make_unique<RegimeChain>(*pipeline_.chain());
}

Order Link::order_in_regime(std::uint8_t regime) const
{
    const auto& all = conditions_->regimes.all.get();
    if (regime > all.size()) return conditions_->order;
    return all[regime - 1].own.order.value_or(conditions_->order);
}

/// Passes on the datagrams that have left the bottleneck. Each continues through its own link.
void Link::pass_on(base::TimePoint now)
{
    while (const auto passed = bottleneck_->pop(now)) {
        if (passed->owner == nullptr) {
            on_passed(*passed);
        } else {
            passed->owner->on_passed(*passed);
            passed->owner->setup_.place.mark();
        }
    }
}

/// Handles a datagram that has left the bottleneck, or that its queue has dropped.
void Link::on_passed(const Queued& passed)
{
    if (!passed.dropped) {
        statistics_.sojourn.add(passed.begun - passed.datagram.arrival);
        stream_statistics_.on_begun(passed.datagram.arrival, passed.begun);
    }
    if (passed.fate.drop) return; // the drop was counted at its arrival
    if (passed.dropped) {
        note_drop(*passed.dropped, passed.datagram.due);
        release(passed.datagram);
        return;
    }
    Datagram datagram = passed.datagram;
    if (passed.is_marked && !datagram.marks.is_congested()) {
        datagram.marks = datagram.marks.with_congestion();
        ++statistics_.ce_marked;
    }
    schedule(datagram, passed.fate);
}

std::optional<base::TimePoint> Link::next_deadline() const
{
    auto deadline = line_.next_due();
    if (through_ == nullptr) deadline = base::earlier(deadline, bottleneck_->next_sent());
    if (rates_ && !bottleneck_->is_idle()) {
        deadline = base::earlier(deadline, setup_.start + rates_->end());
    }
    for (const Queued& waiting : displaced_) {
        deadline = base::earlier(deadline, waiting.datagram.due + displaced_for_max);
    }
    return deadline;
}

void Link::on_sent(const Datagram& datagram, base::TimePoint at)
{
    ++statistics_.delivered;
    statistics_.bytes_out += datagram.size();
    if (datagram.marks.is_congested()) ++statistics_.ce_out;
    statistics_.lateness.add(at - datagram.due);
    if (pulse_) pulse_->on_sent(at - datagram.arrival, at - datagram.due);
    stream_statistics_.on_sent(datagram, at);
    if (!expected_.add(datagram.number) && !datagram.is_copy) ++statistics_.reordered;
    release(datagram);
}

void Link::on_failed(const Datagram& datagram, DropCause cause)
{
    if (datagram.is_copy) {
        ++statistics_.dropped[cause];
    } else {
        note_drop(cause, datagram.due);
    }
    release(datagram);
}

/// Counts the drop of a datagram that is not a copy.
void Link::note_drop(DropCause cause, base::TimePoint at)
{
    ++statistics_.dropped[cause];
    stream_statistics_.on_dropped(at);
}

void Link::share(std::shared_ptr<const Conditions> conditions, base::TimePoint now)
{
    // A change is stamped with the latest arrival of both directions. So it may be later than the
    // next arrival in this direction.
    const auto at = std::max(now, last_arrival_);
    advance(at);
    const bool are_new = conditions->regimes != conditions_->regimes;
    pipeline_.change(*conditions);
    conditions_ = std::move(conditions);
    if (are_new) {
        follow_rates();
        if (rates_) std::ignore = rates_->at(at - setup_.start);
    }
    if (through_ == nullptr) bottleneck_->change(rate_now(), at, conditions_->queue);
}

} // namespace hapnet::emulator
