// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <chrono>
#include <deque>

namespace hapnet::test {

/// The largest net work into a hand within any 5 s, apart from the governor's own figures.
class WorkOf5s {
public:
    /// The work of one tick, which ends `now` on the clock of the side.
    void add(double work_j, base::TimePoint now)
    {
        net_j_ += work_j;
        while (!lowest_.empty() && lowest_.back().net_j >= net_j_) lowest_.pop_back();
        lowest_.push_back({now, net_j_});
        while (now - lowest_.front().at > std::chrono::seconds{5}) lowest_.pop_front();
        most_j_ = std::max(most_j_, net_j_ - lowest_.front().net_j);
    }
    [[nodiscard]] double most_j() const { return most_j_; }

private:
    struct Net {
        base::TimePoint at;
        double net_j = 0.0;
    };

    double net_j_ = 0.0;
    double most_j_ = 0.0;
    std::deque<Net> lowest_; // ever higher ones
};

} // namespace hapnet::test
