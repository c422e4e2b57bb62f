// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/over_time.hpp"

#include <algorithm>

namespace hapnet::emulator {

void Stretch::add(const Stretch& later)
{
    received += later.received;
    dropped += later.dropped;
    bytes_out += later.bytes_out;
    left.add(later.left);
    queue_max = std::max(queue_max, later.queue_max); // nullopt is below any time
}

OverTime::OverTime(base::TimePoint start) : start_{start}, begin_{start}, end_{start}
{
    stretches_.reserve(stretches_max);
}

std::vector<StretchReport> OverTime::report() const
{
    std::vector<StretchReport> all;
    all.reserve(stretches_.size());
    base::Duration from{};
    for (const Stretch& one : stretches_) {
        all.push_back({from, length_, one});
        from += length_;
    }
    return all;
}

void OverTime::move_to(base::TimePoint time)
{
    const auto since_start = std::max(time - start_, base::Duration{0});
    while (since_start / length_ >= static_cast<base::Duration::rep>(stretches_max)) halve();
    current_ = static_cast<std::size_t>(since_start / length_);
    if (current_ >= stretches_.size()) stretches_.resize(current_ + 1);
    begin_ = start_ + static_cast<base::Duration::rep>(current_) * length_;
    end_ = begin_ + length_;
}

void OverTime::halve()
{
    const std::size_t half = (stretches_.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) {
        Stretch one = stretches_[2 * i];
        if (2 * i + 1 < stretches_.size()) one.add(stretches_[2 * i + 1]);
        stretches_[i] = one;
    }
    stretches_.resize(half);
    length_ *= 2;
}

} // namespace hapnet::emulator
