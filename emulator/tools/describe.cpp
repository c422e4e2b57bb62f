// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/describe.hpp"

#include "emulator/core/delay/theory.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/core/queue_limits.hpp"
#include "emulator/core/regime_chain.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

std::string in_ms(base::Duration duration)
{
    const double value = Milliseconds{duration}.count();
    return std::abs(value) < 100.0 ? fmt::format("{:.3g} ms", value)
                                   : fmt::format("{:.0f} ms", value);
}

std::string in_percent(double share) { return fmt::format("{:.4g} %", 100.0 * share); }

double rate_of(const Stream& stream) { return 1.0 / base::to_seconds(stream.spacing); }

double load_of(const Conditions& conditions, const Stream& stream)
{
    constexpr double bits_per_byte = 8.0;
    const auto bytes = static_cast<double>(stream.bytes + conditions.rate.overhead_bytes);
    return bytes * bits_per_byte * rate_of(stream);
}

/// Returns the average rate in bits a second.
double limit_of(const Rate& rate)
{
    return rate.trace ? rate.trace->trace->mean_rate() : static_cast<double>(rate.bits_per_second);
}

std::string rate_in_words(const Conditions& conditions, const Stream& stream)
{
    const Rate& rate = conditions.rate;
    constexpr double bits_per_byte = 8.0;
    const double limit = limit_of(rate);
    if (rate.trace) {
        const auto& law = *rate.trace;
        return fmt::format(
            "rate trace: {:.4g} Mbit/s on average, {} after {:.4g} s, with {} of "
            "overhead for each datagram; the stream fills {:.3g} % of it; a queue "
            "of {}",
            limit / 1e6, law.timing.repeat ? "again from its start" : "ends",
            base::to_seconds(law.trace->period()), base::size_text(rate.overhead_bytes),
            100.0 * load_of(conditions, stream) / limit, base::size_text(rate.queue_bytes_max));
    }
    const double each = static_cast<double>(stream.bytes + rate.overhead_bytes) * bits_per_byte;
    const auto burst =
        rate.burst_bytes == 0
            ? std::string{}
            : fmt::format("; after a pause of {:.3g} ms, {} leave at once",
                          1e3 * static_cast<double>(rate.burst_bytes) * bits_per_byte / limit,
                          base::size_text(rate.burst_bytes));
    return fmt::format(
        "rate: {} with {} of overhead for each datagram; {} B take {:.3g} ms, the "
        "stream fills {:.3g} % of it; a queue of {} holds {:.3g} ms{}",
        base::bit_rate_text(rate.bits_per_second), base::size_text(rate.overhead_bytes),
        stream.bytes, 1e3 * each / limit, 100.0 * load_of(conditions, stream) / limit,
        base::size_text(rate.queue_bytes_max),
        1e3 * static_cast<double>(rate.queue_bytes_max) * bits_per_byte / limit, burst);
}

std::string queue_in_words(const QueueControl& queue)
{
    const auto target = [&](std::chrono::milliseconds usual) {
        return in_ms(queue.target.value_or(usual));
    };
    std::string text = "queue drop-tail: drops what does not fit";
    if (queue.law == QueueLaw::codel) {
        text = fmt::format("queue CoDel (RFC 8289): drops at its head when datagrams have waited "
                           "more than {} for {}",
                           target(std::chrono::milliseconds{5}), in_ms(queue.codel_interval()));
    } else if (queue.law == QueueLaw::pie) {
        text = fmt::format("queue PIE (RFC 8033): drops arriving datagrams so that they wait {}",
                           target(std::chrono::milliseconds{15}));
    }
    if (queue.law == QueueLaw::fq_codel) {
        text = fmt::format("queue FQ-CoDel (RFC 8290): each flow has a queue, which drops at its "
                           "head when datagrams have waited more than {} for {}",
                           target(std::chrono::milliseconds{5}), in_ms(queue.codel_interval()));
    }
    if (queue.law != QueueLaw::drop_tail && queue.marks()) {
        text += "; marks ECN-capable ones instead";
    }
    if (queue.mark_above) {
        text += fmt::format("; marks ECN-capable ones that have waited more than {}",
                            in_ms(*queue.mark_above));
    }
    if (queue.packets_max > 0) text += fmt::format("; at most {} wait", queue.packets_max);
    if (queue.time_max > base::Duration{0}) {
        text += fmt::format("; none waits longer than {}", in_ms(queue.time_max));
    }
    return text;
}

std::string loss_in_words(const LossLaw& law, const Stream& stream)
{
    const LossTheory theory =
        theory_of(law, {stream.spacing, std::max<std::uint64_t>(stream.packets, 1)});
    std::string text = fmt::format("loss {}: {} lost", name_of(law), in_percent(theory.share));
    if (theory.mean_run) text += fmt::format(", runs of {:.4g} on average", *theory.mean_run);
    if (theory.loss_after_loss) {
        text += fmt::format(", after a loss {}", in_percent(*theory.loss_after_loss));
    }
    return text;
}

