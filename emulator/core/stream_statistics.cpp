// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/stream_statistics.hpp"

namespace hapnet::emulator {

void StreamStatistics::add(const Datagram& datagram, base::TimePoint at)
{
    const auto delay = at - datagram.arrival;
    totals_.delay.add(delay);
    totals_.delays.add(delay);
    if (detail_ == StreamDetail::over_time) {
        Stretch& stretch = totals_.over_time->at(at);
        stretch.left.on_sent(delay, at - datagram.due);
        stretch.bytes_out += datagram.size();
    }
    if (totals_.delay.count() > 1) {
        const auto gap = at - last_sent_;
        totals_.gaps.add(gap);
        if (gap < clump_gap) ++totals_.clumped;
    }
    last_sent_ = at;
    if (const auto missing = expected_.add(datagram.number)) {
        extents_.in_order(datagram.number);
        if (*missing > 0) totals_.missing_runs.add(*missing);
        totals_.age.add(at, delay);
    } else {
        const auto [extent, is_cut] = extents_.reordered(datagram.number);
        totals_.reordered.add(extent);
        if (is_cut) ++totals_.beyond_look_back;
    }
}

StreamReport StreamTotals::report() const
{
    std::optional<double> clumped_share;
    if (gaps.count() > 0) {
        clumped_share = static_cast<double>(clumped) / static_cast<double>(gaps.count());
    }
    return {.requested_delay = requested.moments(),
            .delay = delay.moments(),
            .delay_quantiles = delays.delays().quantiles(),
            .delay_variation = delays.variations().quantiles(),
            .gap = gaps.quantiles(),
            .clumped_share = clumped_share,
            .missing_runs = missing_runs,
            .reordered = reordered,
            .beyond_look_back = beyond_look_back,
            .age = age.age()};
}

} // namespace hapnet::emulator
