// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/likeness.hpp"

#include "emulator/core/emulated_path.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace hapnet::emulator::tools {

namespace {

using namespace std::chrono_literals;

constexpr double distance_most = 0.03;
constexpr double correlation_most = 0.1;
constexpr std::array<base::Duration, 3> lags{1s, 5s, 15s};
constexpr base::Duration spacing_where_unknown = 10ms;
constexpr std::size_t played_rows_min = 20'000;
constexpr std::size_t losses_min = 30;
constexpr std::uint64_t plays_of_regimes = 40;
constexpr std::uint64_t plays_min = 8;
constexpr std::size_t rows_in_all_plays = 4'000'000;

std::vector<base::Duration> sorted_delays(const MeasuredWay& way)
{
    std::vector<base::Duration> delays;
    for (const auto& delay : way.delays) {
        if (delay) delays.push_back(*delay);
    }
    std::sort(delays.begin(), delays.end());
    return delays;
}

MeasuredWay rows_of(const MeasuredWay& way, std::size_t begin, std::size_t end)
{
    MeasuredWay part{.spacing = way.spacing};
    for (std::size_t i = begin; i < end; ++i) part.add(way.delays[i], way.lost[i]);
    return part;
}

std::pair<double, double> interval_of(const SlowLosses& losses)
{
    return wilson_interval(losses.share, static_cast<double>(losses.delays));
}

MeasuredWay played_like(const Conditions& conditions, const MeasuredWay& measured,
                        base::Seed seed = base::Seed{1})
{
    return played(conditions, std::max(measured.delays.size(), played_rows_min),
                  measured.spacing.value_or(spacing_where_unknown), resolution_of(measured), seed);
}

} // namespace

std::pair<double, double> wilson_interval(double share, double count)
{
    constexpr double z = standard_errors_95;
    const double middle = share + z * z / (2.0 * count);
    const double half =
        z * std::sqrt(share * (1.0 - share) / count + z * z / (4.0 * count * count));
    const double whole = 1.0 + z * z / count;
    return {(middle - half) / whole, (middle + half) / whole};
}

std::pair<MeasuredWay, MeasuredWay> halves_of(const MeasuredWay& way)
{
    const std::size_t middle = (way.delays.size() + 1) / 2;
    return {rows_of(way, 0, middle), rows_of(way, middle, way.delays.size())};
}

base::Duration resolution_of(const MeasuredWay& way)
{
    for (const base::Duration step : {base::Duration{1ms}, base::Duration{100us}, {10us}}) {
        const auto is_multiple = [&](const auto& delay) {
            return !delay || *delay % step == base::Duration{0};
        };
        if (std::ranges::all_of(way.delays, is_multiple)) return step;
    }
    return 1us;
}

MeasuredWay played(const Conditions& conditions, std::size_t rows, base::Duration spacing,
                   base::Duration resolution, base::Seed seed)
{
    base::ensure(spacing > base::Duration{0} && resolution > base::Duration{0});
    Profile profile;
    profile.path.down = conditions;
    EmulatedPath path{profile, {.seed = seed}};
    std::vector<std::optional<base::Duration>> delays(rows);
    const std::array<std::byte, 64> bytes{};
    const auto note = [&](const Datagram& datagram, base::TimePoint at) {
        if (!datagram.is_copy) {
            const auto steps = (at - datagram.arrival + resolution / 2) / resolution;
            delays[datagram.number] = steps * resolution;
        }
        path.on_sent(Direction::down, datagram, at);
    };
    const auto drain = [&](std::optional<base::TimePoint> until) {
        for (auto due = path.next_due(); due && (!until || *due <= *until); due = path.next_due()) {
            while (const auto datagram = path.poll(Direction::down, *due)) note(*datagram, *due);
        }
    };
    base::TimePoint now{};
    for (std::size_t i = 0; i < rows; ++i, now += spacing) {
        drain(now);
        const auto admission = path.on_packet(Direction::down, bytes, now);
        if (admission.departure) note(*admission.departure, now);
    }
    drain(std::nullopt);
    MeasuredWay way{.spacing = spacing};
    for (const auto& delay : delays) way.add(delay, !delay);
    return way;
}

double distance_between(const MeasuredWay& a, const MeasuredWay& b)
{
    const auto first = sorted_delays(a);
    const auto second = sorted_delays(b);
    base::ensure(!first.empty() && !second.empty());
    double distance = 0.0;
    std::size_t i = 0;
    std::size_t k = 0;
    while (i < first.size() && k < second.size()) {
        const auto value = std::min(first[i], second[k]);
        while (i < first.size() && first[i] == value) ++i;
        while (k < second.size() && second[k] == value) ++k;
        const double gap = static_cast<double>(i) / static_cast<double>(first.size()) -
                           static_cast<double>(k) / static_cast<double>(second.size());
        distance = std::max(distance, std::abs(gap));
    }
    return distance;
}