std::string variation_in_words(std::string_view name, const Variation& variation)
{
    const DelayTheory theory{variation.law};
    if (theory.constant()) return fmt::format("{}: {}", name, in_ms(*theory.constant()));
    std::string text =
        fmt::format("{} {}: mean {}", name, name_of(variation.law), in_ms(theory.mean()));
    text += theory.sd() ? fmt::format(", sd {}", in_ms(*theory.sd())) : ", sd infinite";
    if (const auto* traced = std::get_if<TraceLaw>(&variation.law)) {
        text += traced->trace->is_by_time() ? ", each datagram as its time in the file says"
                                            : ", the n-th datagram as the n-th value says";
    } else if (variation.correlation_time > base::Duration{0}) {
        text += fmt::format(", correlated over {}", in_ms(variation.correlation_time));
    } else {
        text += ", each datagram on its own";
    }
    return text;
}

std::string order_in_words(Order order)
{
    switch (order) {
    case Order::keep: return "order keep: none leaves before one that came earlier";
    case Order::free: return "order free: each leaves at its own time, also before earlier ones";
    case Order::sorted: break;
    }
    return "order sorted: the times of leaving are taken in the order of coming";
}

std::string reorder_in_words(const Reordering& reorder)
{
    const auto& displacement = reorder.displacement;
    return fmt::format("reorder: {} leave {}", base::to_text(reorder.share),
                       displacement.places > 0
                           ? fmt::format("after {} later ones", displacement.places)
                           : fmt::format("{} behind their turn", in_ms(displacement.time)));
}

/// Returns a setting that would keep the order without making the delay longer. The correlation of
/// a trace is the recorded one.
std::string_view remedy_of(const Conditions& conditions)
{
    const auto is_trace = [](const Variation& variation) {
        return std::holds_alternative<TraceLaw>(variation.law);
    };
    if (is_trace(conditions.delay) || is_trace(conditions.jitter)) return "";
    return conditions.jitter.correlation_time > base::Duration{0}
               ? "a longer correlation_time keeps order, mean and sd, and "
               : "a correlation_time (100ms, say) keeps order, mean and sd, and ";
}

bool varies(const Variation& variation)
{
    return !DelayTheory{variation.law}.constant().has_value();
}

/// Returns "regime bad: 4.76 % of the time, stays of 150 ms on average, then good".
std::string regime_in_words(std::span<const Regime> regimes, std::size_t index, bool are_together)
{
    const auto followers = followers_of(regimes, index);
    std::vector<std::string> next;
    for (std::size_t i = 0; i < regimes.size(); ++i) {
        if (followers[i] <= 0.0) continue;
        next.push_back(followers[i] < 1.0
                           ? fmt::format("{} ({})", regimes[i].name, in_percent(followers[i]))
                           : regimes[i].name);
    }
    return fmt::format("regime {}: {} of the time, stays of {} on average, then {}{}",
                       regimes[index].name, in_percent(shares_of(regimes)[index]),
                       in_ms(regimes[index].stay), fmt::join(next, " or "),
                       are_together ? "; both ways at once" : "");
}

/// Returns a line for each regime and for each of its conditions.
std::vector<std::string> describe_regimes(const Conditions& conditions, const Stream& stream)
{
    const std::span<const Regime> regimes{conditions.regimes.all.get()};
    std::vector<std::string> words;
    for (std::size_t i = 0; i < regimes.size(); ++i) {
        words.push_back(regime_in_words(regimes, i, conditions.regimes.are_together));
        for (const std::string& stage : describe(in_regime(conditions, i), stream)) {
            words.push_back(fmt::format("  {}: {}", regimes[i].name, stage));
        }
    }
    return words;
}

} // namespace

std::vector<std::string> describe(const Conditions& conditions, const Stream& stream)
{
    if (!conditions.regimes.empty()) return describe_regimes(conditions, stream);
    std::vector<std::string> words;
    const auto& [mtu, rate, queue, loss, corrupt, duplicate, delay, jitter, order, reorder,
                 regimes] = conditions;
    const auto is_on = [](base::Probability share) { return share.fraction() > 0.0; };
    if (mtu.bytes_max > 0) {
        words.push_back(fmt::format("mtu: what is larger than {} with its headers is dropped",
                                    base::size_text(mtu.bytes_max)));
    }
    if (rate.is_on()) words.push_back(rate_in_words(conditions, stream));
    if (rate.is_on() && queue != QueueControl{}) words.push_back(queue_in_words(queue));
    for (const LossLaw& law : loss) words.push_back(loss_in_words(law, stream));
    if (is_on(corrupt.share)) {
        words.push_back(fmt::format("corrupt: {} have {} of their bits inverted",
                                    base::to_text(corrupt.share), corrupt.bits));
    }
    if (is_on(duplicate.share)) {
        words.push_back(fmt::format("duplicate: {} are followed by a copy within {}",
                                    base::to_text(duplicate.share), in_ms(duplicate.spread)));
    }
    if (!is_nothing(delay)) words.push_back(variation_in_words("delay", delay));
    if (!is_nothing(jitter)) words.push_back(variation_in_words("jitter", jitter));
    if (varies(delay) || varies(jitter)) words.push_back(order_in_words(order));
    if (is_on(reorder.share)) words.push_back(reorder_in_words(reorder));
    if (words.empty()) words.push_back("nothing: datagrams pass at once");
    return words;
}

