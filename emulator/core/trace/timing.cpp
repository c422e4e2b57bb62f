// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/timing.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace hapnet::emulator {

TimeAxis::TimeAxis(std::vector<base::Duration> times) : times_{std::move(times)}
{
    base::ensure(!times_.empty() && times_.front() == base::Duration{0});
    base::ensure(std::is_sorted(times_.begin(), times_.end(), std::less_equal{}));
    if (times_.size() == 1) return;
    period_ = times_.back() + (times_.back() - times_[times_.size() - 2]);
}

TimeAxis::Place TimeAxis::place(base::Duration time, bool repeats) const
{
    if (times_.size() == 1) return {};
    time = std::max(time, base::Duration{0});
    const std::size_t last = times_.size() - 1;
    if (!repeats && time >= times_.back()) return {last, last, 0.0};
    time %= period_;
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const auto index = static_cast<std::size_t>(after - times_.begin()) - 1;
    const auto passed = static_cast<double>((time - times_[index]).count());
    const auto length = static_cast<double>((end(index) - times_[index]).count());
    return {index, index == last ? 0 : index + 1, passed / length};
}

double TimeAxis::share(std::size_t index) const
{
    base::ensure(index < times_.size());
    if (period_ == base::Duration{0}) return 1.0;
    return static_cast<double>((end(index) - times_[index]).count()) /
           static_cast<double>(period_.count());
}

} // namespace hapnet::emulator