std::optional<double> autocorrelation(const MeasuredWay& way, base::Duration lag)
{
    // A shorter series gives no useful value: 400 independent pairs have a correlation of 0 +-
    // 0.05.
    constexpr std::size_t times_lag = 3, pairs_min = 400;
    if (!way.spacing || *way.spacing <= base::Duration{0}) return std::nullopt;
    const auto rows = static_cast<std::size_t>((lag + *way.spacing / 2) / *way.spacing);
    if (rows == 0 || way.delays.size() < std::max(times_lag * rows, rows + pairs_min))
        return std::nullopt;
    double sum = 0.0;
    double count = 0.0;
    for (const auto& delay : way.delays) {
        if (!delay) continue;
        sum += base::to_seconds(*delay);
        ++count;
    }
    if (count == 0.0) return std::nullopt;
    const double mean = sum / count;
    double variance = 0.0;
    for (const auto& delay : way.delays) {
        if (delay) variance += std::pow(base::to_seconds(*delay) - mean, 2.0) / count;
    }
    double products = 0.0;
    double pairs = 0.0;
    for (std::size_t i = rows; i < way.delays.size(); ++i) {
        const auto& before = way.delays[i - rows];
        const auto& after = way.delays[i];
        if (!before || !after) continue;
        products += (base::to_seconds(*before) - mean) * (base::to_seconds(*after) - mean);
        ++pairs;
    }
    if (pairs == 0.0) return std::nullopt;
    return variance > 0.0 ? products / pairs / variance : 0.0;
}

std::optional<SlowLosses> losses_when_slow(const MeasuredWay& way)
{
    if (std::ranges::count(way.lost, true) < std::ptrdiff_t{losses_min}) return std::nullopt;
    const auto sorted = sorted_delays(way);
    if (sorted.empty()) return std::nullopt;
    const auto slow = sorted[sorted.size() * 9 / 10];
    SlowLosses found;
    std::size_t lost = 0;
    for (std::size_t i = 1; i < way.delays.size(); ++i) {
        if (!way.delays[i - 1] || *way.delays[i - 1] <= slow) continue;
        ++found.delays;
        if (way.lost[i]) ++lost;
    }
    if (found.delays == 0) return std::nullopt;
    found.share = static_cast<double>(lost) / static_cast<double>(found.delays);
    return found;
}

Likeness likeness_of(const Conditions& conditions, const MeasuredWay& first,
                     const MeasuredWay& second)
{
    const MeasuredWay model = played_like(conditions, first);
    Likeness like{.rows = second.delays.size(),
                  .halves_apart = distance_between(first, second),
                  .model_apart = distance_between(model, second),
                  .correlations = {},
                  .loss_when_slow = {}};
    for (const base::Duration lag : lags) {
        const auto of_first = autocorrelation(first, lag);
        const auto of_second = autocorrelation(second, lag);
        const auto of_model = autocorrelation(model, lag);
        if (of_first && of_second && of_model)
            like.correlations.push_back({lag, *of_first, *of_second, *of_model});
    }
    const auto slow_second = losses_when_slow(second);
    const auto slow_model = losses_when_slow(model);
    if (losses_when_slow(first) && slow_second) {
        const auto [low, high] = interval_of(*slow_second);
        like.loss_when_slow = LossWhenSlow{slow_model ? slow_model->share : 0.0, low, high};
    }
    return like;
}

namespace {

/// The criteria by which a simulation is near the learned series: the distribution, the losses
/// after slow datagrams, and the correlation at each lag.
using Nearness = std::array<bool, 2 + lags.size()>;

Nearness nearness_of(const MeasuredWay& model, const MeasuredWay& learned)
{
    Nearness near;
    near.fill(true);
    near[0] = distance_between(model, learned) <= distance_most;
    if (const auto slow = losses_when_slow(learned)) {
        const auto [low, high] = interval_of(*slow);
        const auto of_model = losses_when_slow(model);
        const double share = of_model ? of_model->share : 0.0;
        near[1] = share >= low && share <= high;
    }
    for (std::size_t i = 0; i < lags.size(); ++i) {
        const auto own = autocorrelation(learned, lags[i]);
        const auto of_model = autocorrelation(model, lags[i]);
        near[2 + i] = !own || !of_model || std::abs(*own - *of_model) <= correlation_most;
    }
    return near;
}

} // namespace

bool is_near(const Conditions& conditions, const MeasuredWay& learned)
{
    // Long series have many stays, and their simulations differ less.
    const auto affordable = rows_in_all_plays / std::max<std::size_t>(learned.delays.size(), 1);
    const std::uint64_t plays =
        conditions.regimes.empty()
            ? 1
            : std::clamp<std::uint64_t>(affordable, plays_min, plays_of_regimes);
    std::array<std::uint64_t, std::tuple_size_v<Nearness>> near{};
    for (std::uint64_t play = 1; play <= plays; ++play) {
        const auto one = nearness_of(played_like(conditions, learned, base::Seed{play}), learned);
        for (std::size_t i = 0; i < near.size(); ++i) near[i] += one[i] ? 1U : 0U;
    }
    return std::ranges::all_of(near, [&](std::uint64_t count) { return 20 * count >= plays; });
}

} // namespace hapnet::emulator::tools