std::vector<std::string> warnings(const Conditions& conditions, const Stream& stream,
                                  const DirectionPrediction& prediction)
{
    std::vector<std::string> list;
    const StreamReport& measured = prediction.measured;
    const auto at_rate = fmt::format("at {:.6g} packets/s", rate_of(stream));
    const bool has_jitter = varies(conditions.delay) || varies(conditions.jitter);
    const bool has_rate = conditions.rate.is_on();
    if (!has_rate && conditions.queue != QueueControl{}) {
        list.push_back("queue has no effect without a rate: write rate, too");
    }
    const double clipped = clipped_share(conditions.delay.law, conditions.jitter.law);
    if (clipped > 1e-4) {
        list.push_back(fmt::format("{} of the datagrams would have to leave before they came; they "
                                   "leave at once, which raises the mean: use more delay or less "
                                   "jitter",
                                   in_percent(clipped)));
    }
    const bool is_measured = measured.delay && measured.delay->sd && measured.requested_delay->sd;
    const auto noticeable = std::chrono::microseconds{50};
    if (has_jitter && !has_rate && is_measured && conditions.order == Order::keep &&
        prediction.added_by_queues > noticeable) {
        list.push_back(fmt::format(
            "keeping the order makes the mean {} longer and the sd {} instead of {} {}, with {} of "
            "the gaps below 50 us; {}order = \"free\" reorders",
            in_ms(prediction.added_by_queues), in_ms(*measured.delay->sd),
            in_ms(*measured.requested_delay->sd), at_rate,
            in_percent(measured.clumped_share.value_or(0.0)), remedy_of(conditions)));
    }
    if (has_jitter && conditions.order == Order::free && measured.reordered.count > 0) {
        const auto delivered =
            static_cast<double>(prediction.statistics.delivered - prediction.statistics.duplicated);
        list.push_back(
            fmt::format("order = \"free\" reorders {} of the datagrams {}, by up to {} "
                        "places",
                        in_percent(static_cast<double>(measured.reordered.count) / delivered),
                        at_rate, measured.reordered.max));
    }
    if (has_rate && load_of(conditions, stream) > limit_of(conditions.rate)) {
        list.push_back(fmt::format("the rate is less than the stream of {} B {} needs ({:.4g} "
                                   "Mbit/s with overhead): its queue stays full",
                                   stream.bytes, at_rate, load_of(conditions, stream) / 1e6));
    }
    if (prediction.statistics.dropped[DropCause::queue_full] > 0) {
        list.push_back(fmt::format("more would be in flight than the emulator holds (--in-flight "
                                   "{}, {} datagrams): the rest is dropped as queue_full, and the "
                                   "run is not valid",
                                   base::size_text(QueueLimits{}.bytes_max),
                                   QueueLimits{}.datagrams_max));
    }
    return list;
}

std::string why_unsettled(const Conditions& conditions, const Stream& stream,
                          const DirectionPrediction& prediction, bool changes)
{
    if (changes) return "the conditions change: these figures are of all of them together";
    if (prediction.is_settled()) return "";
    if (!conditions.regimes.empty()) {
        const auto& all = conditions.regimes.all.get();
        const auto longest = std::ranges::max_element(all, {}, &Regime::stay);
        return fmt::format("the regimes last up to {} on average, and {:.6g} s have too few of "
                           "their stays: raise --packets",
                           in_ms(longest->stay),
                           base::to_seconds(stream.spacing) *
                               static_cast<double>(prediction.statistics.received));
    }
    for (const Variation* variation : {&conditions.delay, &conditions.jitter}) {
        if (!DelayTheory{variation->law}.sd()) {
            return fmt::format("the deviation of law {} is infinite: it never settles; read the "
                               "quantiles",
                               name_of(variation->law));
        }
    }
    const auto correlation =
        std::max(conditions.delay.correlation_time, conditions.jitter.correlation_time);
    const double lasted =
        base::to_seconds(stream.spacing) * static_cast<double>(prediction.statistics.received);
    if (correlation > stream.spacing) {
        return fmt::format("neighbours are correlated over {}, so {:.6g} s are worth only about "
                           "{:.0f} independent delays: raise --packets",
                           in_ms(correlation), lasted,
                           lasted / (2.0 * base::to_seconds(correlation)));
    }
    if (conditions.rate.bits_per_second > 0) {
        return "the queue of the rate fills and empties too slowly: raise --packets";
    }
    return "rare long delays, or rare events, decide it: raise --packets, or read the quantiles";
}

} // namespace hapnet::emulator::tools
