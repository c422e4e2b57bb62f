// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/playout.hpp"

#include <algorithm>

namespace hapnet::peer {

PlayoutBuffer::PlayoutBuffer() : held_(waiting_max), seen_(window), bins_(steps)
{
    free_.reserve(waiting_max);
    order_.reserve(waiting_max);
    forget();
}

void PlayoutBuffer::forget()
{
    order_.clear();
    free_.clear();
    for (std::size_t place = waiting_max; place > 0; --place)
        free_.push_back(static_cast<std::uint16_t>(place - 1));
    std::ranges::fill(bins_, std::uint16_t{0});
    oldest_ = count_ = quantile_ = above_ = 0;
    last_sent_.reset();
}

std::optional<base::Duration> PlayoutBuffer::transit() const
{
    return last_sent_ ? std::optional{transit_} : std::nullopt;
}

bool PlayoutBuffer::put(const wire::State& state, base::TimePoint arrived)
{
    const base::Duration transit = arrived - state.sent;
    const bool is_in_time = !last_sent_ || transit <= transit_ + step;
    observe(state.sent, transit);
    if (free_.empty()) { // the oldest state makes room for the newest
        free_.push_back(order_.front());
        order_.erase(order_.begin());
    }
    const std::uint16_t place = free_.back();
    free_.pop_back();
    held_[place] = {state, arrived};
    const auto later = std::ranges::upper_bound(
        order_, state.sent, {}, [this](std::uint16_t index) { return held_[index].state.sent; });
    order_.insert(later, place);
    return is_in_time;
}

std::optional<PlayoutBuffer::Played> PlayoutBuffer::next(base::TimePoint now)
{
    if (order_.empty()) return std::nullopt;
    const std::uint16_t place = order_.front();
    const base::TimePoint at = due(held_[place]);
    if (at > now) return std::nullopt;
    order_.erase(order_.begin());
    free_.push_back(place);
    return Played{held_[place].state, at};
}

base::TimePoint PlayoutBuffer::due(const Held& held) const
{
    return std::clamp(held.state.sent + transit_, held.arrived, held.arrived + wait_max);
}

void PlayoutBuffer::observe(base::TimePoint sent, base::Duration transit)
{
    const bool is_faster = transit < origin_;
    const bool is_slower = count_ >= moved_after && bins_.back() > count_ / 2;
    const bool is_new = !last_sent_ || is_faster || is_slower; // such as after a jump of a clock
    if (is_new) {
        std::ranges::fill(bins_, std::uint16_t{0});
        oldest_ = count_ = quantile_ = above_ = 0;
        origin_ = transit - faster_max;
    }
    while (count_ > 0 && (count_ == window || sent - seen_[oldest_].sent > window_age))
        drop_oldest();
    const auto bin = std::min<base::Duration::rep>((transit - origin_) / step, steps - 1);
    count_in({sent, static_cast<std::uint16_t>(bin)});
    settle_quantile();
    if (is_new || quantile() >= transit_) {
        transit_ = quantile();
    } else if (sent > *last_sent_) {
        const auto passed = std::min<base::Duration>(sent - *last_sent_, std::chrono::seconds{1});
        transit_ -= std::min(transit_ - quantile(),
                             base::from_seconds(shrinks_by * base::to_seconds(passed)));
    }
    last_sent_ = last_sent_ ? std::max(*last_sent_, sent) : sent;
}

void PlayoutBuffer::count_in(const Seen& seen)
{
    seen_[(oldest_ + count_) % window] = seen;
    ++count_;
    ++bins_[seen.bin];
    if (seen.bin > quantile_) ++above_;
}

void PlayoutBuffer::drop_oldest()
{
    const std::uint16_t bin = seen_[oldest_].bin;
    --bins_[bin];
    if (bin > quantile_) --above_;
    oldest_ = (oldest_ + 1) % window;
    --count_;
}

/// Finds the lowest bin above which at most the share of late states lies.
void PlayoutBuffer::settle_quantile()
{
    const auto allowed = static_cast<std::size_t>(late_share * static_cast<double>(count_));
    while (above_ > allowed) above_ -= bins_[++quantile_];
    while (quantile_ > 0 && above_ + bins_[quantile_] <= allowed) above_ += bins_[quantile_--];
}

/// Returns the lower edge of the bin, so that a path without jitter causes no wait.
base::Duration PlayoutBuffer::quantile() const
{
    return origin_ + static_cast<base::Duration::rep>(quantile_) * step;
}

} // namespace hapnet::peer
